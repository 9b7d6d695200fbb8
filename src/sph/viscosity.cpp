#include "sph/viscosity.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

constexpr double tolerance = 1e-6;
constexpr int max_iterations = 200;

template <int Dim>
double dot(const std::vector<Vec<Dim>>& a, const std::vector<Vec<Dim>>& b) {
  return parallel_sum(a.size(), 0.0, [&](std::size_t i) { return a[i].dot(b[i]); });
}

}  // namespace

template <int Dim>
void ViscositySolver<Dim>::find_coefficients(const Particles<Dim>& particles, const Neighbours<Dim>& neighbours,
                                             double viscosity, double dt) {
  const std::size_t n = particles.size();
  constexpr std::size_t block_size = Neighbours<Dim>::block_size;
  pairs_.resize((n + block_size - 1) / block_size);
  boundary_.resize(n);
  const double softening = 0.01 * d_ * d_;
  const bool no_slip = !neighbours.no_slip_coefficient().empty();
  auto body = [&](std::size_t begin, std::size_t end) {
    std::vector<float>& pairs = pairs_[begin / block_size];
    pairs.clear();
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = neighbours.row(i);
      for (std::size_t k = 0; k < row.size(); ++k) {
        const std::size_t j = row.index[k];
        double along = 0, r_squared = 0;
        for (int a = 0; a < Dim; ++a) {
          const double x = particles.position[i][a] - particles.position[j][a];
          along += x * static_cast<double>(row.gradient(k)[a]);
          r_squared += x * x;
        }
        const double volumes = particles.volume[i] * particles.volume[j];
        pairs.push_back(static_cast<float>(-2 * dt * viscosity * volumes * along / (r_squared + softening)));
      }
      boundary_[i] = no_slip ? dt * viscosity * particles.volume[i] * neighbours.no_slip_coefficient()[i] : 0;
    }
  };
  parallel_blocks(n, block_size, body);
}

/// out = dt L v.
template <int Dim>
void ViscositySolver<Dim>::apply(const Neighbours<Dim>& neighbours, const std::vector<Vec<Dim>>& v,
                                 std::vector<Vec<Dim>>& out) const {
  constexpr std::size_t block_size = Neighbours<Dim>::block_size;
  auto body = [&](std::size_t begin, std::size_t end) {
    const float* pair = pairs_[begin / block_size].data();
    for (std::size_t i = begin; i < end; ++i) {
      const auto row = neighbours.row(i);
      Vec<Dim> sum = boundary_[i] * v[i];
      for (const std::uint32_t j : row.index) sum += static_cast<double>(*pair++) * (v[i] - v[j]);
      out[i] = sum;
    }
  };
  parallel_blocks(v.size(), block_size, body);
}

template <int Dim>
SolveReport ViscositySolver<Dim>::solve(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double viscosity,
                                        double dt, Vec<Dim>& boundary_impulse) {
  const std::size_t n = particles.size();
  SolveReport report;
  if (n == 0) return report;
  residual_.resize(n);
  direction_.resize(n);
  product_.resize(n);
  find_coefficients(particles, neighbours, viscosity, dt);
  std::vector<Vec<Dim>>& v = particles.velocity;
  const std::vector<double>& mass = particles.mass;

  apply(neighbours, v, product_);
  parallel_for(n, [&](std::size_t i) {
    residual_[i] = -product_[i];
    direction_[i] = residual_[i] / mass[i];
  });
  double energy = dot<Dim>(residual_, direction_);
  const double start = energy;
  Vec<Dim> impulse = Vec<Dim>::Zero();
  while (energy > tolerance * tolerance * start && report.iterations < max_iterations) {
    apply(neighbours, direction_, product_);
    parallel_for(n, [&](std::size_t i) { product_[i] += mass[i] * direction_[i]; });
    const double alpha = energy / dot<Dim>(direction_, product_);
    parallel_for(n, [&](std::size_t i) {
      v[i] += alpha * direction_[i];
      residual_[i] -= alpha * product_[i];
    });
    impulse += alpha * parallel_sum<Vec<Dim>>(n, Vec<Dim>::Zero(),
                                              [&](std::size_t i) -> Vec<Dim> { return mass[i] * direction_[i]; });
    const double next = parallel_sum(n, 0.0, [&](std::size_t i) { return residual_[i].squaredNorm() / mass[i]; });
    const double beta = next / energy;
    parallel_for(n, [&](std::size_t i) { direction_[i] = residual_[i] / mass[i] + beta * direction_[i]; });
    energy = next;
    ++report.iterations;
  }
  report.error = start > 0 ? std::sqrt(energy / start) : 0;
  boundary_impulse += impulse;
  return report;
}

template <int Dim>
std::size_t ViscositySolver<Dim>::bytes() const {
  std::size_t n =
      spindrift::bytes(pairs_) + spindrift::bytes(boundary_) + spindrift::bytes(residual_, direction_, product_);
  for (const auto& block : pairs_) n += spindrift::bytes(block);
  return n;
}

template class ViscositySolver<2>;
template class ViscositySolver<3>;

}  // namespace spindrift
