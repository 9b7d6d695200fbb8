#include "sph/pressure_solver.hpp"

#include <algorithm>
#include <cmath>

#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "sph/lanes.hpp"

namespace spindrift {
namespace {

constexpr float relaxation = 0.5f;

/// Of the diagonal m / V dD_i/dp_i in units of h^-2: a quarter of its value on the lattice (2.1 in 2D, 1.7 in 3D), so
/// that a particle with few neighbours, or coincident ones, is not flung away.
constexpr double least_diagonal = 0.5;

/// The volume sum from which on a particle may not be compressed further. With 1, particles a little below fall freely
/// through the gaps that the last correction opened, and a column sinks into itself.
constexpr double full = 0.95;

/// The most compression that the constant-density solve takes back in one step. A column that is too dense by e must grow
/// by e H: at once, that is many spacings, far beyond where the linearised volume sum means anything.
constexpr double largest_correction = 0.003;

/// sum_k f(k) over a row, in four interleaved chains that hide the latency of the additions.
template <int Dim, class F>
inline Lanes<Dim> row_sum(std::size_t n, F&& f) {
  Lanes<Dim> a{}, b{}, c{}, d{};
  std::size_t k = 0;
  for (; k + 4 <= n; k += 4) {
    a += f(k);
    b += f(k + 1);
    c += f(k + 2);
    d += f(k + 3);
  }
  for (; k < n; ++k) a += f(k);
  return (a + b) + (c + d);
}

}  // namespace

template <int Dim>
void PressureSolver<Dim>::prepare(const Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt) {
  const std::size_t n = particles.size();
  for (auto* array : {&compression_, &target_, &residual_, &step_, &pressure_, &volume_pressure_, &mobility_, &volume_})
    array->resize(n);
  gradient_sum_.resize(n * lane_width<Dim>);
  displacement_.resize(n * lane_width<Dim>);
  parallel_for(n, [&](std::size_t i) {
    const auto row = neighbours.row(i);
    const Vec<Dim>& v = particles.velocity[i];
    const Vec<Dim>& g_sum = neighbours.gradient_sum()[i];
    double rate = 0, squares = 0;
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::size_t j = row.index[k];
      const float* g = row.gradient(k);
      double along = 0, square = 0;
      for (int a = 0; a < Dim; ++a) {
        const auto g_a = static_cast<double>(g[a]);
        along += (v[a] - particles.velocity[j][a]) * g_a;
        square += g_a * g_a;
      }
      rate += particles.volume[j] * along;
      squares += particles.volume[j] * particles.volume[j] / particles.mass[j] * square;
    }
    const double volume = particles.volume[i], mobility = volume / particles.mass[i];
    rate += 2 * v.dot(neighbours.boundary_gradient()[i]);
    const double diagonal =
        std::max(mobility * g_sum.squaredNorm() + volume * squares, mobility * least_diagonal / (h_ * h_));
    compression_[i] = static_cast<float>(dt * rate);
    step_[i] = relaxation / static_cast<float>(dt * dt * diagonal);
    mobility_[i] = static_cast<float>(dt * dt * mobility);
    volume_[i] = static_cast<float>(volume);
    store<Dim>(&gradient_sum_[i * lane_width<Dim>], to_lanes<Dim>(g_sum));
  }, Neighbours<Dim>::block_size);
}

template <int Dim>
SolveReport PressureSolver<Dim>::solve_divergence(Particles<Dim>& particles, const Neighbours<Dim>& neighbours,
                                                  double dt, Vec<Dim>& boundary_impulse) {
  prepare(particles, neighbours, dt);
  for (std::size_t i = 0; i < particles.size(); ++i)
    target_[i] = static_cast<float>(std::max(0.0, full - neighbours.volume_sum()[i]));
  SolveReport report = solve(particles.divergence_pressure, neighbours, options_.divergence_tolerance * 0.01);
  report.error *= 100;
  boundary_impulse += apply_pressure(particles.velocity, particles, neighbours, particles.divergence_pressure, dt);
  return report;
}

template <int Dim>
SolveReport PressureSolver<Dim>::solve_density(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt,
                                               std::vector<Vec<Dim>>& correction) {
  for (std::size_t i = 0; i < particles.size(); ++i)
    target_[i] = static_cast<float>(std::max(-largest_correction, 1 - neighbours.volume_sum()[i]));
  const SolveReport report = solve(particles.pressure, neighbours, options_.density_tolerance);
  correction.assign(particles.size(), Vec<Dim>::Zero());
  apply_pressure(correction, particles, neighbours, particles.pressure, dt);
  return report;
}

