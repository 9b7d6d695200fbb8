#include "coupling/smoke_exchange.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace spindrift {
namespace {

/// (1 - e^-x) / x, right also at x = 0.
double relaxed_share(double x) {
  return x > 1e-12 ? -std::expm1(-x) / x : 1 - x / 2;
}

/// A face of a cell that takes part in the exchange.
struct CellFace {
  bool closed = false, yields = false;
  std::uint32_t slot = 0;  ///< in the region's faces, where the face is not closed
  double velocity = 0;     ///< of the air, as drag and lift left it; 0 on closed faces [m s^-1]
};

template <int Dim>
CellFace cell_face(OverlapRegion<Dim>& region, const Suspension<Dim>& suspension, std::size_t cell, int axis,
                   int side) {
  const MacGrid<Dim>& grid = suspension.grid();
  const std::size_t face = flat<Dim>(shifted<Dim>(unflat<Dim>(cell, grid.cells), axis, side), grid.faces(axis));
  if (suspension.face_mass(axis, face) <= 0) return {.closed = true};
  const std::uint32_t slot = region.faces[axis].slot(face);
  if (slot >= region.face_velocity[axis].size()) {
    region.face_velocity[axis].resize(slot + 1, suspension.velocity()[axis][face]);
    region.face_momentum[axis].resize(slot + 1, 0.0);
  }
  const bool yields = suspension.active_faces()[axis][face] != 0 && !suspension.options().frozen;
  return {false, yields, slot, region.face_velocity[axis][slot]};
}

/// Turns `dm` of the region's particle k into smoke of the cells around it, at the particle's velocity.
template <int Dim>
void make_smoke(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, std::size_t k, double dm) {
  const std::uint32_t i = region.particles[k];
  exchange.on_particles.mass[i] -= dm;
  exchange.on_particles.momentum[i] -= dm * region.velocity[k];
  exchange.generated += dm;
  region.on_cells[k].spread(dm, region.smoke.generated);
  for (int axis = 0; axis < Dim; ++axis)
    region.on_cells[k].spread(dm * region.velocity[k][axis], region.smoke.momentum[axis]);
}

/// Books the cells' new smoke, less what sticks, and the momentum that comes and goes with it.
/// stickiness: C_a dt [s]
template <int Dim>
void book_cells(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Suspension<Dim>& suspension,
                double stickiness) {
  SmokeScratch<Dim>& cells = region.smoke;
  for (std::size_t s = 0; s < region.cells.size(); ++s) {
    const std::size_t cell = region.cells.points()[s];
    const double made = cells.generated[s], held = suspension.smoke_mass()[cell];
    const double rate = stickiness * cells.swept[s] / suspension.ground().volume()[cell];
    const double stuck =
        rate > 0 ? std::min(-held * std::expm1(-rate) + made * (1 - relaxed_share(rate)), held + made) : 0;
    if (made == 0 && stuck == 0) continue;
    const double per_swept = stuck > 0 ? stuck / cells.swept[s] : 0;
    cells.taken[s] = per_swept;
    exchange.adhered += stuck;
    exchange.on_grid.smoke.push_back({cell, made - stuck});
    for (int axis = 0; axis < Dim; ++axis) {
      const std::array<CellFace, 2> faces{cell_face(region, suspension, cell, axis, 0),
                                          cell_face(region, suspension, cell, axis, 1)};
      cells.taken_momentum[axis][s] = per_swept * 0.5 * (faces[0].velocity + faces[1].velocity);
      // A face's control volume holds half of each cell beside it, so each face takes part with half of what moves.
      for (const CellFace& face : faces) {
        const double gained = 0.5 * (cells.momentum[axis][s] - stuck * face.velocity);
        const double kept = face.yields ? gained : 0.5 * (made - stuck) * face.velocity;
        if (!face.closed) region.face_momentum[axis][face.slot] += kept;
        exchange.on_fixed_faces[axis] += gained - kept;
      }
    }
  }
}

}  // namespace

template <int Dim>
double surface(double radius) {
  return Dim == 2 ? 2 * std::numbers::pi * radius : 4 * std::numbers::pi * radius * radius;
}

template <int Dim>
double section(double radius) {
  return Dim == 2 ? 2 * radius : std::numbers::pi * radius * radius;
}

