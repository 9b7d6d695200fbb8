#include <fmt/format.h>

#include <algorithm>

#include "verification/stability.hpp"
#include "verification/trial_looks.hpp"

// The numbers F1 to F19 are those of docs/stability.md.

namespace spindrift {
namespace {

using Settings = std::vector<std::string>;

const char* const slope = "verification/extreme_slope.toml";
const char* const box = "verification/extreme_box.toml";
const char* const particles = "verification/extreme_particles.toml";
const char* const pockets = "verification/extreme_pockets.toml";

Trial trial(const char* set, const char* name, const char* scene, Settings settings) {
  return {set, name, scene, std::move(settings)};
}

Trial refusal(const char* set, const char* name, const char* scene, Settings settings) {
  Trial one = trial(set, name, scene, std::move(settings));
  one.refused = true;
  return one;
}

std::vector<Trial> counts() {
  const Settings one{"release[0].radius=0.03", "release[1].center=[3.9, 3.9]", "release[1].radius=0.03"};
  return {
      trial("F2", "one particle", particles, one),
      with_look(trial("F2", "two particles in one place", particles,
                      {"release[0].radius=0.03", "release[1].radius=0.03", "release[1].center=[1.5, 2]",
                       "release[0].velocity=[0, 0]", "release[1].velocity=[0, 0]", "domain.gravity=[0, 0]",
                       "suspension.air_density=1e-3"}),
                momentum_zero),
      trial("F2", "two balls in one place", particles, {"release[1].center=[1.5, 2]"}),
      trial("F2", "2,500 particles in one cell", particles,
            {"suspension.cell_size=4", "dense_flow.support_radius=0.02", "release[1].center=[1.5, 2]"}),
  };
}

std::vector<Trial> stiffness() {
  std::vector<Trial> all;
  for (const char* k : {"0", "1e3", "1e6"})
    for (const char* law : {"air", "paper"})
      for (const char* cfl : {"1", "100"})
        all.push_back({"F3",
                       fmt::format("k_drag = {}, law {}, air CFL {}", k, law, cfl),
                       slope,
                       {fmt::format("coupling.drag.constant={}", k), fmt::format("coupling.drag.law={}", law),
                        fmt::format("suspension.cfl={}", cfl), "scene.max_step=1"}});
  all.push_back(refusal("F3", "k_drag = 1e12", slope, {"coupling.drag.constant=1e12"}));
  const Settings stiff{"coupling.drag.constant=1e4", "coupling.drag.law=paper"};
  for (const char* density : {"5", "1e5"}) {
    all.push_back(trial("F3", "snow, stiff drag", slope, stiff));
    all.back().name = fmt::format("snow of {} kg/m3, stiff drag", density);
    all.back().settings.push_back(fmt::format("dense_flow.density={}", density));
  }
  all.push_back(trial("F3", "snow lighter than air, stiff drag", slope, stiff));
  all.back().settings.emplace_back("dense_flow.density=1e-3");
  all.back().beyond = true;
  for (const char* smoke : {"1.2e-4", "12", "12000"})
    all.push_back({"F4",
                   fmt::format("smoke of {} kg/m3 in a closed box", smoke),
                   box,
                   {smoke == std::string("12000") ? "smoke.density=10000" : fmt::format("smoke.density={}", smoke)}});
  all.push_back(
      trial("F4", "air of 1e-3 kg/m3 under smoke of 10", box, {"suspension.air_density=1e-3", "smoke.density=10"}));
  all.push_back(trial("F5", "snow that turns into smoke at once", slope, {"coupling.generation.constant=1000"}));
  all.push_back(trial("F5", "snow that may lose all its mass", slope,
                      {"coupling.generation.constant=1000", "coupling.min_mass=0"}));
  all.push_back(trial("F6", "overlap of one particle", particles,
                      {"release[0].radius=0.03", "release[1].radius=0.03", "suspension.cell_size=0.5"}));
  all.push_back(trial("F6", "no overlap", slope, {"coupling.overlap_fraction=0"}));
  all.push_back(trial("F6", "overlap everywhere", slope, {"coupling.overlap_fraction=10"}));
  return all;
}

std::vector<Trial> faults_and_speeds() {
  return {
      trial("F8", "three sealed chambers", pockets, {}),
      trial("F8", "closed box with snow, no open side", box, {}),
      refusal("F9", "density nan", slope, {"dense_flow.density=nan"}),
      refusal("F9", "wind inf", slope, {"suspension.wind=[inf, 0]"}),
      refusal("F9", "velocity nan", slope, {"release.velocity=[nan, 0]"}),
      refusal("F9", "terrain nan", slope, {"terrain.shape=polyline", "terrain.points=[[0, nan], [20, 0]]"}),
      refusal("F9", "negative mass", slope, {"release.density=-5"}),
      trial("F10", "300 m/s into a wall", particles,
            {"release[0].velocity=[300, 0]", "release[1].velocity=[300, 0]", "domain.right=closed"}),
      trial("F10", "opposed jets of 300 m/s", particles,
            {"release[0].velocity=[300, 0]", "release[1].velocity=[-300, 0]"}),
      trial("F10", "opposed jets of 1000 m/s", particles,
            {"release[0].velocity=[1000, 0]", "release[1].velocity=[-1000, 0]"}),
      trial("F10", "wcsph faster than its sound", particles,
            {"release[0].velocity=[100, 0]", "release[1].velocity=[-100, 0]", "dense_flow.solver=wcsph",
             "dense_flow.sound_speed=10"}),
      trial("F11", "a column 200 particles high", box,
            {"dense_flow.support_radius=0.02", "release.upper=[0.1, 2]", "suspension.cell_size=0.5"}),
      trial("F11", "the same by wcsph", box,
            {"dense_flow.support_radius=0.02", "release.upper=[0.1, 2]", "suspension.cell_size=0.5",
             "dense_flow.solver=wcsph"}),
      trial("F12", "air of 1e4 m2/s", slope, {"suspension.viscosity=1e4"}),
      trial("F12", "snow of 1e6 Pa s", slope, {"dense_flow.viscosity=1e6"}),
      trial("F12", "snow of 1e6 Pa s, held by the ground", slope,
            {"dense_flow.viscosity=1e6", "dense_flow.wall=no_slip"}),
      trial("F14", "cells five times the support radius", slope, {"suspension.cell_size=1.05"}),
      trial("F14", "cells of a tenth of the support radius", particles, {"suspension.cell_size=0.02"}),
      trial("F15", "one ball inside the other", particles,
            {"release[0].radius=0.5", "release[1].center=[1.55, 2.02]", "release[1].radius=0.25"}),
      trial("F16", "a hundred kilometres from the origin", particles,
            {"domain.lower=[100000, 0]", "domain.upper=[100004, 4]", "release[0].center=[100001.5, 2]",
             "release[1].center=[100002.5, 2]"}),
  };
}

std::vector<Trial> rest_and_steps() {
  const Settings at_rest{"scene.end_time=1000", "smoke.density=1e-6", "coupling.generation.constant=0"};
  Trial ground = with_look(trial("F18", "10,000 steps at rest on the ground", box, at_rest), quiet);
  ground.settings.insert(ground.settings.end(),
                         {"terrain.shape=polyline", "terrain.points=[[-1, 0.5], [5, 0.5]]", "release.lower=[0, 0.5]",
                          "release.upper=[4, 1.3]", "dense_flow.friction_acts_on=column"});
  Trial pool = with_look(trial("F18", "10,000 steps of a frictionless pool", box, at_rest), quiet);
  pool.settings.insert(pool.settings.end(), {"release.upper=[4, 0.8]", "suspension.cell_size=0.5"});
  ground.steps = pool.steps = 10000;
  std::vector<Trial> all{ground, pool};
  for (const char* solver : {"dfsph", "wcsph"})
    for (const char* cfl : {"0.1", "0.4", "1"})
      for (const char* radius : {"0.2", "0.1"})
        all.push_back({"F19",
                       fmt::format("{} at CFL {}, h = {} m", solver, cfl, radius),
                       box,
                       {fmt::format("dense_flow.solver={}", solver), fmt::format("dense_flow.cfl={}", cfl),
                        fmt::format("dense_flow.support_radius={}", radius)}});
  for (const std::string scheme : {"semi_lagrangian", "maccormack", "reflection"})
    for (const int cfl : {1, 10, 100}) {
      all.push_back(trial("F19", "air", pockets, {"scene.max_step=10"}));
      all.back().name = fmt::format("{} at CFL {}", scheme, cfl);
      all.back().settings.push_back(fmt::format("suspension.scheme={}", scheme));
      all.back().settings.push_back(fmt::format("suspension.cfl={}", cfl));
      all.back().beyond = scheme == "reflection" && cfl > 10;
    }
  return all;
}

}  // namespace

std::vector<Trial> extreme_trials() {
  std::vector<Trial> all;
  for (auto* group : {shape_trials, counts, stiffness, faults_and_speeds, rest_and_steps})
    for (Trial& one : group()) all.push_back(std::move(one));
  std::ranges::stable_sort(all, {}, [](const Trial& one) { return std::stoi(one.set.substr(1)); });
  return all;
}

}  // namespace spindrift
