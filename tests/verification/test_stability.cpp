// The extreme set and a part of the stability map: nothing in the documented range may fail.

#include <catch2/catch.hpp>
#include <set>

#include "simulation/scene_reader.hpp"
#include "verification/cases.hpp"
#include "verification/energy.hpp"
#include "verification/stability.hpp"

using namespace spindrift;

namespace {

void check_good(const Trial& trial) {
  const TrialResult result = run_trial(trial);
  CAPTURE(trial.set, trial.name, std::string(name_of(result.verdict)), result.reason, result.mass_error,
          result.energy_growth);
  CHECK(result.good() == trial.remark.empty());  // what is mended loses its remark
}

bool of_shape(const Trial& trial) {
  return trial.set == "F1" || trial.set == "F7" || trial.set == "F13";
}

}  // namespace

TEST_CASE("The extreme set goes as it should", "[stability][slow]") {
  std::set<std::string> sets;
  for (Trial trial : extreme_trials()) {
    sets.insert(trial.set);
    if (of_shape(trial)) continue;
    trial.steps = std::min(trial.steps, 1000);
    check_good(trial);
  }
  CHECK(sets.size() >= 18);
}

TEST_CASE("Extreme ground, grids and obstacles go as they should in 2D and 3D (F1, F7, F13)", "[stability][slow]") {
  for (const Trial& trial : shape_trials()) check_good(trial);
}

TEST_CASE("Forty points of the stability map pass", "[stability][slow]") {
  for (const Trial& trial : map_trials(40)) check_good(trial);
}

TEST_CASE("The map is a Latin hypercube, the same every time", "[stability]") {
  const auto trials = map_trials(20), again = map_trials(20);
  for (std::size_t axis = 0; axis < trials.front().parameters.size(); ++axis) {
    std::set<double> values;
    for (std::size_t i = 0; i < trials.size(); ++i) {
      values.insert(trials[i].parameters[axis].second);
      CHECK(trials[i].parameters[axis].second == again[i].parameters[axis].second);
    }
    CHECK(values.size() == 20);
  }
  // The slope, which is linear from 1 to 89 degrees: one point in every twentieth.
  std::set<int> strata;
  for (const Trial& trial : trials)
    for (const auto& [name, value] : trial.parameters)
      if (name == "slope [deg]") strata.insert(static_cast<int>((value - 1) / 88 * 20));
  CHECK(strata.size() == 20);
}

TEST_CASE("A trial that must be refused and runs, or must run and is refused, is not good", "[stability]") {
  Trial trial = extreme_trials().back();
  trial.steps = 1;
  trial.refused = true;
  CHECK(!run_trial(trial).good());
  trial.refused = false;
  CHECK(run_trial(trial).good());
  trial.settings.emplace_back("suspension.cfl=nan");
  const TrialResult refused = run_trial(trial);
  CHECK(refused.verdict == Verdict::refused);
  CHECK(!refused.good());
  trial.settings.back() = "suspension.cfl=1";
  std::get<Look<2>>(trial.look) = [](const Simulation<2>&) { return "something else is wrong"; };
  CHECK(run_trial(trial).reason == "something else is wrong");
}

TEST_CASE("Mechanical energy counts snow, smoke and air over the lowest corner", "[stability]") {
  const Scene scene = parse_scene(scene_text("verification/extreme_box.toml"), "box",
                                  {"release.velocity=[3, 0]", "smoke.density=1", "suspension.cell_size=0.5"});
  const Simulation<2> simulation(scene);
  double expected = 0;
  const Particles<2>& p = simulation.dense()->particles;
  for (std::size_t i = 0; i < p.size(); ++i) expected += p.mass[i] * (9 / 2.0 + 9.81 * p.position[i][1]);
  const auto& smoke = simulation.suspension()->smoke_mass();
  for (int k = 0; k < 6; ++k)
    for (int i = 0; i < 8; ++i) expected += smoke[Index<2>{i, k}] * 9.81 * 0.5 * (k + 0.5);
  CHECK(mechanical_energy(simulation) == Approx(expected));
}
