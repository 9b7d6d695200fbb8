#include "grid/core_boundary.hpp"

namespace spindrift {
namespace {

/// Calls f(axis, face, neighbour cell, side) for the faces of a cell that lie inside the domain; side 0 below, 1 above.
template <int Dim, class F>
void for_each_neighbour(const Index<Dim>& cell, const Index<Dim>& shape, F&& f) {
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Index<Dim> other = shifted<Dim>(cell, axis, 2 * side - 1);
      if (inside<Dim>(other, shape)) f(axis, shifted<Dim>(cell, axis, side), other, side);
    }
  }
}

}  // namespace

template <int Dim>
void CoreBoundary<Dim>::push_out_smoke(Field<Dim>& smoke, std::span<CoreCell<Dim>> cores, const FaceField<Dim>& u,
                                       const Field<Dim, CellKind>& kind, const Ground<Dim>& ground) const {
  for (CoreCell<Dim>& core : cores) {
    core.adhered = 0;
    core.adhered_momentum.setZero();
    const double mass = smoke[core.cell];
    if (mass <= 0) continue;
    double open = 0;
    for_each_neighbour<Dim>(core.cell, smoke.shape(), [&](int axis, const Index<Dim>& face, const Index<Dim>& other, int) {
      if (kind[other] == CellKind::open) open += ground.open()[axis][face];
    });
    if (open > 0) {
      double left = mass;
      std::size_t last = 0;
      for_each_neighbour<Dim>(core.cell, smoke.shape(),
                              [&](int axis, const Index<Dim>& face, const Index<Dim>& other, int) {
        if (kind[other] != CellKind::open || ground.open()[axis][face] <= 0) return;
        const double part = mass * (ground.open()[axis][face] / open);
        last = flat<Dim>(other, smoke.shape());
        smoke[last] += part;
        left -= part;
      });
      smoke[last] = std::max(0.0, smoke[last] + left);
    } else {
      core.adhered = mass;
      for (int axis = 0; axis < Dim; ++axis) {
        for (int side = 0; side < 2; ++side) {
          const Index<Dim> face = shifted<Dim>(core.cell, axis, side);
          if (ground.open()[axis][face] > 0) core.adhered_momentum[axis] += 0.5 * mass * u[axis][face];
        }
      }
    }
    smoke[core.cell] = 0;
  }
}

template <int Dim>
void CoreBoundary<Dim>::set_velocity(FaceField<Dim>& u, std::span<CoreCell<Dim>> cores,
                                     const Field<Dim, CellKind>& kind, const Field<Dim>& smoke,
                                     const Ground<Dim>& ground, bool moving) {
  if (cores.empty()) return;
  if (core_number_.size() == 0) core_number_ = Field<Dim, std::uint32_t>(smoke.shape());
  for (std::size_t n = 0; n < cores.size(); ++n) {
    core_number_[cores[n].cell] = static_cast<std::uint32_t>(n);
    cores[n].impulse.setZero();
  }
  for (CoreCell<Dim>& core : cores) {
    if (kind[core.cell] != CellKind::core) continue;
    for (int axis = 0; axis < Dim; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const Index<Dim> face = shifted<Dim>(core.cell, axis, side), other = shifted<Dim>(core.cell, axis, 2 * side - 1);
        const double air = ground.air_mass()[axis][face];
        if (air <= 0) continue;
        if (!inside<Dim>(other, smoke.shape())) {
          if (sides_[axis][side] == Side::closed) continue;
        }
        CoreCell<Dim>* second =
            inside<Dim>(other, smoke.shape()) && kind[other] == CellKind::core ? &cores[core_number_[other]] : nullptr;
        if (second && side == 1) continue;  // the other cell's lower face
        double speed = 0;
        if (moving) speed = second ? 0.5 * (core.velocity[axis] + second->velocity[axis]) : core.velocity[axis];
        const double impulse = (air + smoke_of_face<Dim>(smoke, axis, face)) * (speed - u[axis][face]);
        u[axis][face] = speed;
        if (second) {
          core.impulse[axis] -= 0.5 * impulse;
          second->impulse[axis] -= 0.5 * impulse;
        } else {
          core.impulse[axis] -= impulse;
        }
      }
    }
  }
}

template <int Dim>
Vec<Dim> CoreBoundary<Dim>::add_pressure(std::span<CoreCell<Dim>> cores, const Field<Dim>& pressure,
                                         const Field<Dim, CellKind>& kind, const FaceField<Dim>& open,
                                         double face_area, double dt) const {
  Vec<Dim> total = Vec<Dim>::Zero();
  for (CoreCell<Dim>& core : cores) {
    if (kind[core.cell] != CellKind::core) continue;
    for_each_neighbour<Dim>(core.cell, kind.shape(),
                            [&](int axis, const Index<Dim>& face, const Index<Dim>& other, int side) {
      if (kind[other] != CellKind::open) return;
      const double push = pressure[other] * face_area * open[axis][face] * dt;
      core.impulse[axis] += side == 0 ? push : -push;
      total[axis] += side == 0 ? push : -push;
    });
  }
  return total;
}

template class CoreBoundary<2>;
template class CoreBoundary<3>;

}  // namespace spindrift