template <int Dim>
SolveReport PressureSolver<Dim>::solve(std::vector<double>& pressure, const Neighbours<Dim>& neighbours,
                                       double tolerance) {
  const std::size_t n = pressure.size();
  SolveReport report;
  if (n == 0) return report;
  for (std::size_t i = 0; i < n; ++i) pressure_[i] = static_cast<float>(pressure[i]);
  for (;;) {
    find_accelerations(neighbours);
    report.error = find_residuals(neighbours) / static_cast<double>(n);
    const bool done = report.error <= tolerance && report.iterations > 0;
    if (done || report.iterations == options_.max_iterations) break;
    update_pressures();
    ++report.iterations;
  }
  for (std::size_t i = 0; i < n; ++i) {
    pressure[i] = static_cast<double>(pressure_[i]);
    compression_[i] = residual_[i] + target_[i];
  }
  return report;
}

template <int Dim>
void PressureSolver<Dim>::find_accelerations(const Neighbours<Dim>& neighbours) {
  const std::size_t n = pressure_.size();
  for (std::size_t i = 0; i < n; ++i) volume_pressure_[i] = volume_[i] * pressure_[i];
  parallel_for(n, [&](std::size_t i) {
    const auto row = neighbours.row(i);
    const float* g = row.gradients;
    const std::uint32_t* j = row.index.data();
    Lanes<Dim> sum = row_sum<Dim>(row.size(), [&](std::size_t k) {
      return volume_pressure_[j[k]] * load<Dim>(g + k * static_cast<std::size_t>(Dim));
    });
    sum += pressure_[i] * load<Dim>(&gradient_sum_[i * lane_width<Dim>]);
    store<Dim>(&displacement_[i * lane_width<Dim>], -mobility_[i] * volume_[i] * sum);
  }, Neighbours<Dim>::block_size);
}

/// Returns the sum of the errors: the compression left over the target, and the expansion that pressure still causes,
/// as far as lowering the pressure to zero could undo it. Without the second a stale first guess would push unseen.
template <int Dim>
double PressureSolver<Dim>::find_residuals(const Neighbours<Dim>& neighbours) {
  const std::size_t n = pressure_.size();
  parallel_for(n, [&](std::size_t i) {
    const auto row = neighbours.row(i);
    const float* g = row.gradients;
    const std::uint32_t* j = row.index.data();
    const Lanes<Dim> sum = row_sum<Dim>(row.size(), [&](std::size_t k) {
      return load<Dim>(&displacement_[j[k] * lane_width<Dim>]) * load<Dim>(g + k * static_cast<std::size_t>(Dim));
    });
    const float own = dot<Dim>(load<Dim>(&displacement_[i * lane_width<Dim>]),
                               load<Dim>(&gradient_sum_[i * lane_width<Dim>])) / volume_[i];
    float others = 0;
    for (int a = 0; a < Dim; ++a) others += sum[a];
    residual_[i] = compression_[i] + own - others - target_[i];
  }, Neighbours<Dim>::block_size);
  return parallel_sum(n, 0.0, [&](std::size_t i) {
    const float r = residual_[i];
    return static_cast<double>(r > 0 ? r : std::min(-r, relaxation * pressure_[i] / step_[i]));
  });
}

template <int Dim>
void PressureSolver<Dim>::update_pressures() {
  for (std::size_t i = 0; i < pressure_.size(); ++i)
    pressure_[i] = std::max(0.0f, pressure_[i] + step_[i] * residual_[i]);
}

template <int Dim>
Vec<Dim> apply_pressure(std::vector<Vec<Dim>>& v, const Particles<Dim>& particles, const Neighbours<Dim>& neighbours,
                        const std::vector<double>& pressure, double dt) {
  const std::size_t n = particles.size();
  parallel_for(n, [&](std::size_t i) {
    const auto row = neighbours.row(i);
    const double p_i = pressure[i], volume = particles.volume[i];
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t k = 0; k < row.size(); ++k) {
      const std::size_t j = row.index[k];
      const double weight = (volume * particles.volume[j]) * (p_i + pressure[j]);
      for (int a = 0; a < Dim; ++a) sum[a] += weight * static_cast<double>(row.gradient(k)[a]);
    }
    sum += (2 * volume * p_i) * neighbours.boundary_gradient()[i];
    v[i] -= (dt / particles.mass[i]) * sum;
  }, Neighbours<Dim>::block_size);
  return parallel_sum<Vec<Dim>>(n, Vec<Dim>::Zero(), [&](std::size_t i) -> Vec<Dim> {
    return (-2 * dt * particles.volume[i] * pressure[i]) * neighbours.boundary_gradient()[i];
  });
}

template <int Dim>
std::size_t PressureSolver<Dim>::bytes() const {
  return spindrift::bytes(compression_, target_, residual_, step_, pressure_, volume_pressure_) +
         spindrift::bytes(gradient_sum_, mobility_, volume_, displacement_);
}

template class PressureSolver<2>;
template class PressureSolver<3>;
template Vec<2> apply_pressure(std::vector<Vec<2>>&, const Particles<2>&, const Neighbours<2>&,
                               const std::vector<double>&, double);
template Vec<3> apply_pressure(std::vector<Vec<3>>&, const Particles<3>&, const Neighbours<3>&,
                               const std::vector<double>&, double);

}  // namespace spindrift
