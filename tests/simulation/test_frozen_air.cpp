// Air that keeps the velocity it began with: a prescribed flow for smoke and snow.
#include <catch2/catch.hpp>

#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

const std::string box = R"(schema_version = 1
[domain]
lower = [0, 0]
upper = [16, 8]
[suspension]
cell_size = 0.5
frozen = true
settling_speed = 0
)";

/// Mean place of the smoke [m].
Vec<2> middle(const Suspension<2>& air) {
  Vec<2> sum = Vec<2>::Zero();
  for_each_index<2>(air.grid().cells,
                    [&](const Index<2>& cell) { sum += air.smoke_mass()[cell] * air.grid().cell_centre(cell); });
  return sum / air.total_smoke();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Frozen air keeps its bits in an avalanche, and takes no pass", "[frozen]", ((int Dim), Dim), 2,
                       3) {
  Simulation<Dim> simulation(
      scene_of(without(Dim == 2 ? small_avalanche : small_avalanche_3d, {"entrainment", "cover"}),
               {"suspension.frozen=true", "suspension.initial_flow=vortices", "suspension.initial_speed=5"}));
  const FaceField<Dim> before = simulation.suspension()->velocity();
  while (simulation.time() < 0.2) simulation.step();
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t face = 0; face < before[axis].size(); ++face)
      REQUIRE(simulation.suspension()->velocity()[axis][face] == before[axis][face]);
  CHECK(simulation.smoke_mass() > 0);
  CHECK(simulation.report().exchange_on_fixed_faces.norm() > 0);
  CHECK(simulation.report().n_core_cells == 0);
  for (const char* stage : {"suspension.core", "suspension.advection", "suspension.pressure"})
    CHECK(simulation.stages().passes(stage) == 0);
}

TEST_CASE("Smoke goes with a frozen wind", "[frozen]") {
  Simulation<2> simulation(
      scene_of(box + "wind = [4, 1]\n[smoke]\nlower = [2, 2]\nupper = [4, 4]\n", {"domain.gravity=[0, 0]"}));
  CHECK(middle(*simulation.suspension())[0] == Approx(3));
  while (simulation.time() < 1.5) simulation.step();
  CHECK(middle(*simulation.suspension())[0] == Approx(3 + 4 * simulation.time()).epsilon(1e-3));
  CHECK(middle(*simulation.suspension())[1] == Approx(3 + simulation.time()).epsilon(1e-3));
  CHECK(simulation.smoke_mass() == Approx(12));
}

TEST_CASE("Heavy smoke does not fall in frozen air, but settles in it", "[frozen]") {
  const auto settling = GENERATE(0.0, 0.5);
  Simulation<2> simulation(scene_of(box + "[smoke]\nlower = [6, 5]\nupper = [8, 7]\n",
                                    {"suspension.settling_speed=" + std::to_string(settling)}));
  while (simulation.time() < 1) simulation.step();
  CHECK(middle(*simulation.suspension())[1] == Approx(6 - settling * simulation.time()).epsilon(1e-3));
}

TEST_CASE("Drag in frozen air is that of a given wind, however much snow there is", "[frozen]") {
  // beta = 0.81 * 0.01 s / 0.05 m * 1.2 / 300 * 10 m/s = 0.00648; v = 10 m/s * beta / (1 + beta)
  const double v = 10 * 0.00648 / 1.00648;
  Simulation<2> simulation(scene_of(box + "wind = [10, 0]\n[dense_flow]\nsupport_radius = 0.2\n[coupling.drag]\n" +
                                        "[release]\nshape = \"box\"\nlower = [4, 4]\nupper = [4.5, 4.1]\n",
                                    {"domain.gravity=[0, 0]"}));
  REQUIRE(simulation.dense()->particles.size() == 5);
  simulation.step();
  REQUIRE(simulation.report().dt == 0.01);
  for (const Vec<2>& velocity : simulation.dense()->particles.velocity) CHECK(velocity[0] == Approx(v).epsilon(1e-9));
  CHECK(simulation.report().exchange_on_fixed_faces[0] == Approx(-5 * 3 * v));
  CHECK(simulation.report().exchange_on_grid.norm() < 1e-14);
}
