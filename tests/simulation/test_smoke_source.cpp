// Smoke that keeps coming as long as a run lasts.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "simulation/frame.hpp"
#include "simulation/release.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

/// A source of 2 kg m^-3 s^-1, cut by cells and by an obstacle, in air that turns.
template <int Dim>
std::string turning_air() {
  const auto corners = [](const char* xz, const char* xyz) { return Dim == 2 ? xz : xyz; };
  return std::string("schema_version = 1\n[scene]\ndim = ") + (Dim == 2 ? "2" : "3") + "\n[domain]\n" +
         corners("lower = [0, 0]\nupper = [4, 4]\n", "lower = [0, 0, 0]\nupper = [4, 1, 4]\n") +
         "[suspension]\ncell_size = 0.25\nsettling_speed = 0\ninitial_flow = \"rotation\"\ninitial_speed = 1\n"
         "[obstacle]\n" +
         corners("lower = [2, 0]\nupper = [3, 2]\n", "lower = [2, 0, 0]\nupper = [3, 1, 2]\n") +
         "[smoke]\ndensity = 0\nrate = 2\n" +
         corners("lower = [1.1, 1]\nupper = [2.5, 3]\n", "lower = [1.1, 0, 1]\nupper = [2.5, 1, 3]\n");
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("A source gives each cell its rate, and leaves the air's velocity as it is", "[smoke_source]",
                       ((int Dim), Dim), 2, 3) {
  const Simulation<Dim> simulation(scene_of(turning_air<Dim>()));
  Suspension<Dim> air = *simulation.suspension();
  SmokeSource<Dim> source(smoke_rate<Dim>(simulation.scene(), air));
  CHECK(source.total_rate() == Approx(2 * (1.4 * 2 - 0.5 * 1)));

  const double dt = 0.5;
  const Vec<Dim> momentum = air.momentum();
  const FaceField<Dim> velocity = air.velocity();
  const Vec<Dim> brought = air.apply(source.over(dt, air));
  CHECK(air.total_smoke() == Approx(dt * source.total_rate()));
  CHECK(air.smoke_density(flat<Dim>(air.grid().cell_of(Vec<Dim>::Constant(0.6) + up<Dim>() + Vec<Dim>::Unit(0)),
                                    air.grid().cells)) == Approx(dt * 2));
  CHECK(brought.norm() > 0);
  CHECK((air.momentum() - momentum - brought).norm() < 1e-13 * air.total_smoke());
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t face = 0; face < velocity[axis].size(); ++face)
      REQUIRE(air.velocity()[axis][face] == Approx(velocity[axis][face]).epsilon(1e-14));
}

TEMPLATE_TEST_CASE_SIG("The mass of sources is that of their rates and the time, to round-off", "[smoke_source]",
                       ((int Dim), Dim), 2, 3) {
  Simulation<Dim> simulation(scene_of(turning_air<Dim>(), {"scene.end_time=1"}));
  CHECK(simulation.masses().initial == 0);
  while (!simulation.done()) {
    simulation.step();
    REQUIRE(std::abs(simulation.mass_error()) < 1e-14);
  }
  CHECK(simulation.masses().injected == Approx(4.6 * simulation.time()).epsilon(1e-13));
}

TEST_CASE("Rates of several shapes add up; densities replace each other, 0 replaces nothing", "[smoke_source]") {
  const Simulation<2> simulation(
      scene_of("schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [4, 4]\n[suspension]\ncell_size = 0.5\n"
               "[[smoke]]\ndensity = 3\nrate = 1\nlower = [0, 0]\nupper = [2, 2]\n"
               "[[smoke]]\ndensity = 0\nrate = 2\nlower = [1, 0]\nupper = [3, 2]\n"));
  CHECK(simulation.smoke_mass() == Approx(12));
  const Field<2> rate = smoke_rate<2>(simulation.scene(), *simulation.suspension());
  CHECK(rate[Index<2>{0, 0}] == Approx(0.25));
  CHECK(rate[Index<2>{2, 0}] == Approx(0.75));
  CHECK(rate[Index<2>{4, 0}] == Approx(0.5));
  CHECK(rate[Index<2>{6, 0}] == 0);
}

TEST_CASE("A step that is taken back gives its smoke once", "[smoke_source]") {
  Simulation<2> simulation(scene_of(turning_air<2>(), {"scene.end_time=10"}));
  for (int i = 0; i < 5; ++i) simulation.step();
  SavedState<2> state;
  simulation.save(state);
  const auto ten_steps_on = [&] {
    for (int i = 0; i < 10; ++i) simulation.step();
    return std::pair(state_digest(simulation), simulation.masses().injected);
  };
  const auto once = ten_steps_on();
  simulation.restore(state);
  CHECK(once == ten_steps_on());
}

TEST_CASE("B9: what sinks from a source is what rises from it with gravity turned over", "[smoke_source]") {
  const auto plume = [](double gravity) {
    Simulation<2> simulation(
        scene_of("schema_version = 1\n[scene]\nend_time = 4\n[domain]\nlower = [-4, -4]\nupper = [4.1, 4]\nbottom = "
                 "\"open\"\n[suspension]\n"
                 "cell_size = 0.25\nsettling_speed = 0\ntolerance = 1e-10\n[smoke]\ndensity = 0\nrate = 0.2\n"
                 "lower = [-0.25, -0.25]\nupper = [0.25, 0.25]\n",
                 {fmt::format("domain.gravity=[0, {}]", gravity)}));
    while (!simulation.done()) simulation.step();
    return simulation;
  };
  const Simulation<2> falling = plume(-9.81), rising = plume(9.81);
  const Field<2>&down = falling.suspension()->smoke_mass(), &up = rising.suspension()->smoke_mass();
  const int n = down.shape()[1];
  const double whole = falling.smoke_mass();
  for_each_index<2>(down.shape(), [&](const Index<2>& cell) {
    REQUIRE(std::abs(down[cell] - up[Index<2>{cell[0], n - 1 - cell[1]}]) < 1e-12 * whole);
  });
  CHECK(falling.suspension()->max_speed() > 0.5);
}
