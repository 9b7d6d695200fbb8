#include <catch2/catch.hpp>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "simulation/frame.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

template <int Dim>
constexpr std::string_view avalanche() {
  return Dim == 2 ? small_avalanche : small_avalanche_3d;
}

/// A source of smoke over the slope.
template <int Dim>
constexpr std::string_view smoke_source =
    Dim == 2 ? "[smoke]\ndensity = 0\nrate = 5\nlower = [2.1, 9]\nupper = [6, 12]\n"
             : "[smoke]\ndensity = 0\nrate = 5\nlower = [0.6, 0, 3]\n"
               "upper = [3, 1, 5.2]\n";

const std::vector<std::string> tiles{"suspension.tiles.margin=1", "suspension.tiles.still_speed=1"};

const std::vector<std::string> frozen_rotation{"suspension.frozen=true", "suspension.initial_flow=rotation",
                                               "suspension.initial_speed=4", "suspension.diffusivity=0.1"};

template <int Dim>
Simulation<Dim> run(const Scene& scene) {
  Simulation<Dim> simulation(scene);
  while (!simulation.done()) simulation.step();
  return simulation;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Mass is constant and every exchange cancels, step by step", "[simulation]", ((int Dim), Dim), 2,
                       3) {
  const auto settings = GENERATE(std::vector<std::string>{}, tiles, frozen_rotation);
  const bool source = GENERATE(false, true);
  Simulation<Dim> simulation(
      scene_of(std::string(avalanche<Dim>()) + std::string(source ? smoke_source<Dim> : ""), settings));
  while (!simulation.done()) {
    simulation.step();
    const StepReport<Dim>& r = simulation.report();
    const double scale = simulation.dense_mass() * 10;
    REQUIRE(std::abs(simulation.mass_error()) < 1e-12);
    REQUIRE((r.exchange_on_particles + r.exchange_on_grid + r.exchange_on_fixed_faces).norm() < 1e-12 * scale);
    REQUIRE(!r.limiter.empty());
  }
  CHECK(simulation.masses().n_entrained > 0);
  CHECK(simulation.smoke_mass() > 0);
  const MassLedger& m = simulation.masses();
  CHECK((m.injected > 0) == source);
  CHECK(m.generated + m.injected == Approx(simulation.smoke_mass() + m.adhered + m.smoke_outflow + m.deposited));
}

TEMPLATE_TEST_CASE_SIG("The ledger accounts for all momentum of the snow and of the air", "[simulation]",
                       ((int Dim), Dim), 2, 3) {
  const auto settings = GENERATE(std::vector<std::string>{"suspension.scheme=maccormack"},
                                 std::vector<std::string>{"suspension.scheme=reflection"}, tiles, frozen_rotation);
  const bool source = GENERATE(false, true);
  Simulation<Dim> simulation(
      scene_of(std::string(avalanche<Dim>()) + std::string(source ? smoke_source<Dim> : ""), settings));
  const auto snow = [&] {
    Vec<Dim> sum = Vec<Dim>::Zero();
    const Particles<Dim>& p = simulation.dense()->particles;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
    return sum;
  };
  Vec<Dim> snow_before = snow(), air_before = simulation.suspension()->momentum();
  while (!simulation.done()) {
    simulation.step();
    const StepReport<Dim>& r = simulation.report();
    const SuspensionBudget<Dim>& b = r.suspension;
    const double scale = simulation.dense_mass() * 10;
    const Vec<Dim> snow_entries = r.gravity_on_dense + r.exchange_on_particles + r.dense.boundary_impulse +
                                  r.bed_friction + r.wall_contact + r.core_reaction - r.outflow;
    REQUIRE((snow() - snow_before - snow_entries).norm() < 1e-11 * scale);
    const Vec<Dim> air = simulation.suspension()->momentum();
    const Vec<Dim> air_entries = r.gravity_on_smoke + r.exchange_on_grid + b.core + b.advection + b.smoke +
                                 b.diffusion + b.confinement + b.projection + r.ground_on_air + r.smoke_source +
                                 r.forgotten;
    REQUIRE((air - air_before - air_entries).norm() < 1e-11 * scale);
    snow_before = snow();
    air_before = air;
  }
}

TEMPLATE_TEST_CASE_SIG("C10: the overlap region does not change with the air's cells", "[simulation]", ((int Dim), Dim),
                       2, 3) {
  std::vector<std::size_t> counts;
  for (const char* dx : {"0.15", "0.33", "0.5", "1"}) {
    Simulation<Dim> simulation(scene_of(std::string(avalanche<Dim>()), {std::string("suspension.cell_size=") + dx}));
    simulation.step();
    counts.push_back(simulation.report().n_overlap);
    CHECK(simulation.report().n_overlap < simulation.dense()->particles.size());
  }
  CHECK(counts.front() > 0);
  CHECK(counts == std::vector<std::size_t>(counts.size(), counts.front()));
}

TEMPLATE_TEST_CASE_SIG("The same bits with any number of threads", "[simulation]", ((int Dim), Dim), 2, 3) {
  std::vector<std::string> settings = GENERATE(std::vector<std::string>{}, tiles);
  settings.push_back("scene.end_time=0.2");
  std::vector<std::string> digests;
  for (const int threads : {1, 2, 4}) {
    const ThreadLimit limit(threads);
    digests.push_back(state_digest(run<Dim>(scene_of(avalanche<Dim>(), settings))));
  }
  CHECK(digests[0] == digests[1]);
  CHECK(digests[0] == digests[2]);
  settings.push_back("scene.seed=2");
  CHECK(digests[0] != state_digest(run<Dim>(scene_of(avalanche<Dim>(), settings))));
}

