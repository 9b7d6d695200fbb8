#pragma once
/// The equation-of-state baseline that the paper uses (Muller et al. 2003), on volume.

#include <vector>

#include "core/vec.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace spindrift {

/// One explicit step: p = max(0, c^2 rho_0 (delta - full)), full of Neighbours, goes to particles.pressure and acts on
/// the velocities by apply_pressure. Wants ArtificialViscosity with wave speed c before it. Returns the impulse that
/// walls and cover gave [kg m s^-1].
template <int Dim>
Vec<Dim> apply_state_pressure(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double sound_speed,
                              double density, double dt);

/// The largest stable step, 0.4 d / c [s]. Pressure moves snow lighter than rho_0 with the wave speed
/// c sqrt(rho_0 V / m): c is that of the lightest.
inline double wcsph_time_step(double sound_speed, double spacing) {
  return 0.4 * spacing / sound_speed;
}

}  // namespace spindrift
