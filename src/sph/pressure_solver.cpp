#include "sph/pressure_solver.hpp"

#include <algorithm>
#include <cmath>

#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "sph/lanes.hpp"

namespace spindrift {
namespace {

/// Of the Jacobi iteration. The largest eigenvalue of the matrix scaled by its diagonal is about 2 in 2D and 2.5 in 3D
/// on the lattice of h = 2 d and more where it is disturbed; extrapolation is stable below 4/3 of its inverse. More
/// neighbours, more of it: with 0.35 a box in 3D bursts from h = 2.5 d on, with 0.2 it rests.
constexpr float relaxation = 0.35f;

/// Of the diagonal m / V dD_i/dp_i in units of h^-2, with h = 2 d: a quarter of its value on the lattice (2.1 in 2D,
/// 1.7 in 3D), which goes with the volume of a particle over that of the support, so that a particle with few
/// neighbours, or coincident ones, is not flung away.
constexpr double least_diagonal = 0.5;

/// The most compression that one step takes back, and the fastest [s^-1]: a particle that is wedged in can never be
/// freed at once, and a correction that did not shrink with dt would throw it about the faster the shorter the steps.
constexpr double largest_correction = 0.005;
constexpr double fastest_correction = 2.5;

/// The largest error of a single particle, in tolerances of the mean: the mean alone hides one that rings.
constexpr double largest_to_mean = 50;

/// What single precision can still tell from nothing, of the mean.
constexpr double least_tolerance = 1e-6;

/// Free volume from which on a particle may lose all of it in one step.
constexpr double loose = 0.1;

/// The largest dt D allowed where the volume sum is `free` below full.
double allowed_compression(double free, double dt) {
  constexpr double k = compression_relaxation;
  if (free < 0) return std::max(k * free, -std::min(largest_correction, fastest_correction * dt));
  return free * (k + (1 - k) * std::min(1.0, free / loose));
}

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
PressureSolver<Dim>::PressureSolver(const PressureOptions& options, double support_radius, double spacing)
    : options_(options),
      h_(support_radius),
      relaxation_(relaxation * static_cast<float>(std::pow(std::min(1.0, 2 * spacing / support_radius), Dim - 1))),
      least_diagonal_(least_diagonal * std::pow(2 * spacing / support_radius, Dim)) {}

template <int Dim>
void PressureSolver<Dim>::prepare(const Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt) {
  const std::size_t n = particles.size();
  for (auto* array : {&excess_, &residual_, &step_, &pressure_, &previous_, &volume_pressure_, &mobility_, &volume_})
    array->resize(n);
  gradient_sum_.resize(n * lane_width<Dim>);
  displacement_.resize(n * lane_width<Dim>);
  parallel_for(
      n,
      [&](std::size_t i) {
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
        const double own = mobility * g_sum.squaredNorm() + volume * squares;
        const double diagonal = std::max(own, mobility * least_diagonal_ / (h_ * h_));
        excess_[i] =
            static_cast<float>(dt * rate - allowed_compression(neighbours.full()[i] - neighbours.volume_sum()[i], dt));
        // Where pressure hardly moves the particle, each step would add to the last one's and none would help.
        pressure_[i] = previous_[i] = static_cast<float>(particles.pressure[i] * (own / diagonal));
        step_[i] = relaxation_ / static_cast<float>(dt * dt * diagonal);
        mobility_[i] = static_cast<float>(dt * dt * mobility);
        volume_[i] = static_cast<float>(volume);
        store<Dim>(&gradient_sum_[i * lane_width<Dim>], to_lanes<Dim>(g_sum));
      },
      Neighbours<Dim>::block_size);
}

template <int Dim>
double PressureSolver<Dim>::mean_excess() const {
  const double sum =
      parallel_sum(excess_.size(), 0.0, [&](std::size_t i) { return static_cast<double>(std::max(0.0f, excess_[i])); });
  return sum / static_cast<double>(excess_.size());
}

template <int Dim>
SolveReport PressureSolver<Dim>::solve(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt,
                                       Vec<Dim>& boundary_impulse) {
  const std::size_t n = particles.size();
  SolveReport report;
  if (n == 0) return report;
  prepare(particles, neighbours, dt);
  const double tolerance =
      std::min(compression_relaxation * options_.density_tolerance, 0.01 * options_.divergence_tolerance);
  const double mean_tolerance =
      options_.relative_tolerance > 0
          ? std::clamp(options_.relative_tolerance * mean_excess(), std::min(least_tolerance, tolerance), tolerance)
          : tolerance;
  double pace = 1;
  float share = 1;  // of the relaxation, less where even plain steps lead away
  for (double last_error = 0;; last_error = report.error) {
    find_displacements(neighbours);
    const auto [sum, largest] = find_residuals(neighbours);
    report.error = sum / static_cast<double>(n);
    const bool done = report.error <= mean_tolerance && largest <= largest_to_mean * tolerance && report.iterations > 0;
    if (done || report.iterations == options_.max_iterations) break;
    if (report.error > last_error && report.iterations > 0) {
      if (pace < 2) share *= 0.7f;
      pace = 1;
    }
    const double next_pace = 0.5 * (1 + std::sqrt(1 + 4 * pace * pace));
    update_pressures(share, static_cast<float>((pace - 1) / next_pace));
    pace = next_pace;
    ++report.iterations;
  }
  for (std::size_t i = 0; i < n; ++i) particles.pressure[i] = static_cast<double>(pressure_[i]);
  boundary_impulse += apply_pressure(particles.velocity, particles, neighbours, particles.pressure, dt);
  return report;
}

template <int Dim>
void PressureSolver<Dim>::find_displacements(const Neighbours<Dim>& neighbours) {
  const std::size_t n = pressure_.size();
  for (std::size_t i = 0; i < n; ++i) volume_pressure_[i] = volume_[i] * pressure_[i];
  parallel_for(
      n,
      [&](std::size_t i) {
        const auto row = neighbours.row(i);
        const float* g = row.gradients;
        const std::uint32_t* j = row.index.data();
        Lanes<Dim> sum = row_sum<Dim>(row.size(), [&](std::size_t k) {
          return volume_pressure_[j[k]] * load<Dim>(g + k * static_cast<std::size_t>(Dim));
        });
        sum += pressure_[i] * load<Dim>(&gradient_sum_[i * lane_width<Dim>]);
        store<Dim>(&displacement_[i * lane_width<Dim>], -mobility_[i] * volume_[i] * sum);
      },
      Neighbours<Dim>::block_size);
}

/// Returns sum and largest of the errors: the compression left over the target, and the expansion that pressure still
/// causes, as far as lowering the pressure to zero could undo it. Without the second a stale first guess would push
/// unseen.
template <int Dim>
typename PressureSolver<Dim>::Residuals PressureSolver<Dim>::find_residuals(const Neighbours<Dim>& neighbours) {
  const std::size_t n = pressure_.size();
  parallel_for(
      n,
      [&](std::size_t i) {
        const auto row = neighbours.row(i);
        const float* g = row.gradients;
        const std::uint32_t* j = row.index.data();
        const Lanes<Dim> sum = row_sum<Dim>(row.size(), [&](std::size_t k) {
          return load<Dim>(&displacement_[j[k] * lane_width<Dim>]) * load<Dim>(g + k * static_cast<std::size_t>(Dim));
        });
        const float own =
            dot<Dim>(load<Dim>(&displacement_[i * lane_width<Dim>]), load<Dim>(&gradient_sum_[i * lane_width<Dim>])) /
            volume_[i];
        float others = 0;
        for (int a = 0; a < Dim; ++a) others += sum[a];
        residual_[i] = excess_[i] + own - others;
      },
      Neighbours<Dim>::block_size);
  return parallel_reduce(
      n, Residuals{},
      [&](std::size_t begin, std::size_t end) {
        Residuals all;
        for (std::size_t i = begin; i < end; ++i) {
          const float r = residual_[i];
          const auto error = static_cast<double>(r > 0 ? r : std::min(-r, relaxation_ * pressure_[i] / step_[i]));
          all.sum += error;
          all.largest = std::max(all.largest, error);
        }
        return all;
      },
      [](const Residuals& a, const Residuals& b) {
        return Residuals{a.sum + b.sum, std::max(a.largest, b.largest)};
      });
}

template <int Dim>
void PressureSolver<Dim>::update_pressures(float share, float momentum) {
  for (std::size_t i = 0; i < pressure_.size(); ++i) {
    const float next = std::max(0.0f, pressure_[i] + share * step_[i] * residual_[i]);
    pressure_[i] = std::max(0.0f, next + momentum * (next - previous_[i]));
    previous_[i] = next;
  }
}

template <int Dim>
Vec<Dim> apply_pressure(std::vector<Vec<Dim>>& v, const Particles<Dim>& particles, const Neighbours<Dim>& neighbours,
                        const std::vector<double>& pressure, double dt) {
  const std::size_t n = particles.size();
  parallel_for(
      n,
      [&](std::size_t i) {
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
      },
      Neighbours<Dim>::block_size);
  return parallel_sum<Vec<Dim>>(n, Vec<Dim>::Zero(), [&](std::size_t i) -> Vec<Dim> {
    return (-2 * dt * particles.volume[i] * pressure[i]) * neighbours.boundary_gradient()[i];
  });
}

template <int Dim>
std::size_t PressureSolver<Dim>::bytes() const {
  return spindrift::bytes(excess_, residual_, step_, pressure_, previous_) +
         spindrift::bytes(volume_pressure_, gradient_sum_, mobility_, volume_, displacement_);
}

template class PressureSolver<2>;
template class PressureSolver<3>;
template Vec<2> apply_pressure(std::vector<Vec<2>>&, const Particles<2>&, const Neighbours<2>&,
                               const std::vector<double>&, double);
template Vec<3> apply_pressure(std::vector<Vec<3>>&, const Particles<3>&, const Neighbours<3>&,
                               const std::vector<double>&, double);

}  // namespace spindrift
