#pragma once
/// A box of air and particles in it, as the coupling's tests need them.

#include <cmath>

#include "core/random.hpp"
#include "coupling/drag_lift.hpp"
#include "coupling/smoke_exchange.hpp"

namespace spindrift::testing {

template <int Dim>
Suspension<Dim> air_box(int n_cells, double dx, double air_density, Side side = Side::closed) {
  MacGrid<Dim> grid;
  grid.dx = dx;
  grid.cells.fill(n_cells);
  typename Suspension<Dim>::Sides sides;
  for (auto& axis : sides) axis = {side, side};
  SuspensionOptions<Dim> options;
  options.air_density = air_density;
  return Suspension<Dim>(grid, sides, options);
}

template <int Dim>
void add_particle(Particles<Dim>& particles, const Vec<Dim>& x, const Vec<Dim>& v, double mass, double volume = 1e-3) {
  const std::size_t n = particles.size();
  particles.resize(n + 1);
  particles.position[n] = x;
  particles.velocity[n] = v;
  particles.mass[n] = mass;
  particles.volume[n] = volume;
  particles.entrained_at[n] = -1;
  particles.id[n] = n;
}

/// A number in (-1, 1), a function of its arguments.
inline double noise(std::uint64_t i, std::uint32_t k) {
  return 2 * uniform(11, RandomStream::bernoulli, i, k) - 1;
}

template <int Dim>
Vec<Dim> noise_vector(std::uint64_t i, std::uint32_t first) {
  Vec<Dim> v;
  for (int k = 0; k < Dim; ++k) v[k] = noise(i, first + static_cast<std::uint32_t>(k));
  return v;
}

template <int Dim>
void stir(Suspension<Dim>& suspension, double speed) {
  FaceField<Dim> u = suspension.velocity();
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < u[axis].size(); ++f)
      if (suspension.active_faces()[axis][f]) u[axis][f] = speed * noise(f, 40 + static_cast<std::uint32_t>(axis));
  suspension.set_velocity(u);
}

/// Runs `terms(region, exchange)` on all particles and applies the result to both sides.
template <int Dim, class Terms>
Exchange<Dim> run_exchange(Suspension<Dim>& suspension, Particles<Dim>& particles, Terms&& terms) {
  const std::vector<std::uint8_t> all(particles.size(), 1);
  OverlapRegion<Dim> region;
  Exchange<Dim> exchange;
  exchange.clear(particles.size());
  find_region<Dim>(region, particles, all, suspension);
  terms(region, exchange);
  book_faces<Dim>(region, exchange);
  suspension.apply(exchange.on_grid);
  apply_sources(particles, exchange.on_particles);
  return exchange;
}

template <int Dim>
double kinetic_energy(const Suspension<Dim>& suspension, const Particles<Dim>& particles) {
  double energy = 0;
  for (std::size_t i = 0; i < particles.size(); ++i)
    energy += 0.5 * particles.mass[i] * particles.velocity[i].squaredNorm();
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < suspension.velocity()[axis].size(); ++f)
      energy += 0.5 * suspension.face_mass(axis, f) * std::pow(suspension.velocity()[axis][f], 2);
  return energy;
}

template <int Dim>
Vec<Dim> particle_momentum(const Particles<Dim>& particles) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (std::size_t i = 0; i < particles.size(); ++i) sum += particles.mass[i] * particles.velocity[i];
  return sum;
}

}  // namespace spindrift::testing
