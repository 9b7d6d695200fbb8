#include "coupling/drag_lift.hpp"

#include <algorithm>
#include <cmath>

#include "coupling/drag_system.hpp"

namespace spindrift {
namespace {

/// phi of each particle: the particle mass per air mass of the faces around it, mean over the axes.
template <int Dim>
void find_loading(OverlapRegion<Dim>& region, const Particles<Dim>& particles) {
  for_each_axis<Dim>([&](int axis) {
    std::vector<double>& particle_mass = region.particle_mass[axis];
    particle_mass.assign(region.face_mass[axis].size(), 0.0);
    for (std::size_t k = 0; k < region.size(); ++k)
      region.on_faces[axis][k].spread(particles.mass[region.particles[k]], particle_mass);
    for (std::size_t s = 0; s < particle_mass.size(); ++s) particle_mass[s] /= region.face_mass[axis][s];
  });
  parallel_for(region.size(), [&](std::size_t k) {
    region.loading[k] = 0;
    for (int axis = 0; axis < Dim; ++axis)
      region.loading[k] += region.on_faces[axis][k].gather(region.particle_mass[axis]) / Dim;
  });
}

/// Vorticity at x by (bi/tri)linear interpolation of the vorticity on the grid's edges: the difference of the
/// interpolated velocity over one cell is the same number.
template <int Dim>
Curl<Dim> vorticity_at(const Suspension<Dim>& suspension, const Vec<Dim>& x) {
  const MacGrid<Dim>& grid = suspension.grid();
  const auto slope = [&](int component, int along) {
    const Vec<Dim> half = 0.5 * grid.dx * Vec<Dim>::Unit(along);
    const auto& u = suspension.velocity()[component];
    return (face_stencil<Dim>(grid, component, x + half).gather(u) -
            face_stencil<Dim>(grid, component, x - half).gather(u)) /
           grid.dx;
  };
  if constexpr (Dim == 2) {
    return Curl<2>(slope(0, 1) - slope(1, 0));
  } else {
    return Curl<3>(slope(2, 1) - slope(1, 2), slope(0, 2) - slope(2, 0), slope(1, 0) - slope(0, 1));
  }
}

/// Gives the region's particle k an impulse [kg m s^-1] along the axes that have open faces around it.
template <int Dim>
void push(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles, std::size_t k,
          Vec<Dim> impulse) {
  for (int axis = 0; axis < Dim; ++axis)
    if (!region.on_faces[axis][k].any()) impulse[axis] = 0;
  const std::uint32_t i = region.particles[k];
  exchange.on_particles.momentum[i] += impulse;
  region.velocity[k] += impulse / particles.mass[i];
  region.impulse[k] = impulse;
}

/// Takes from the faces what push() gave to the particles.
template <int Dim>
void push_air(OverlapRegion<Dim>& region) {
  for_each_axis<Dim>([&](int axis) {
    std::vector<double>& momentum = region.face_momentum[axis];
    for (std::size_t k = 0; k < region.size(); ++k) region.on_faces[axis][k].spread(-region.impulse[k][axis], momentum);
    for (std::size_t s = 0; s < region.faces[axis].size(); ++s)
      region.face_velocity[axis][s] = region.start_velocity[axis][s] + momentum[s] / region.face_mass[axis][s];
  });
}

}  // namespace

double drag_stiffness(const ForceOptions& drag, double dt, double radius, double air_density, double volume,
                      double mass) {
  const double per_mass = drag.law == ForceLaw::paper ? 1 : air_density * volume / mass;
  return drag.constant * dt / radius * per_mass;
}

double drag_rate(double stiffness, double loading, double slip, bool gravity_predicted) {
  if (!gravity_predicted) return stiffness * slip;
  // (sqrt(1 + 4 s) - 1) / 2 = 2 s / (sqrt(1 + 4 s) + 1) without cancellation at small s.
  const double s = stiffness * (1 + loading) * slip;
  return 2 * s / (std::sqrt(1 + 4 * s) + 1) / (1 + loading);
}

template <int Dim>
Vec<Dim> damped_rotation(const Vec<Dim>& w, const Curl<Dim>& theta) {
  Vec<Dim> turned = w - cross<Dim>(w, theta);
  if constexpr (Dim == 3) turned += theta * theta.dot(w);
  return turned / (1 + theta.squaredNorm());
}

template <int Dim>
void exchange_drag(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                   const ForceOptions& drag, double radius, double air_density, double dt, bool gravity_predicted) {
  find_loading(region, particles);
  const std::size_t n = region.size();
  region.coupled_mass.resize(n);
  parallel_for(n, [&](std::size_t k) {
    const std::uint32_t i = region.particles[k];
    region.stiffness[k] = drag_stiffness(drag, dt, radius, air_density, particles.volume[i], particles.mass[i]);
    const double beta = drag_rate(region.stiffness[k], region.loading[k], region.slip[k], gravity_predicted);
    region.coupled_mass[k] = particles.mass[i] * beta / (1 + beta);
  });

  for_each_axis<Dim>([&](int axis) {
    const std::vector<double>& face_mass = region.face_mass[axis];
    const bool frozen = !face_mass.empty() && std::isinf(face_mass.front());
    if (!frozen) solve_face_velocity<Dim>(region, axis);
  });
  region.impulse.resize(n);
  parallel_for(n, [&](std::size_t k) {
    push<Dim>(region, exchange, particles, k, region.coupled_mass[k] * (region.air_velocity(k) - region.velocity[k]));
  });
  push_air(region);
}

template <int Dim>
void exchange_lift(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                   const Suspension<Dim>& suspension, const ForceOptions& lift, double dt) {
  find_loading(region, particles);
  const std::size_t n = region.size();
  region.impulse.resize(n);
  parallel_for(n, [&](std::size_t k) {
    const std::uint32_t i = region.particles[k];
    const double m = particles.mass[i];
    const double per_mass =
        lift.law == ForceLaw::paper ? 1 : suspension.options().air_density * particles.volume[i] / m;
    Curl<Dim> theta =
        lift.constant * dt * per_mass * (1 + region.loading[k]) * vorticity_at(suspension, particles.position[i]);
    const double angle = theta.norm();
    if (angle > 1) theta /= angle;
    const Vec<Dim> w = region.velocity[k] - region.air_velocity(k);
    push<Dim>(region, exchange, particles, k, m / (1 + region.loading[k]) * (damped_rotation<Dim>(w, theta) - w));
  });
  push_air(region);  // once all particles have been pushed: none's lift depends on another's place in the list
}

#define INSTANTIATE(Dim)                                                                                               \
  template Vec<Dim> damped_rotation<Dim>(const Vec<Dim>&, const Curl<Dim>&);                                           \
  template void exchange_drag<Dim>(OverlapRegion<Dim>&, Exchange<Dim>&, const Particles<Dim>&, const ForceOptions&,    \
                                   double, double, double, bool);                                                      \
  template void exchange_lift<Dim>(OverlapRegion<Dim>&, Exchange<Dim>&, const Particles<Dim>&, const Suspension<Dim>&, \
                                   const ForceOptions&, double);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
