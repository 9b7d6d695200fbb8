#pragma once
/// Ground as a line in the x-z plane: signed distance, normal and slope angle.

#include <cstdint>
#include <limits>
#include <vector>

#include "terrain/foot.hpp"

namespace spindrift {

/// A polyline from left to right, ground below it. x never decreases; a vertical piece is a cliff's face. The first and
/// the last piece go on to infinity. Places are arc lengths [m].
class Profile {
 public:
  /// vertices: at least two, (x, z) [m].  Throws Error(bad_input): fewer than two, x decreasing, coincident neighbours,
  /// a value that is not finite, a vertical end piece.
  explicit Profile(std::vector<Vec<2>> vertices);

  /// The nearest point of the surface; where it is farther than `reach` [m] only the distance's sign is right, and it
  /// is `reach` or more. Cost: the pieces within min(reach, height over the surface) aside of x.
  Foot<2> foot(const Vec<2>& x, double reach = std::numeric_limits<double>::infinity()) const;

  /// The position at normal distance `distance` from the surface: the inverse of foot() where the surface is smooth.
  Vec<2> position(double arc_length, double distance) const;

  /// Height z of the surface over x [m]; at a cliff's face the upper edge's.
  double height(double x) const;

  /// Unit tangent, pointing along increasing arc length.
  Vec<2> tangent(double arc_length) const;

  double length() const { return arc_.back(); }  ///< arc length of the whole polyline [m]
  const std::vector<Vec<2>>& vertices() const { return vertices_; }
  std::size_t bytes() const;

 private:
  std::size_t first_piece_reaching(double x) const;  ///< the first whose right end is not left of x
  std::size_t piece_at(double arc_length) const;
  Vec<2> piece_tangent(std::size_t piece) const;
  Vec<2> piece_normal(std::size_t piece) const;

  std::vector<Vec<2>> vertices_;
  std::vector<double> arc_;               ///< arc length at each vertex [m]
  double table_x0_ = 0, table_step_ = 1;  ///< a bin of the table is [x0 + b step, x0 + (b + 1) step)
  std::vector<std::uint32_t> table_;      ///< first piece that reaches into each bin
};

}  // namespace spindrift
