#include "sph/dense_flow.hpp"

#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "terrain/swept.hpp"

namespace spindrift {
namespace {

/// Largest sqrt(p / rho) dt / d. Particles under pressure rattle with about this frequency times dt, and the step,
/// which takes the forces' directions from its start, is unstable from about 1 on (a column of 50 rows: 0.8 rests, 1.2
/// bursts).
constexpr double wave_cfl = 0.6;

DenseFlowOptions checked(const DenseFlowOptions& o) {
  const auto require = [](bool good, const char* what) {
    if (!good) throw Error(ExitCode::bad_input, std::string("dense flow: ") + what);
  };
  const auto positive = [](double value) { return value > 0 && std::isfinite(value); };
  require(positive(o.support_radius), "support_radius must be positive");
  require(o.spacing > 0 && o.spacing < o.support_radius, "spacing must be positive and less than support_radius");
  require(positive(o.density), "density must be positive");
  require(o.viscosity >= 0 && std::isfinite(o.viscosity), "viscosity must not be negative");
  require(positive(o.pressure.density_tolerance), "density_tolerance must be positive");
  require(positive(o.pressure.divergence_tolerance), "divergence_tolerance must be positive");
  require(o.pressure.relative_tolerance >= 0, "relative_tolerance must not be negative");
  require(o.pressure.max_iterations >= 1, "max_iterations must be at least 1");
  require(o.solver == DenseSolver::dfsph || positive(o.sound_speed), "sound_speed must be positive for wcsph");
  return o;
}

template <int Dim>
[[noreturn]] void throw_unstable(const Particles<Dim>& particles, std::size_t i, const char* after) {
  std::ostringstream message;
  message << "particle " << particles.id[i] << " has velocity (" << particles.velocity[i].transpose() << ") m/s at ("
          << particles.position[i].transpose() << ") m " << after;
  throw Error(ExitCode::unstable, message.str());
}

template <int Dim>
void check_velocities(const Particles<Dim>& particles, const char* after) {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  const std::size_t bad = parallel_reduce(
      particles.size(), none,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          if (!particles.velocity[i].allFinite()) return i;
        return none;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  if (bad != none) throw_unstable(particles, bad, after);
}

}  // namespace

template <int Dim>
DenseFlow<Dim>::DenseFlow(const DenseFlowOptions& options)
    : options_(checked(options)),
      wall_kernel_(options.support_radius, options.spacing, options.kernel),
      cells_(options.support_radius),
      pressure_solver_(options.pressure, options.support_radius, options.spacing),
      viscosity_solver_(options.spacing),
      artificial_viscosity_(options.spacing) {}

template <int Dim>
void DenseFlow<Dim>::sort(const Walls<Dim>& walls, Stages& stages, double ground_reach) {
  {
    auto timed = stages.time("dense_flow.sort");
    cells_.build(particles);
  }
  if (!walls.terrain) return;
  auto timed = stages.time("dense_flow.ground");
  walls.terrain->find_feet(feet_, particles.position, ground_reach, options_.support_radius);
}

template <int Dim>
void DenseFlow<Dim>::find_neighbours(const Walls<Dim>& walls, const CoverView<Dim>& cover, Stages& stages) {
  auto timed = stages.time("dense_flow.neighbours");
  neighbours_.find(particles, cells_, walls, wall_kernel_, feet_, cover, options_.no_slip && options_.viscosity > 0,
                   options_.neighbour_search);
}

template <int Dim>
VelocitySolve<Dim> DenseFlow<Dim>::solve_velocity(double dt, Stages& stages) {
  VelocitySolve<Dim> done;
  check_velocities(particles, "before the dense flow's solve");
  if (options_.viscosity > 0) {
    auto timed = stages.time("dense_flow.viscosity");
    done.viscosity = viscosity_solver_.solve(particles, neighbours_, options_.viscosity, dt, done.boundary_impulse);
  }
  if (options_.solver == DenseSolver::wcsph) {
    auto timed = stages.time("dense_flow.wcsph");
    wave_speed_.assign(particles.size(), options_.sound_speed);
    artificial_viscosity_.apply(particles, neighbours_, wave_speed_, dt);
    done.boundary_impulse += apply_state_pressure(particles, neighbours_, options_.sound_speed, options_.density, dt);
  } else {
    {
      auto timed = stages.time("dense_flow.artificial_viscosity");
      wave_speed_.resize(particles.size());
      parallel_for(particles.size(),
                   [&](std::size_t i) { wave_speed_[i] = std::sqrt(particles.pressure[i] / options_.density); });
      artificial_viscosity_.apply(particles, neighbours_, wave_speed_, dt);
    }
    auto timed = stages.time("dense_flow.pressure");
    const SolveReport report = pressure_solver_.solve(particles, neighbours_, dt, done.boundary_impulse);
    done.density = {report.iterations, report.error / compression_relaxation};
    done.divergence = {report.iterations, 100 * report.error};
  }
  check_velocities(particles, "after the dense flow's solve");
  return done;
}

template <int Dim>
Vec<Dim> DenseFlow<Dim>::move(double dt, const Walls<Dim>& walls, Stages& stages) {
  auto timed = stages.time("dense_flow.move");
  return parallel_sum<Vec<Dim>>(particles.size(), Vec<Dim>::Zero(), [&](std::size_t i) -> Vec<Dim> {
    Vec<Dim>& x = particles.position[i];
    Vec<Dim>& v = particles.velocity[i];
    const Vec<Dim> before = v, start = x;
    x += dt * v;
    for (const Box<Dim>& obstacle : walls.obstacles)
      if (const auto hit = entry_into<Dim>(obstacle, start, x)) {
        x += (hit->place - x.dot(hit->normal.cwiseAbs())) * hit->normal.cwiseAbs();
        v -= std::min(0.0, v.dot(hit->normal)) * hit->normal;
      }
    const auto put_back = [&](double distance, const Vec<Dim>& normal) {
      x -= distance * normal;
      v -= std::min(0.0, v.dot(normal)) * normal;
    };
    walls.for_each_near(x, 0, put_back);
    return particles.mass[i] * (v - before);
  });
}

template <int Dim>
Removed<Dim> DenseFlow<Dim>::remove_outside(const Walls<Dim>& walls) {
  return remove_if(particles, [&](std::size_t i) { return walls.outside(particles.position[i]); });
}

template <int Dim>
void DenseFlow<Dim>::compact(double dt, double time) {
  if (time <= 0) return;
  const double share = -std::expm1(-dt / time);
  for (std::size_t i = 0; i < particles.size(); ++i)
    particles.volume[i] += (particles.mass[i] / options_.density - particles.volume[i]) * share;
}

template <int Dim>
double DenseFlow<Dim>::time_step_limit(double cfl, double gravity) const {
  if (particles.empty()) return std::numeric_limits<double>::infinity();
  const double d = options_.spacing;
  const double fastest = std::sqrt(
      parallel_max(particles.size(), 0.0, [&](std::size_t i) { return particles.velocity[i].squaredNorm(); }));
  const double limit = std::min(cfl * d / fastest, cfl * std::sqrt(d / gravity));
  if (options_.solver == DenseSolver::wcsph) {
    const double lightness = parallel_max(particles.size(), 1.0, [&](std::size_t i) {
      return options_.density * particles.volume[i] / particles.mass[i];
    });
    return std::min(limit, wcsph_time_step(options_.sound_speed * std::sqrt(lightness), d));
  }
  const double wave = std::sqrt(parallel_max(particles.size(), 0.0, [&](std::size_t i) {
    return particles.pressure[i] * particles.volume[i] / particles.mass[i];
  }));
  return std::min(limit, wave_cfl * d / wave);
}

template <int Dim>
std::size_t DenseFlow<Dim>::bytes() const {
  return particles.bytes() + wall_kernel_.bytes() + cells_.bytes() + neighbours_.bytes() + pressure_solver_.bytes() +
         viscosity_solver_.bytes() + artificial_viscosity_.bytes() + spindrift::bytes(wave_speed_) +
         spindrift::bytes(feet_);
}

template class DenseFlow<2>;
template class DenseFlow<3>;

}  // namespace spindrift
