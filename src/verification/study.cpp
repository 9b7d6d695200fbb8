#include "verification/study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "core/error.hpp"
#include "core/median.hpp"
#include "simulation/scene_reader.hpp"
#include "verification/cases.hpp"

namespace spindrift {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

template <int Dim>
void measure(Point& point, const Scene& scene, const Compare<Dim>& compare, const StudyOptions& options) {
  std::vector<double> seconds;
  do {
    Simulation<Dim> simulation(scene);
    const Comparison<Dim> comparison = compare(simulation);
    point.cost = run_timed<Dim>(simulation, comparison.after_step);
    point.outcome = comparison.outcome(simulation);
    seconds.push_back(point.cost.seconds);
  } while (!options.quick && seconds.front() < options.long_run && static_cast<int>(seconds.size()) < options.repeats);
  point.cost.seconds = median(seconds);
  point.cost.repeats = static_cast<int>(seconds.size());
}

/// Whether a series varies how the case is computed, and not the case.
bool is_numerical(const std::string& factor) {
  constexpr std::array<std::string_view, 9> numerical{"resolution", "scheme",         "solver",
                                                      "tolerance",  "time step",      "kernel",
                                                      "spacing",    "support radius", "neighbour search"};
  return std::ranges::find(numerical, factor) != numerical.end();
}

bool is_error(double value) {
  return std::isfinite(value) && value > 0;
}

}  // namespace

bool Point::inside() const {
  return failure.empty() && outcome.l2 <= gate && std::ranges::all_of(outcome.checks, &Check::passed);
}

std::vector<const Point*> CaseResult::of(const Series& series) const {
  std::vector<const Point*> found;
  for (const Point& point : points)
    if (point.factor == series.factor && point.series == series.label) found.push_back(&point);
  return found;
}

double CaseResult::order(const Series& series) const {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const Point* point : of(series)) {
    if (!(point->size > 0) || !is_error(point->outcome.l2)) continue;
    const double log_size = std::log(point->size), log_error = std::log(point->outcome.l2);
    n += 1, x += log_size, y += log_error, xx += log_size * log_size, xy += log_size * log_error;
  }
  return n < 2 ? std::numeric_limits<double>::quiet_NaN() : (n * xy - x * y) / (n * xx - x * x);
}

bool CaseResult::passed() const {
  return std::ranges::all_of(what.gated(), [&](const Series& series) {
    return std::ranges::all_of(of(series), [](const Point* point) { return point->inside(); }) &&
           (what.least_order == 0 || order(series) >= what.least_order);
  });
}

const Point* CaseResult::cheapest(double l2) const {
  const Point* best = nullptr;
  for (const Point& point : points)
    if (is_numerical(point.factor) && point.failure.empty() && point.outcome.l2 <= l2 &&
        (!best || point.cost.seconds < best->cost.seconds))
      best = &point;
  return best;
}

template <int Dim>
Cost run_timed(Simulation<Dim>& simulation, const std::function<void(const Simulation<Dim>&)>& after_step) {
  Cost cost;
  while (!simulation.done()) {
    const auto start = std::chrono::steady_clock::now();
    simulation.step();
    cost.seconds += seconds_since(start);
    cost.dense_iterations += simulation.report().dense.density.iterations;
    cost.pressure_iterations += simulation.report().suspension.pressure.iterations;
    if (after_step) after_step(simulation);
  }
  cost.repeats = 1;
  cost.steps = simulation.n_steps();
  const double n = std::max<double>(1, static_cast<double>(cost.steps));
  cost.time_step = simulation.time() / n;
  cost.dense_iterations /= n;
  cost.pressure_iterations /= n;
  for (const auto& [part, size] : simulation.memory()) cost.bytes += size;
  if (simulation.dense()) cost.n_particles = simulation.dense()->particles.size();
  if (simulation.suspension()) cost.n_cells = simulation.suspension()->smoke_mass().size();
  return cost;
}

template Cost run_timed<2>(Simulation<2>&, const std::function<void(const Simulation<2>&)>&);
template Cost run_timed<3>(Simulation<3>&, const std::function<void(const Simulation<3>&)>&);

Scene scene_of(const Case& what, const Series& series, const Level& level) {
  std::vector<std::string> settings = series.settings;
  settings.insert(settings.end(), level.settings.begin(), level.settings.end());
  return parse_scene(scene_text(what.scene), what.scene, settings);
}

CaseResult run_case(const Case& what, const StudyOptions& options) {
  CaseResult result{what, {}};
  if (options.quick) {
    result.what.series.resize(what.gated().size());
    for (Series& series : result.what.series)
      if (series.levels.size() > 2) series.levels.resize(2);
  }
  for (const Series& series : result.what.series)
    for (const Level& level : series.levels) {
      Point point{series.factor, series.label, level.label, level.size, level.gate, {}, {}, {}};
      try {
        const Scene scene = scene_of(what, series, level);
        std::visit([&](const auto& compare) { measure(point, scene, compare, options); }, what.compare);
      } catch (const Error& error) {
        if (error.code() == ExitCode::bug) throw;
        point.failure = error.what();
      } catch (const std::out_of_range& error) {
        point.failure = fmt::format("the result lies outside what the case looks at ({})", error.what());
      }
      if (options.on_point) options.on_point(what, point);
      result.points.push_back(std::move(point));
    }
  return result;
}

}  // namespace spindrift
