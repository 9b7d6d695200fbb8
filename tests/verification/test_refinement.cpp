// Refining a scene of the user's: what is scaled, what the errors are relative to.

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <set>

#include "simulation/scene_reader.hpp"
#include "verification/cases.hpp"
#include "verification/refinement.hpp"

using namespace spindrift;

namespace {

Scene scene(const char* file, const std::vector<std::string>& settings = {}) {
  return parse_scene(scene_text(file), file, settings);
}

}  // namespace

TEST_CASE("Scaling takes the numbers of its factor and no others", "[refinement]") {
  const Scene base = scene("verification/extreme_slope.toml");
  const Scene spacing = scaled(base, "spacing", 0.5);
  CHECK(spacing.dense_flow->support_radius == base.dense_flow->support_radius / 2);
  CHECK(spacing.suspension->cell_size == base.suspension->cell_size);
  CHECK(spacing.scene.max_step == base.scene.max_step);
  const Scene cell = scaled(base, "cell", 0.5);
  CHECK(cell.dense_flow->support_radius == base.dense_flow->support_radius);
  CHECK(cell.suspension->cell_size == base.suspension->cell_size / 2);
  const Scene step = scaled(base, "time step", 2);
  CHECK(step.scene.max_step == 2 * base.scene.max_step);
  CHECK(step.dense_flow->cfl == 2 * base.dense_flow->cfl);
  CHECK(step.suspension->cfl == 2 * base.suspension->cfl);
  CHECK(scaled(base, "time step", 10).dense_flow->cfl == 1);
  const Scene tolerances = scaled(base, "tolerances", 0.1);
  CHECK(tolerances.suspension->tolerance == Approx(0.01 * base.suspension->tolerance));
  CHECK(tolerances.dense_flow->density_tolerance == Approx(0.01 * base.dense_flow->density_tolerance));
  CHECK(tolerances.suspension->cell_size == base.suspension->cell_size);
  const Scene all = scaled(base, "all", 0.5);
  CHECK(all.dense_flow->support_radius == base.dense_flow->support_radius / 2);
  CHECK(all.suspension->cell_size == base.suspension->cell_size / 2);
  CHECK(all.scene.max_step == base.scene.max_step / 2);
  const Scene air = scaled(scene("heavy_gas_front.toml"), "all", 0.5);
  CHECK(!air.dense_flow);
}

TEST_CASE("Richardson's limit of a sequence of known order, none of a scattered one", "[refinement]") {
  const std::vector<double> scales{2, 1, 0.5};
  const Limit even = limit_of(scales, {3 + 0.1 * 4, 3 + 0.1, 3 + 0.1 / 4});
  CHECK(even.extrapolated);
  CHECK(even.order == Approx(2));
  CHECK(even.value == Approx(3));
  const Limit scattered = limit_of(scales, {3, 2, 2.5});
  CHECK(!scattered.extrapolated);
  CHECK(scattered.value == 2.5);
  const Limit constant = limit_of(scales, {5, 5, 5});
  CHECK(!constant.extrapolated);
  CHECK(constant.value == 5);
  CHECK(limit_of({1}, {7}).value == 7);
}

TEST_CASE("A refined dam break reads front and mass, and counts in particles of the scene's size", "[refinement]") {
  const Scene dam = scene("dam_break.toml", {"dense_flow.support_radius=0.2", "scene.end_time=0.2"});
  std::set<std::string> factors;
  std::size_t n_told = 0;
  const Refinement result = refine(dam, planned_runs(dam, true), [&](const RefinedRun&) { ++n_told; });
  CHECK(n_told == result.runs.size());
  for (const RefinedRun& run : result.runs) {
    CAPTURE(run.factor, run.scale, run.failure);
    factors.insert(run.factor);
    CHECK(run.scale >= 1);  // the quick form is never finer than the scene
    REQUIRE(run.readings.size() == result.limits.size());
    CHECK(run.cost.steps > 0);
    for (const Reading& reading : run.readings) {
      if (reading.name == "mass of the dense flow [kg]") CHECK(reading.value == Approx(2000).epsilon(0.1));
      if (reading.name == "particles of the dense flow") CHECK(reading.value == Approx(200).epsilon(0.1));
    }
  }
  CHECK(factors == std::set<std::string>{"all", "spacing", "time step", "tolerances"});
}
