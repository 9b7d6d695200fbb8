#include "verification/refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

#include "core/error.hpp"
#include "simulation/instruments.hpp"

namespace spindrift {
namespace {

constexpr double ratio = std::numbers::sqrt2;  // between neighbouring scales

/// Counts are those of particles as large as the scene's own: finer snow is counted in fewer of them.
template <int Dim>
std::vector<Reading> readings_of(const Simulation<Dim>& end, const Instruments<Dim>& instruments, double particle) {
  std::vector<Reading> readings;
  const auto add = [&](const char* name, double value) { readings.push_back({name, value}); };
  if (end.dense()) {
    add("front position [m]", instruments.front);
    add("largest front speed [m/s]", instruments.front_speed_max);
    add("mass of the dense flow [kg]", end.dense_mass());
    add("particles of the dense flow", static_cast<double>(end.dense()->particles.size()) * particle);
  }
  if (end.cover() && end.scene().entrainment) {
    add("entrained mass [kg]", end.masses().entrained);
    add("entrained particles", static_cast<double>(end.masses().n_entrained) * particle);
  }
  if (end.suspension()) {
    add("mass of the smoke [kg]", end.smoke_mass());
    add("largest height of the cloud [m]", instruments.cloud_height_max);
  }
  return readings;
}

template <int Dim>
void run(RefinedRun& refined, const Scene& scene, double particle) {
  Simulation<Dim> simulation(scene);
  Instruments<Dim> instruments;
  instruments.follow(simulation);
  refined.cost = run_timed<Dim>(simulation, [&](const Simulation<Dim>& now) { instruments.follow(now); });
  refined.readings = readings_of<Dim>(simulation, instruments, particle);
}

}  // namespace

Scene scaled(const Scene& scene, std::string_view factor, double scale) {
  Scene out = scene;
  const bool all = factor == "all";
  if (all || factor == "time step") out.scene.max_step *= scale;
  if (out.dense_flow) {
    DenseFlowSection& dense = *out.dense_flow;
    if (all || factor == "spacing") dense.support_radius *= scale;
    if (all || factor == "time step") dense.cfl = std::min(1.0, dense.cfl * scale);
    if (all || factor == "tolerances") {
      dense.density_tolerance = std::min(0.5, dense.density_tolerance * scale * scale);
      dense.divergence_tolerance *= scale * scale;
      dense.relative_tolerance = std::min(1.0, dense.relative_tolerance * scale * scale);
    }
  }
  if (out.suspension) {
    SuspensionSection& air = *out.suspension;
    if (all || factor == "cell") air.cell_size *= scale;
    if (all || factor == "time step") air.cfl *= scale;
    if (all || factor == "tolerances") air.tolerance = std::min(0.5, air.tolerance * scale * scale);
  }
  return out;
}

std::vector<RefinedRun> planned_runs(const Scene& scene, bool quick) {
  std::vector<RefinedRun> runs;
  const auto add = [&](const char* factor, std::vector<double> scales) {
    for (const double scale : scales)
      if (!quick || scale >= 1) runs.push_back({factor, scale, {}, {}, {}});
  };
  add("all", {ratio * ratio, ratio, 1, 1 / ratio});
  if (scene.dense_flow) add("spacing", {ratio, 1 / ratio});
  if (scene.suspension) add("cell", {ratio, 1 / ratio});
  add("time step", {2, 0.5});
  add("tolerances", {10, 0.1});
  return runs;
}

Limit limit_of(const std::vector<double>& scales, const std::vector<double>& values) {
  Limit limit{values.back(), std::numeric_limits<double>::quiet_NaN(), false};
  const std::size_t n = values.size();
  if (n < 3) return limit;
  const double coarse = values[n - 3] - values[n - 2], fine = values[n - 2] - values[n - 1];
  const double order = std::log(coarse / fine) / std::log(scales[n - 2] / scales[n - 1]);
  if (!(order >= 0.5 && order <= 4)) return limit;
  limit.order = order;
  limit.extrapolated = true;
  limit.value -= fine / (coarse / fine - 1);
  return limit;
}

Refinement refine(const Scene& scene, std::vector<RefinedRun> runs,
                  const std::function<void(const RefinedRun&)>& on_run) {
  Refinement refinement{scene, std::move(runs), {}};
  for (RefinedRun& one : refinement.runs) {
    const Scene finer = scaled(scene, one.factor, one.scale);
    const double size = scene.dense_flow ? finer.dense_flow->support_radius / scene.dense_flow->support_radius : 1;
    const double particle = std::pow(size, scene.scene.dim);
    try {
      scene.scene.dim == 3 ? run<3>(one, finer, particle) : run<2>(one, finer, particle);
    } catch (const Error& error) {
      if (error.code() == ExitCode::bug) throw;
      one.failure = error.what();
    }
    if (on_run) on_run(one);
  }
  std::vector<double> scales;
  std::vector<std::vector<double>> values;
  for (const RefinedRun& one : refinement.runs) {
    if (one.factor != "all" || !one.failure.empty()) continue;
    scales.push_back(one.scale);
    values.resize(one.readings.size());
    for (std::size_t k = 0; k < one.readings.size(); ++k) values[k].push_back(one.readings[k].value);
  }
  for (const auto& value : values) refinement.limits.push_back(limit_of(scales, value));
  return refinement;
}

}  // namespace spindrift
