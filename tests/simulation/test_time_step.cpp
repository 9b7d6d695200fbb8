// What rules the step, and by how much: numbers by hand.
#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

/// A box of 3 m with these sections, and gravity of 10 m/s2.
std::string box_with(const std::string& sections) {
  return "schema_version = 1\n[scene]\nend_time = 1\n[domain]\nlower = [0, 0]\nupper = [3, 3]\ngravity = [0, -10]\n" +
         sections;
}

const std::string snow = "[release]\nshape = \"box\"\nlower = [1, 1]\nupper = [1.05, 1.05]\n[dense_flow]\n";
const std::string air = "[suspension]\ncell_size = 0.5\n";

struct FirstStep {
  double dt;
  std::string limiter;
};

FirstStep first_step(const std::string& sections, const std::vector<std::string>& settings = {}) {
  Simulation<2> simulation(scene_of(box_with(sections), settings));
  simulation.step();
  CHECK(simulation.time() == simulation.report().dt);
  return {simulation.report().dt, std::string(simulation.report().limiter)};
}

}  // namespace

TEST_CASE("The step: 10 ms or what the scene says, particles, air or sound, by hand", "[simulation]") {
  SECTION("nothing moves") {
    const FirstStep step = first_step(air);
    CHECK(step.dt == 0.01);
    CHECK(step.limiter == "longest step");
  }
  SECTION("air from rest: sqrt(0.3 * 0.5 m / 10 m/s2)") {
    const FirstStep step = first_step(air + "cfl = 0.3\n", {"scene.max_step=10"});
    CHECK(step.dt == Approx(std::sqrt(0.015)));
    CHECK(step.limiter == "air");
  }
  SECTION("nothing moves, and the scene allows more, or less") {
    const auto longest = GENERATE(0.2, 0.1, 1e-4);
    const FirstStep step = first_step(air, {"scene.max_step=" + std::to_string(longest)});
    CHECK(step.dt == longest);
    CHECK(step.limiter == "longest step");
  }
  SECTION("snow from rest: 0.4 sqrt(0.001 m / 10 m/s2)") {
    const FirstStep step = first_step(snow + "support_radius = 0.002\n");
    CHECK(step.dt == Approx(0.004));
    CHECK(step.limiter == "particles");
  }
  SECTION("moving snow: 0.2 * 0.025 m / 5 m/s, under the limit of the wind") {
    const FirstStep step =
        first_step(air + "wind = [20, 0]\n[release]\nshape = \"box\"\nlower = [1, 1]\n" +
                   "upper = [1.05, 1.05]\nvelocity = [3, -4]\n[dense_flow]\n" + "support_radius = 0.05\ncfl = 0.2\n");
    CHECK(step.dt == Approx(0.001));
    CHECK(step.limiter == "particles");
  }
  SECTION("wind: 0.8 * 0.5 m / 100 m/s, under that of the snow") {
    const FirstStep step = first_step(air + "cfl = 0.8\nwind = [100, 0]\n" + snow + "support_radius = 0.05\n");
    CHECK(step.dt == Approx(0.004));
    CHECK(step.limiter == "air");
  }
  SECTION("sound: 0.4 * 0.025 m / 100 m/s") {
    const FirstStep step = first_step(snow + "support_radius = 0.05\nsolver = \"wcsph\"\nsound_speed = 100\n");
    CHECK(step.dt == Approx(0.0001));
    CHECK(step.limiter == "particles or sound");
  }
}

TEST_CASE("A step under 0.1 microseconds ends the run as unstable, before anything moves", "[simulation]") {
  const std::string fast = snow + "solver = \"wcsph\"\nsound_speed = 100000\n";
  CHECK(first_step(fast + "support_radius = 0.052\n").dt == Approx(1.04e-7));
  Simulation<2> simulation(scene_of(box_with(fast + "support_radius = 0.048\n")));  // 0.96e-7 s
  const std::vector<Vec<2>> before = simulation.dense()->particles.velocity;
  REQUIRE(!before.empty());
  try {
    simulation.step();
    FAIL("not caught");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::unstable);
    CHECK_THAT(error.what(),
               Catch::Contains("time step") && Catch::Contains("particles or sound") && Catch::Contains("step 1 "));
  }
  CHECK(simulation.n_steps() == 0);
  CHECK(simulation.time() == 0);
  CHECK(simulation.dense()->particles.velocity == before);
}
