#pragma once
/// Ground as a height over a plane: signed distance, normal, nearest point.

#include <limits>
#include <vector>

#include "terrain/bicubic.hpp"
#include "terrain/foot.hpp"

namespace spindrift {

/// Heights on a regular grid of points.
struct HeightGrid {
  Vec<2> first = Vec<2>::Zero();  ///< (x, y) of the first point [m]
  double cell = 1;                ///< between neighbouring points, along x and y [m]
  Index<2> points{};              ///< along x and y
  std::vector<double> z;          ///< [m], x running fastest
};

/// The surface z(x, y) through a grid's points, of class C1 (bicubic.hpp), ground below it. Beyond the grid it goes on
/// level, with the heights of the grid's edge, into which it bends within one cell. Places are (x, y) [m].
class HeightField {
 public:
  /// Throws Error(bad_input): fewer than two points along an axis or not as many heights as points, a cell that is not
  /// positive, a height that is not finite.
  explicit HeightField(const HeightGrid& grid);

  /// The nearest point of the surface, to about 1e-10 m, where that is nearer than `certain` [m]; farther off, the one
  /// to which Newton's method comes from straight above or below (it is `certain` or farther, and the way to it is
  /// normal to the surface, but another one may be nearer). Where it is farther than `reach` [m] only the distance's
  /// sign is right, and it is `reach` or more. Newton's method on the squared distance, from straight above or below;
  /// it ends in the nearest point of all where bounds of height and curvature show that there is but one. Elsewhere the
  /// cells that may be nearer are searched through a pyramid of bounds, each from its nearest of 3 x 3 places. Cost
  /// near the ground: four evaluations.
  Foot<3> foot(const Vec<3>& x, double reach = std::numeric_limits<double>::infinity(),
               double certain = std::numeric_limits<double>::infinity()) const;

  /// The position over `place` at normal distance `distance`: the inverse of foot() near the surface.
  Vec<3> position(const Vec<2>& place, double distance) const;

  double height(const Vec<2>& place) const;  ///< z [m]
  Vec<3> normal(const Vec<2>& place) const;  ///< unit normal out of the ground

  /// Whether the steepest slope shows that x is `reach` [m] or more above the ground. Cost: one height.
  bool clears(const Vec<3>& x, double reach) const;

  double cell() const { return cell_; }  ///< between neighbouring points of the grid [m]
  /// Bound of height over distance: 1 / cos of the steepest slope.
  double lipschitz() const { return lipschitz_; }
  std::size_t bytes() const;

 private:
  struct Cell {
    Index<2> number;  ///< in bounds_[0]
    Vec<2> t;         ///< in the cell, 0 to 1
    std::array<bool, 2> level;
  };
  /// A place with its squared distance from somewhere.
  struct Candidate {
    Vec<2> place;
    Jet jet;
    double squared;
  };

  Cell locate(const Vec<2>& place) const;
  const double* points_of(const Index<2>& cell) const;
  Jet jet(const Vec<2>& place) const;
  Candidate candidate(const Vec<3>& x, const Vec<2>& place) const;
  Candidate descend(const Vec<3>& x, Candidate at) const;
  bool sole(const Vec<3>& x, double above, double r) const;
  void search(const Vec<3>& x, std::size_t level, const Index<2>& block, Candidate& best) const;
  void search_cell(const Vec<3>& x, const Index<2>& cell, Candidate& best) const;
  double cell_distance(const Vec<3>& x, const Index<2>& cell) const;
  double block_distance(const Vec<3>& x, std::size_t level, const Index<2>& block) const;
  Box<2> block_extent(std::size_t level, const Index<2>& block) const;
  template <class F>
  void for_blocks_around(const Vec<3>& x, double half_edge, F&& f) const;
  const CellBounds& bounds(std::size_t level, const Index<2>& block) const {
    return bounds_[level][flat<2>(block, shapes_[level])];
  }

  Vec<2> corner_;  ///< of cell (0, 0), one cell before the grid's first point [m]
  double cell_, inverse_cell_, lipschitz_;
  std::size_t stride_;                           ///< points in a row of z_
  std::vector<double> z_;                        ///< the grid's, with two more rings that repeat its edge
  std::vector<Index<2>> shapes_;                 ///< blocks of each level
  std::vector<std::vector<CellBounds>> bounds_;  ///< of blocks of 2^level x 2^level cells, up to a single one
};

}  // namespace spindrift
