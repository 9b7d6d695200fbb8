#include "sph/wcsph.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "sph/pressure_solver.hpp"

namespace spindrift {

template <int Dim>
Vec<Dim> apply_state_pressure(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double sound_speed,
                              double density, double dt) {
  parallel_for(particles.size(), [&](std::size_t i) {
    particles.pressure[i] =
        sound_speed * sound_speed * density * std::max(0.0, neighbours.volume_sum()[i] - neighbours.full()[i]);
  });
  return apply_pressure(particles.velocity, particles, neighbours, particles.pressure, dt);
}

template Vec<2> apply_state_pressure(Particles<2>&, const Neighbours<2>&, double, double, double);
template Vec<3> apply_state_pressure(Particles<3>&, const Neighbours<3>&, double, double, double);

}  // namespace spindrift