double generated_smoke(const GenerationOptions& generation, double slip, double b, double surface, double dt) {
  if (!(slip > generation.threshold_speed)) return 0;
  double part = 1;
  if (b > 0 && generation.threshold_speed > 0) part = std::min(1.0, (slip / generation.threshold_speed - 1) / b);
  const double x = b * part;
  const double mean = x > 1e-6 ? -std::expm1(-0.7 * std::log1p(x)) / (0.7 * x) : 1 - 0.85 * x;
  return generation.constant * surface * std::pow(slip, 1.7) * dt * part * mean;
}

double mean_slip(double slip, double b) {
  return b > 1e-9 ? slip * std::log1p(b) / b : slip;
}

template <int Dim>
void exchange_smoke(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                    const Suspension<Dim>& suspension, const SmokeOptions& options, double dt) {
  region.smoke.clear(region.cells.size());
  // b of each particle: drag slows it from w to w / (1 + b) in the step.
  const auto slowing = [&](std::size_t k) { return (1 + region.loading[k]) * region.stiffness[k] * region.slip[k]; };

  if (options.generation) {
    for (std::size_t k = 0; k < region.size(); ++k) {
      const double spare = std::max(0.0, particles.mass[region.particles[k]] - options.min_mass);
      const double made =
          generated_smoke(*options.generation, region.slip[k], slowing(k), surface<Dim>(options.radius), dt);
      if (region.on_cells[k].any()) make_smoke(region, exchange, k, std::min(made, spare));
    }
  }
  if (options.adhesion) {
    for (std::size_t k = 0; k < region.size(); ++k) {
      const std::uint32_t i = region.particles[k];
      const bool takes = particles.mass[i] + exchange.on_particles.mass[i] < options.max_mass;
      region.swept[k] = takes ? section<Dim>(options.radius) * mean_slip(region.slip[k], slowing(k)) : 0;
      region.on_cells[k].spread(region.swept[k], region.smoke.swept);
    }
  }
  book_cells(region, exchange, suspension, options.adhesion ? options.adhesion->constant * dt : 0);
  if (options.adhesion) {
    for (std::size_t k = 0; k < region.size(); ++k) {
      const std::uint32_t i = region.particles[k];
      exchange.on_particles.mass[i] += region.swept[k] * region.on_cells[k].gather(region.smoke.taken);
      for (int axis = 0; axis < Dim; ++axis)
        exchange.on_particles.momentum[i][axis] +=
            region.swept[k] * region.on_cells[k].gather(region.smoke.taken_momentum[axis]);
    }
  }
}

template <int Dim>
std::size_t dissolve_spent(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                           const Suspension<Dim>& suspension, double min_mass) {
  exchange.clear(particles.size());
  std::vector<std::uint8_t>& spent = region.spent;
  spent.resize(particles.size());
  std::size_t n = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) n += spent[i] = particles.mass[i] <= min_mass * (1 + 1e-9);
  if (n == 0) return 0;
  find_region<Dim>(region, particles, spent, suspension);
  region.smoke.clear(region.cells.size());
  n = 0;
  for (std::size_t k = 0; k < region.size(); ++k) {
    if (!region.on_cells[k].any()) continue;
    make_smoke(region, exchange, k, particles.mass[region.particles[k]]);
    ++n;
  }
  book_cells(region, exchange, suspension, 0.0);
  book_faces(region, exchange);
  return n;
}

template <int Dim>
void hold_faces(OverlapRegion<Dim>& region, Exchange<Dim>& exchange) {
  for (int axis = 0; axis < Dim; ++axis) {
    for (double& given : region.face_momentum[axis]) {
      exchange.on_fixed_faces[axis] += given;
      given = 0;
    }
  }
}

template <int Dim>
void book_faces(const OverlapRegion<Dim>& region, Exchange<Dim>& exchange) {
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t s = 0; s < region.faces[axis].size(); ++s)
      exchange.on_grid.momentum[axis].push_back({region.faces[axis].points()[s], region.face_momentum[axis][s]});
}

#define INSTANTIATE(Dim)                                                                               \
  template double surface<Dim>(double);                                                                \
  template double section<Dim>(double);                                                                \
  template void exchange_smoke<Dim>(OverlapRegion<Dim>&, Exchange<Dim>&, const Particles<Dim>&,        \
                                    const Suspension<Dim>&, const SmokeOptions&, double);              \
  template std::size_t dissolve_spent<Dim>(OverlapRegion<Dim>&, Exchange<Dim>&, const Particles<Dim>&, \
                                           const Suspension<Dim>&, double);                            \
  template void hold_faces<Dim>(OverlapRegion<Dim>&, Exchange<Dim>&);                                  \
  template void book_faces<Dim>(const OverlapRegion<Dim>&, Exchange<Dim>&);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