TEMPLATE_TEST_CASE_SIG("The same bits with a k-d tree's neighbours", "[simulation]", ((int Dim), Dim), 2, 3) {
  std::vector<std::string> digests;
  for (const char* search : {"cell_list", "kd_tree"}) {
    Simulation<Dim> simulation(scene_of(avalanche<Dim>(), {"dense_flow.neighbour_search=" + std::string(search),
                                                           "dense_flow.viscosity=5", "dense_flow.wall=no_slip"}));
    for (int i = 0; i < 40; ++i) simulation.step();
    CHECK(simulation.dense()->neighbours().n_pairs() > 1000);
    CHECK(simulation.masses().n_entrained > 0);
    digests.push_back(state_digest(simulation));
  }
  CHECK(digests[0] == digests[1]);
}

TEST_CASE("Without generation no smoke, without entrainment no new snow, without either layer nothing of it",
          "[simulation]") {
  const Simulation<2> clear = run<2>(scene_of(without(small_avalanche, {"coupling.generation", "coupling.adhesion"})));
  CHECK(clear.smoke_mass() == 0);
  for (const double m : clear.suspension()->smoke_mass().values()) REQUIRE(m == 0);
  CHECK(clear.report().exchange_on_particles.norm() > 0);

  const Simulation<2> resting = run<2>(scene_of(without(small_avalanche, {"entrainment"})));
  CHECK(resting.masses().n_entrained == 0);
  CHECK(resting.stages().passes("entrainment") == 0);
}

TEST_CASE("A runaway is caught in its step and named", "[simulation]") {
  Simulation<2> simulation(scene_of(runaway));
  try {
    for (int i = 0; i < 50; ++i) simulation.step();
    FAIL("not caught");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::unstable);
    CHECK_THAT(error.what(), Catch::Contains("speed") && Catch::Contains("particle") && Catch::Contains("step "));
  }
}

TEST_CASE("A11, on a cover: snow on ground below its friction angle comes to rest and stays", "[simulation]") {
  const Scene scene =
      scene_of(without(small_avalanche, {"suspension", "suspension.confinement", "coupling.drag", "coupling.lift",
                                         "coupling.generation", "coupling.adhesion", "entrainment"}),
               {"terrain.angle=8 deg", "terrain.drop=1", "terrain.start=[0, 4]", "scene.end_time=6",
                "dense_flow.friction_mu=0.3", "release.velocity=[0, 0]", "release.length=5", "release.thickness=0.42"});
  Simulation<2> simulation(scene);
  while (simulation.time() < 3) simulation.step();
  std::vector<Vec<2>> rest(simulation.dense()->particles.size());
  for (std::size_t i = 0; i < rest.size(); ++i)
    rest[simulation.dense()->particles.id[i]] = simulation.dense()->particles.position[i];
  while (!simulation.done()) simulation.step();
  Vec<2> drift = Vec<2>::Zero();
  for (std::size_t i = 0; i < rest.size(); ++i)
    drift += (simulation.dense()->particles.position[i] - rest[simulation.dense()->particles.id[i]]) /
             static_cast<double>(rest.size());
  CHECK(drift.norm() < 0.01);
}

TEST_CASE("Scenes without snow or without anything run", "[simulation]") {
  const std::string bare = without(small_avalanche, {"release", "cover", "entrainment"});
  const Simulation<2> empty = run<2>(scene_of(bare));
  CHECK(empty.dense()->particles.empty());
  const Simulation<2> air = run<2>(
      scene_of("schema_version = 1\n[scene]\nend_time = 0.1\n[domain]\nlower=[0, 0]\nupper=[3, 3]\n[suspension]\n"));
  CHECK(air.stages().passes("suspension.pressure") == 0);  // air at rest is not solved for
  const Simulation<2> nothing =
      run<2>(scene_of("schema_version = 1\n[scene]\nend_time = 0.1\n[domain]\nlower=[0, 0]\nupper=[3, 3]\n"));
  CHECK(nothing.memory().empty());
}

TEST_CASE("Wind goes on through open sides, and around the ground", "[simulation]") {
  const std::string text = R"(schema_version = 1
[scene]
end_time = 4
[domain]
lower = [0, 0]
upper = [16, 8]
bottom = "closed"
top = "closed"
[suspension]
cell_size = 0.5
wind = [5, 0]
tolerance = 1e-8
)";
  SECTION("unchanged over a level floor") {
    const Simulation<2> s = run<2>(scene_of(text));
    for (const double u : s.suspension()->velocity()[0].values()) CHECK(u == Approx(5).epsilon(1e-6));
    for (const double w : s.suspension()->velocity()[1].values()) CHECK(std::abs(w) < 1e-6);
  }
  SECTION("faster where a slope leaves it less room") {
    const Simulation<2> s = run<2>(scene_of(
        text + "[terrain]\nstart = [0, 4]\nangle = \"30 deg\"\ndrop = 3\nrunout_angle = 0\ntransition_radius = 1\n"));
    const Field<2>& u = s.suspension()->velocity()[0];
    CHECK(u[Index<2>{2, 14}] > 1.1 * u[Index<2>{28, 14}]);
    CHECK(u[Index<2>{28, 14}] > 1);
  }
}
