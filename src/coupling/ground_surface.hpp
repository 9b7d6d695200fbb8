#pragma once
/// What is solid for the suspension: the cover's surface, which sinks as snow is entrained, or the bare terrain (R21),
/// and obstacles.

#include <span>
#include <vector>

#include "grid/ground.hpp"
#include "sph/cover.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

template <int Dim>
class GroundSurface {
 public:
  /// walls   with a terrain, obstacles or both;   cover   null: bare ground
  GroundSurface(const Walls<Dim>& walls, const MacGrid<Dim>& grid, const Cover<Dim>* cover);

  /// Signed distance to the boundary at the grid's nodes [m], positive in the air; right near the boundary, elsewhere
  /// only its sign.
  const Field<Dim>& node_distance() const { return distance_; }

  /// Goes over to another window of the same whole grid.
  void move_window(const Walls<Dim>& walls, const MacGrid<Dim>& window, const Cover<Dim>* cover);

  /// Follows the cover's surface everywhere.
  void follow(const Cover<Dim>& cover);
  /// Follows the cover's surface where snow was taken from `places`. Cost: the nodes near these.
  /// Returns the columns of cells along the first axis whose nodes may have moved, apart from each other, ascending.
  std::span<const Span> follow(const Cover<Dim>& cover, std::span<const Vec<Dim>> places);

  /// How far aside of a cell of this edge the cover may count for its nodes [m]: their feet lie up to the reach aside,
  /// and the height over a foot is read up to two bins aside of it.
  static double sees_aside(const Cover<Dim>& cover, double dx) { return reach(&cover, dx) + 2 * cover.bin_size; }

  std::size_t bytes() const { return distance_.bytes() + spindrift::bytes(near_); }

 private:
  struct Near {
    std::size_t node;
    double terrain_distance;   ///< [m]
    double obstacle_distance;  ///< [m]
    Vec<Dim - 1> place;        ///< of the node's foot on the terrain
    int column;                ///< of the node along the first axis
  };
  static double reach(const Cover<Dim>* cover, double dx) { return (cover ? cover->thickness : 0) + 3 * dx; }
  double distance_over(const Cover<Dim>& cover, const Near& near) const;
  template <class F>
  void look_at(const Walls<Dim>& walls, F&& is_new);

  MacGrid<Dim> grid_;
  double reach_;  ///< distance up to which nodes follow the surface [m]
  Field<Dim> distance_;
  std::vector<Near> near_;
  std::vector<Span> moved_;  ///< scratch
};

}  // namespace spindrift
