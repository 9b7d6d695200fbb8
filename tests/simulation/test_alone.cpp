// A scene that leaves parts out takes the same steps as a program that never had them, to the bit.

#include <catch2/catch.hpp>

#include "absence/air_alone.hpp"
#include "absence/dense_alone.hpp"
#include "absence/scenes.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

/// A block of snow that falls on a floor.
constexpr std::string_view block = R"(
schema_version = 1
[domain]
lower = [0, 0]
upper = [8, 8]
[[release]]
shape = "box"
lower = [3, 0.2]
upper = [4, 1.2]
[dense_flow]
)";

}  // namespace

TEST_CASE("Dense flow alone ends in the bits of its step composed without the simulation", "[absence]") {
  const bool with_cover = GENERATE(false, true);
  absence::DenseAlone alone(with_cover);
  Simulation<2> simulation(scene_of(absence::avalanche(with_cover ? 2 : 1)));
  for (int i = 0; i < 40; ++i) {
    alone.step();
    simulation.step();
  }
  CHECK(simulation.time() == alone.time);
  CHECK(simulation.dense()->particles.id == alone.dense.particles.id);
  CHECK(absence::bits_of(simulation.dense()->particles) == absence::bits_of(alone.dense.particles));
  CHECK(simulation.report().bed_friction == alone.from_bed);
  CHECK(simulation.report().dense.boundary_impulse == alone.solved.boundary_impulse);
}

TEST_CASE("Air alone ends in the bits of its step composed without the simulation", "[absence]") {
  absence::AirAlone alone;
  Simulation<2> simulation(scene_of(absence::air_alone));
  for (int i = 0; i < 40; ++i) {
    alone.step();
    simulation.step();
  }
  CHECK(alone.air.max_speed() > 0);
  CHECK(simulation.time() == alone.time);
  CHECK(absence::bits_of(*simulation.suspension()) == absence::bits_of(alone.air));
  CHECK(simulation.masses().deposited == alone.deposited);
}

// Without a coupling the air reaches the snow in two ways: it answers the core, and it may rule the time step.
TEST_CASE("Air without a coupling leaves the snow's bits alone while no cell is core and the snow rules the step",
          "[absence]") {
  Simulation<2> without_air(scene_of(block));
  Simulation<2> coarse(scene_of(std::string(block) + "[suspension]\ncell_size = 4\nwind = [2, 0]\n"));
  Simulation<2> fine(scene_of(std::string(block) + "[suspension]\ncell_size = 0.25\n"));
  bool core_answers = false;
  for (int i = 0; i < 60; ++i) {
    without_air.step();
    coarse.step();
    fine.step();
    REQUIRE(coarse.report().n_core_cells == 0);
    REQUIRE(coarse.report().limiter != "air");
    core_answers = core_answers || (fine.report().n_core_cells > 0 && fine.report().core_reaction.norm() > 0);
  }
  CHECK(coarse.suspension()->max_speed() > 0);
  CHECK(coarse.time() == without_air.time());
  const std::uint64_t bits = absence::bits_of(without_air.dense()->particles);
  CHECK(absence::bits_of(coarse.dense()->particles) == bits);
  CHECK(core_answers);
  CHECK(absence::bits_of(fine.dense()->particles) != bits);
}
