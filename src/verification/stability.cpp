#include "verification/stability.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "simulation/frame.hpp"
#include "simulation/scene_reader.hpp"
#include "verification/cases.hpp"
#include "verification/energy.hpp"

namespace spindrift {
namespace {

constexpr double largest_mass_error = 1e-10;
constexpr double largest_energy_growth = 0.05;
constexpr double longest_step_seconds = 2;

/// Of the whole run.
struct Watch {
  double first_energy = 0, most_energy = 0;
  std::string fault;  ///< the first

  void expect(bool good, const std::string& what, std::uint64_t step) {
    if (!good && fault.empty()) fault = fmt::format("{} in step {}", what, step);
  }
};

template <int Dim>
double fastest(const Simulation<Dim>& s) {
  double speed = 0;
  if (s.dense())
    for (const Vec<Dim>& v : s.dense()->particles.velocity) speed = std::max(speed, v.norm());
  return s.suspension() ? std::max(speed, s.suspension()->max_speed()) : speed;
}

template <int Dim>
bool sound(const Particles<Dim>& p) {
  for (std::size_t i = 0; i < p.size(); ++i)
    if (!p.position[i].allFinite() || !p.velocity[i].allFinite() || !(p.mass[i] > 0) || !(p.volume[i] > 0) ||
        !std::isfinite(p.pressure[i]))
      return false;
  return true;
}

template <int Dim>
bool sound(const Suspension<Dim>& air) {
  for (const auto& u : air.velocity())
    for (const double value : u.values())
      if (!std::isfinite(value)) return false;
  return std::ranges::all_of(air.smoke_mass().values(), [](double m) { return m >= 0 && std::isfinite(m); });
}

template <int Dim>
void look_at(const Simulation<Dim>& s, TrialResult& result, Watch& watch) {
  const std::uint64_t step = s.n_steps();
  if (s.dense()) watch.expect(sound(s.dense()->particles), "snow is not finite or has no mass", step);
  if (s.suspension()) {
    watch.expect(sound(*s.suspension()), "air or smoke is not finite, or smoke is negative", step);
    const ProjectionResult& pressure = s.report().suspension.pressure;
    result.pressure_iterations = std::max(result.pressure_iterations, pressure.iterations);
    watch.expect(pressure.converged,
                 fmt::format("the air's pressure did not converge (residual {:.1e})", pressure.residual), step);
  }
  result.mass_error = std::max(result.mass_error, std::abs(s.mass_error()));
  watch.expect(result.mass_error <= largest_mass_error, fmt::format("mass error {:.1e}", result.mass_error), step);
  result.shortest_step = std::min(result.shortest_step, s.report().dt);
  result.fastest = std::max(result.fastest, fastest(s));
  watch.most_energy = std::max(watch.most_energy, mechanical_energy(s));
  result.energy_growth = watch.first_energy > 0 ? watch.most_energy / watch.first_energy - 1 : 0;
}

/// Steps, looks at each, and returns the digest of the end.
template <int Dim>
std::string watched_run(const Scene& scene, TrialResult& result, Watch& watch) {
  const Trial& trial = result.trial;
  result.shortest_step = std::numeric_limits<double>::infinity();
  Simulation<Dim> simulation(scene);
  watch.first_energy = watch.most_energy = mechanical_energy(simulation);
  for (int i = 0; i < trial.steps; ++i) {
    const auto start = std::chrono::steady_clock::now();
    simulation.step();
    const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    result.seconds = std::max(result.seconds, seconds);
    watch.expect(seconds <= longest_step_seconds, fmt::format("{:.1f} s of run time", seconds), simulation.n_steps());
    look_at(simulation, result, watch);
  }
  result.steps = simulation.n_steps();
  result.rejected = simulation.back_off().n_rejected_in_all;
  if (!trial.beyond)
    watch.expect(result.energy_growth <= largest_energy_growth,
                 fmt::format("energy grew by {:.2g} %, seen at the end", 100 * result.energy_growth), result.steps);
  if (const auto& look = std::get<Look<Dim>>(trial.look); look && watch.fault.empty()) watch.fault = look(simulation);
  return state_digest(simulation);
}

/// The same steps, on one thread and with nobody looking.
template <int Dim>
std::string bare_run(const Scene& scene, int n_steps) {
  const ThreadLimit one_thread(1);
  Simulation<Dim> simulation(scene);
  for (int i = 0; i < n_steps; ++i) simulation.step();
  return state_digest(simulation);
}

template <int Dim>
void run(TrialResult& result, const Scene& scene) {
  Watch watch;
  const std::string first = watched_run<Dim>(scene, result, watch), second = bare_run<Dim>(scene, result.trial.steps);
  if (watch.fault.empty() && first != second) watch.fault = "another result on one thread";
  if (!watch.fault.empty()) result.verdict = Verdict::failed, result.reason = watch.fault;
}

}  // namespace

TrialResult run_trial(const Trial& trial) {
  TrialResult result;
  result.trial = trial;
  try {
    const Scene scene = parse_scene(scene_text(trial.scene), trial.scene, trial.settings);
    scene.scene.dim == 3 ? run<3>(result, scene) : run<2>(result, scene);
  } catch (const Error& error) {
    switch (error.code()) {
      case ExitCode::bad_input:
      case ExitCode::would_not_fit:
        result.verdict = Verdict::refused;
        break;
      case ExitCode::unstable:
        result.verdict = Verdict::stopped;
        break;
      default:
        result.verdict = Verdict::failed;
    }
    result.reason = error.what();
  }
  return result;
}

bool TrialResult::good() const {
  if (trial.refused) return verdict == Verdict::refused;
  return verdict == Verdict::passed || (trial.beyond && verdict == Verdict::stopped);
}

std::string_view name_of(Verdict verdict) {
  constexpr std::array<std::string_view, 4> names{"passed", "refused", "stopped", "failed"};
  return names[static_cast<std::size_t>(verdict)];
}

}  // namespace spindrift
