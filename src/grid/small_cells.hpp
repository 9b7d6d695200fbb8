#pragma once
/// Cells that the ground leaves less than half of: in the transport of smoke they act together with a neighbour, so
/// that they neither force small time steps nor pile up smoke (R21).

#include <span>
#include <vector>

#include "grid/ground.hpp"

namespace spindrift {

/// The neighbour of a small cell that has at least half a cell's volume and lies behind the widest face (by `area`);
/// the cell itself where there is none.
template <int Dim>
std::size_t root_of_small_cell(std::size_t cell, const FaceField<Dim>& area, const Ground<Dim>& ground);

/// Groups of small cells around their root. Small cells without one stay alone. Scratch of one step.
template <int Dim>
class SmallCells {
 public:
  void find(const FaceField<Dim>& flow_area, const Ground<Dim>& ground);

  /// Where more than `limit` of a member's volume leaves it at once, the group's volume is shared out anew, mostly in
  /// proportion to the members' outflow. The sum stays.   volume in-out, outflow in: [m^Dim]
  void lend(Field<Dim>& volume, const Field<Dim>& outflow, double limit) const;

  /// Equal density in every group.   smoke in-out: [kg]; the sum stays.   volume in: [m^Dim]
  void share(Field<Dim>& smoke, const Field<Dim>& volume) const;

  std::size_t bytes() const { return spindrift::bytes(members_); }

 private:
  struct Member {
    std::uint32_t root, cell;
  };
  template <class F>
  void for_each_group(F&& f) const;

  std::vector<Member> members_;  ///< by root
};

}  // namespace spindrift
