#pragma once
/// Is the state still one of snow and air? Looked at after every step, so that nothing else is ever written.

#include <cstdint>

#include "grid/suspension.hpp"
#include "sph/particles.hpp"

namespace spindrift {

struct StepStamp {
  std::uint64_t step = 0;
  double time = 0, dt = 0;  ///< of the step's start [s]
};

/// Faster than anything that gravity can drive over `length` [m], and than what began with `first_speed` [m s^-1] can
/// push: ten times the larger of first speed and free fall, at least 300 m/s.
double runaway_speed(double length, double gravity, double first_speed);

/// Throws Error(unstable) naming field, particle, place, step, time and dt: a value that is not finite, a mass or
/// volume that is not positive, a speed above `fastest` [m s^-1]. One pass over the particles.
template <int Dim>
void check_particles(const Particles<Dim>& particles, double fastest, const StepStamp& stamp);

/// The same for the air's velocity and the smoke, which must not be negative: the largest speed is known from the step,
/// the places are looked for only where something is wrong.
template <int Dim>
void check_suspension(const Suspension<Dim>& suspension, double fastest, const StepStamp& stamp);

}  // namespace spindrift
