#include "grid/inflow.hpp"

#include <algorithm>

namespace spindrift {
namespace {

/// On the faces of `axis` that lie on, or across beside, the given side.
template <int Dim>
void let_in(Field<Dim>& u, int axis, const FaceField<Dim>& carrier, const Field<Dim>& flow_area,
            const MacGrid<Dim>& grid, int normal, int side, double wind, double dt) {
  const Field<Dim>& through = carrier[normal];
  const double into = side == 0 ? 1 : -1;
  const int last_cell = grid.cells[normal] - 1;
  Index<Dim> layer = u.shape();
  layer[normal] = 1;
  for_each_index<Dim>(layer, [&](Index<Dim> face) {
    Index<Dim> beside = face;  // the side's face, of the cell that the face belongs to
    beside[normal] = side == 0 ? 0 : last_cell + 1;
    face[normal] = side == 0 ? 0 : (axis == normal ? last_cell + 1 : last_cell);
    if (!(flow_area[face] > 0)) return;
    double speed;
    if (axis == normal) {
      speed = through[beside];
    } else {
      const int last = through.shape()[axis] - 1;
      int& along = beside[axis];
      const int here = along;
      along = std::min(here, last);
      speed = 0.5 * through[beside];
      along = std::max(here - 1, 0);
      speed += 0.5 * through[beside];
    }
    const double share = std::clamp(into * speed * dt / grid.dx, 0.0, 1.0);
    u[face] += share * (wind - u[face]);
  });
}

}  // namespace

template <int Dim>
void let_in_ambient_air(FaceField<Dim>& u, const FaceField<Dim>& carrier, const FaceField<Dim>& flow_area,
                        const MacGrid<Dim>& grid, const std::array<std::array<Side, 2>, Dim>& sides,
                        const Vec<Dim>& wind, double dt) {
  for (int normal = 0; normal < Dim; ++normal)
    for (int side = 0; side < 2; ++side) {
      if (sides[normal][side] != Side::open) continue;
      for (int axis = 0; axis < Dim; ++axis)
        let_in<Dim>(u[axis], axis, carrier, flow_area[axis], grid, normal, side, wind[axis], dt);
    }
}

template void let_in_ambient_air<2>(FaceField<2>&, const FaceField<2>&, const FaceField<2>&, const MacGrid<2>&,
                                    const std::array<std::array<Side, 2>, 2>&, const Vec<2>&, double);
template void let_in_ambient_air<3>(FaceField<3>&, const FaceField<3>&, const FaceField<3>&, const MacGrid<3>&,
                                    const std::array<std::array<Side, 2>, 3>&, const Vec<3>&, double);

}  // namespace spindrift
