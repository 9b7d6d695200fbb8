#pragma once
/// The ground: a profile in the x-z plane, in 3D extruded along y. Signed distance, normal and slope angle.

#include <array>
#include <limits>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

/// The nearest point of the ground's surface, as seen from a position.
template <int Dim>
struct Foot {
  double distance = 0;                        ///< signed distance [m], positive in the air
  Vec<Dim> normal = up<Dim>();                ///< unit normal out of the ground
  Vec<Dim - 1> place = Vec<Dim - 1>::Zero();  ///< arc length along the profile [m], in 3D also y [m]
};

/// A polyline from left to right, ground below it. x never decreases; a vertical piece is a cliff's face. The first and
/// the last piece go on to infinity.
template <int Dim>
class Terrain {
 public:
  /// vertices: at least two, (x, z) [m].  Throws Error(bad_input): fewer than two, x decreasing, coincident neighbours,
  /// a value that is not finite, a vertical end piece.
  explicit Terrain(std::vector<Vec<2>> vertices);

  /// The nearest point of the surface; where it is farther than `reach` [m] only the distance's sign is right, and it
  /// is `reach` or more. Cost: the pieces within min(reach, height over the surface) aside of x.
  Foot<Dim> foot(const Vec<Dim>& x, double reach = std::numeric_limits<double>::infinity()) const;

  /// The position at arc length (and y) `place` and normal distance `distance` from the surface: the inverse of foot()
  /// where the surface is smooth.
  Vec<Dim> position(const Vec<Dim - 1>& place, double distance) const;

  /// Height z of the surface over x [m]; at a cliff's face the upper edge's.
  double height(double x) const;

  /// Unit tangent of the profile, pointing along increasing arc length.
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

/// cos of the angle between a normal and the vertical.
template <int Dim>
double cos_slope(const Vec<Dim>& normal) {
  return normal[up_axis<Dim>];
}

}  // namespace spindrift
