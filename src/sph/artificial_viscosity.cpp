#include "sph/artificial_viscosity.hpp"

#include <algorithm>

#include "core/memory.hpp"
#include "core/parallel.hpp"

namespace spindrift {

template <int Dim>
void ArtificialViscosity<Dim>::apply(Particles<Dim>& particles, const Neighbours<Dim>& neighbours,
                                     const std::vector<double>& wave_speed, double dt) {
  const std::size_t n = particles.size();
  change_.resize(n);
  const double fastest = 0.25 * d_ / dt, softening = 0.01 * d_ * d_;
  const auto& x = particles.position;
  const auto& v = particles.velocity;
  const auto& volume = particles.volume;
  const auto density = [&](std::size_t i) { return particles.mass[i] / volume[i]; };
  parallel_for(
      n,
      [&](std::size_t i) {
        const auto row = neighbours.row(i);
        const double density_i = density(i);
        Vec<Dim> impulse = Vec<Dim>::Zero();
        for (std::size_t k = 0; k < row.size(); ++k) {
          const std::size_t j = row.index[k];
          const double speed = 0.5 * (wave_speed[i] + wave_speed[j]);
          if (speed == 0) continue;
          const Vec<Dim> away = x[i] - x[j];
          const double approach = (v[i] - v[j]).dot(away);
          if (approach >= 0) continue;
          const double friction = std::min(artificial_viscosity * speed, fastest) * std::min(density_i, density(j));
          const double weight =
              dt * d_ * friction * approach / (away.squaredNorm() + softening) * (volume[i] * volume[j]);
          for (int a = 0; a < Dim; ++a) impulse[a] += weight * static_cast<double>(row.gradient(k)[a]);
        }
        change_[i] = impulse / particles.mass[i];
      },
      Neighbours<Dim>::block_size);
  parallel_for(n, [&](std::size_t i) { particles.velocity[i] += change_[i]; });
}

template <int Dim>
std::size_t ArtificialViscosity<Dim>::bytes() const {
  return spindrift::bytes(change_);
}

template class ArtificialViscosity<2>;
template class ArtificialViscosity<3>;

}  // namespace spindrift
