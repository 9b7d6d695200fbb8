#pragma once
/// The exchange ledger: what particles and grid give each other in one step. Every term writes both sides at once, so
/// that the sums cancel.

#include "grid/grid_sources.hpp"
#include "sph/particles.hpp"

namespace spindrift {

template <int Dim>
struct Exchange {
  ParticleSources<Dim> on_particles;  ///< one entry a particle of the dense flow
  GridSources<Dim> on_grid;           ///< only what was touched
  /// Momentum given to faces with a given velocity u_f (closed, beside the core, or of frozen air): the face keeps what
  /// moves the smoke that is made or sticks at u_f; ground, core and what holds the frozen air take the rest, which
  /// stands here [kg m s^-1].
  Vec<Dim> on_fixed_faces = Vec<Dim>::Zero();
  double generated = 0;  ///< smoke made from particles [kg]
  double adhered = 0;    ///< smoke that stuck to particles [kg]

  void clear(std::size_t n_particles) {
    on_particles.momentum.assign(n_particles, Vec<Dim>::Zero());
    on_particles.mass.assign(n_particles, 0.0);
    on_grid.clear();
    on_fixed_faces.setZero();
    generated = adhered = 0;
  }
};

/// v = (m v + J) / (m + dm), m += dm.
template <int Dim>
void apply_sources(Particles<Dim>& particles, const ParticleSources<Dim>& sources) {
  for (std::size_t i = 0; i < particles.size(); ++i) {
    const double mass = particles.mass[i] + sources.mass[i];
    particles.velocity[i] = (particles.mass[i] * particles.velocity[i] + sources.momentum[i]) / mass;
    particles.mass[i] = mass;
  }
}

/// Momentum that the grid gains, Suspension::apply's result [kg m s^-1].
template <int Dim>
Vec<Dim> momentum_on_grid(const Exchange<Dim>& exchange) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (int axis = 0; axis < Dim; ++axis)
    for (const PointSource& source : exchange.on_grid.momentum[axis]) sum[axis] += source.amount;
  return sum;
}

/// Momentum that the particles gain [kg m s^-1].
template <int Dim>
Vec<Dim> momentum_on_particles(const Exchange<Dim>& exchange) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (const Vec<Dim>& j : exchange.on_particles.momentum) sum += j;
  return sum;
}

/// Sum of everything the exchange gives to particles, grid, ground and core: zero to round-off [kg m s^-1].
template <int Dim>
Vec<Dim> momentum_imbalance(const Exchange<Dim>& exchange) {
  return momentum_on_particles(exchange) + momentum_on_grid(exchange) + exchange.on_fixed_faces;
}

/// The same of mass [kg].
template <int Dim>
double mass_imbalance(const Exchange<Dim>& exchange) {
  double sum = 0;
  for (const double dm : exchange.on_particles.mass) sum += dm;
  for (const PointSource& source : exchange.on_grid.smoke) sum += source.amount;
  return sum;
}

}  // namespace spindrift
