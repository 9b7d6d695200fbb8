#include "grid/core_boundary.hpp"

#include "grid/face_mass.hpp"

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
Vec<Dim> CoreBoundary<Dim>::push_out_smoke(Field<Dim>& smoke, std::span<CoreCell<Dim>> cores, const FaceField<Dim>& u,
                                           const Field<Dim, CellKind>& kind, const Ground<Dim>& ground) const {
  Vec<Dim> gained = Vec<Dim>::Zero();
  for (CoreCell<Dim>& core : cores) {
    core.adhered = 0;
    core.adhered_momentum.setZero();
    const double mass = smoke[core.cell];
    if (mass <= 0) continue;
    const Vec<Dim> momentum = momentum_of_smoke<Dim>(mass, core.cell, u, ground);
    gained -= momentum;
    double open = 0;
    for_each_neighbour<Dim>(core.cell, smoke.shape(),
                            [&](int axis, const Index<Dim>& face, const Index<Dim>& other, int) {
                              if (kind[other] == CellKind::open) open += ground.open()[axis][face];
                            });
    if (open > 0) {
      double left = mass;
      Index<Dim> last{};
      for_each_neighbour<Dim>(core.cell, smoke.shape(),
                              [&](int axis, const Index<Dim>& face, const Index<Dim>& other, int) {
                                if (kind[other] != CellKind::open || ground.open()[axis][face] <= 0) return;
                                const double part = mass * (ground.open()[axis][face] / open);
                                last = other;
                                smoke[other] += part;
                                gained += momentum_of_smoke<Dim>(part, other, u, ground);
                                left -= part;
                              });
      smoke[last] = std::max(0.0, smoke[last] + left);
    } else {
      core.adhered = mass;
      core.adhered_momentum = momentum;
    }
    smoke[core.cell] = 0;
  }
  return gained;
}

template <int Dim>
Vec<Dim> CoreBoundary<Dim>::set_velocity(FaceField<Dim>& u, std::span<CoreCell<Dim>> cores,
                                         const Field<Dim, CellKind>& kind, const Field<Dim>& smoke,
                                         const Ground<Dim>& ground, bool moving) {
  Vec<Dim> gained = Vec<Dim>::Zero();
  if (cores.empty()) return gained;
  if (core_number_.size() == 0) core_number_ = Field<Dim, std::uint32_t>(smoke.shape());
  for (std::size_t n = 0; n < cores.size(); ++n) {
    core_number_[cores[n].cell] = static_cast<std::uint32_t>(n);
    cores[n].impulse.setZero();
  }
  // f(axis, face, its mass, number of the core cell beyond it or that of the cell itself)
  const auto for_each_face = [&](std::size_t n, auto&& f) {
    const CoreCell<Dim>& core = cores[n];
    if (kind[core.cell] != CellKind::core) return;
    for (int axis = 0; axis < Dim; ++axis) {
      for (int side = 0; side < 2; ++side) {
        const Index<Dim> face = shifted<Dim>(core.cell, axis, side),
                         other = shifted<Dim>(core.cell, axis, 2 * side - 1);
        const double air = ground.air_mass()[axis][face];
        const bool in_box = inside<Dim>(other, smoke.shape());
        if (air <= 0 || (!in_box && sides_[axis][side] == Side::closed)) continue;
        const bool shared = in_box && kind[other] == CellKind::core;
        f(axis, side, face, air + smoke_of_face<Dim>(smoke, axis, face), shared ? core_number_[other] : n);
      }
    }
  };

  // The air on a core cell's faces and the core's snow go on with their common velocity: given back as if the core were
  // infinitely heavy, its reaction would throw thin snow about.
  common_.resize(cores.size());
  for (std::size_t n = 0; n < cores.size(); ++n) {
    Vec<Dim> momentum = cores[n].mass * cores[n].velocity;
    Vec<Dim> mass = Vec<Dim>::Constant(cores[n].mass);
    for_each_face(n, [&](int axis, int, const Index<Dim>& face, double face_mass, std::size_t second) {
      const double share = second == n ? face_mass : 0.5 * face_mass;
      momentum[axis] += share * u[axis][face];
      mass[axis] += share;
    });
    common_[n] = moving ? Vec<Dim>(momentum.cwiseQuotient(mass)) : Vec<Dim>(Vec<Dim>::Zero());
  }
  for (std::size_t n = 0; n < cores.size(); ++n) {
    for_each_face(n, [&](int axis, int side, const Index<Dim>& face, double face_mass, std::size_t second) {
      if (second != n && side == 1) return;  // the other cell's lower face
      const double speed = 0.5 * (common_[n][axis] + common_[second][axis]);
      const double impulse = face_mass * (speed - u[axis][face]);
      u[axis][face] = speed;
      cores[n].impulse[axis] -= 0.5 * impulse;
      cores[second].impulse[axis] -= 0.5 * impulse;
      gained[axis] += impulse;
    });
  }
  return gained;
}

template <int Dim>
std::span<const HeavyCell<Dim>> CoreBoundary<Dim>::heavy_cells(std::span<const CoreCell<Dim>> cores,
                                                               const Field<Dim, CellKind>& kind) {
  heavy_.clear();
  for (const CoreCell<Dim>& core : cores)
    if (kind[core.cell] == CellKind::core) heavy_.push_back({core.cell, core.mass});
  return heavy_;
}

template <int Dim>
Vec<Dim> CoreBoundary<Dim>::add_pressure(std::span<CoreCell<Dim>> cores, const PressureProjection<Dim>& projection,
                                         const Field<Dim, CellKind>& kind, const Field<Dim>& smoke,
                                         const Ground<Dim>& ground, double face_area, double dt, bool moving) const {
  Vec<Dim> total = Vec<Dim>::Zero();
  for (CoreCell<Dim>& core : cores) {
    if (kind[core.cell] != CellKind::core) continue;
    for_each_neighbour<Dim>(
        core.cell, kind.shape(), [&](int axis, const Index<Dim>& face, const Index<Dim>& other, int side) {
          if (kind[other] != CellKind::open) return;
          const double push = projection.pressure(other) * face_area * ground.open()[axis][face] * dt;
          const double face_mass = ground.air_mass()[axis][face] + smoke_of_face<Dim>(smoke, axis, face);
          const double on_core = moving ? push - face_mass * push / core.mass : push;
          core.impulse[axis] += side == 0 ? on_core : -on_core;
          total[axis] += side == 0 ? on_core : -on_core;
        });
  }
  return total;
}

template class CoreBoundary<2>;
template class CoreBoundary<3>;

}  // namespace spindrift
