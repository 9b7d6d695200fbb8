// An avalanche over cover that sleeps is the avalanche over cover that is all there from the start.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/error.hpp"
#include "simulation/frame.hpp"
#include "simulation/scenery.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

namespace spindrift {

template <int Dim>
struct FaultInjection {
  Simulation<Dim>& simulation;
  void spoil(std::function<void(Simulation<Dim>&)> how) { simulation.spoil_trial_ = std::move(how); }
};

}  // namespace spindrift

using namespace spindrift;
using namespace spindrift::testing;

namespace {

const std::string dense_alone = R"(schema_version = 1
[scene]
dim = 3
end_time = 2
[domain]
lower = [0, 0, -30]
upper = [64, 192, 40]
bottom = "open"
[terrain]
shape = "plane"
start = [0, 26]
angle = "35 deg"
side_angle = "5 deg"
[dense_flow]
support_radius = 1
[release]
shape = "ball"
center = [8, 96, 22]
radius = 2
velocity = [8, 1, -6]
[cover]
depth = 1
[entrainment]
)";

const std::string cloud = R"([suspension]
cell_size = 1
[suspension.tiles]
[coupling.drag]
[coupling.lift]
[coupling.generation]
threshold_speed = 1
[coupling.adhesion]
)";

/// Dense flow of two simulations, by id, to the bit.
bool same_flow(const Simulation<3>& a, const Simulation<3>& b) {
  return a.time() == b.time() && a.dense()->particles.id == b.dense()->particles.id &&
         a.dense()->particles.position == b.dense()->particles.position &&
         a.dense()->particles.velocity == b.dense()->particles.velocity &&
         a.dense()->particles.mass == b.dense()->particles.mass;
}

}  // namespace

TEST_CASE("The result does not depend on when cover was laid", "[sleeping_cover][slow]") {
  const std::string text = dense_alone + GENERATE(as<std::string>{}, "", cloud);
  Simulation<3> asleep(scene_of(text)), awake(scene_of(text, {"cover.sleeping=false"}));
  const std::size_t n_whole = awake.cover()->particles.size();
  CHECK(asleep.cover()->particles.size() < n_whole / 3);
  while (!awake.done()) {
    asleep.step();
    awake.step();
    REQUIRE(same_flow(asleep, awake));
    REQUIRE(std::abs(asleep.mass_error()) < 1e-12);
    if (!asleep.suspension()) continue;
    const auto a = asleep.suspension()->smoke_mass().values(), b = awake.suspension()->smoke_mass().values();
    REQUIRE(std::ranges::equal(a, b));
  }
  CHECK(awake.masses().n_entrained > 100);
  CHECK(awake.masses().laid == 0);
  CHECK(asleep.masses().laid > 0);
  CHECK(asleep.masses().entrained == awake.masses().entrained);
  // The avalanche left plots in peace, and woke some on its way.
  CHECK(asleep.cover()->particles.size() < n_whole * 3 / 4);
}

TEST_CASE("A step that is taken back lays the same cover again", "[sleeping_cover]") {
  const std::vector<std::string> settings{"scene.end_time=1"};
  Simulation<3> good(scene_of(dense_alone, settings)), spoilt(scene_of(dense_alone, settings));
  while (!good.done()) good.step();
  FaultInjection<3> fault{spoilt};
  bool thrown = false;
  fault.spoil([&thrown](Simulation<3>& s) {
    if (s.n_steps() != 40 || thrown) return;
    thrown = true;
    throw Error(ExitCode::unstable, "a fault");
  });
  double laid_before = 0;
  while (spoilt.n_steps() < 40) {
    spoilt.step();
    laid_before = spoilt.masses().laid;
  }
  spoilt.step();
  CHECK(thrown);
  CHECK(spoilt.masses().laid >= laid_before);
  CHECK(std::abs(spoilt.mass_error()) < 1e-12);
  CHECK(std::abs(good.mass_error()) < 1e-12);
}

TEST_CASE("A mountain side of cover costs what lies near the snow", "[sleeping_cover]") {
  Simulation<3> simulation(
      scene_of(dense_alone, {"domain.lower=[0, 0, -3500]", "domain.upper=[6000, 6000, 100]", "terrain.start=[0, 50]",
                             "terrain.angle=30 deg", "terrain.side_angle=0", "dense_flow.support_radius=2",
                             "release.center=[3000, 3000, -1675]", "release.radius=5", "release.velocity=[0, 0, 0]"}));
  for (int n = 0; n < 3; ++n) simulation.step();
  // 36 km^2 would hold 40 million particles of 1 m.
  CHECK(simulation.cover()->particles.size() > 3000);
  CHECK(simulation.cover()->particles.size() < 30000);
  CHECK(simulation.cover()->bytes() < 20e6);
}

TEST_CASE("Pictures show cover that sleeps", "[sleeping_cover][scenery]") {
  const Scene scene = scene_of(dense_alone);
  Simulation<3> simulation(scene);
  simulation.step();
  const ParticleFrame particles = particle_frame(simulation);
  const Scenery scenery(scene, preview_view(scene));
  const Landscape landscape = scenery.landscape(picture_frame(0, &particles, nullptr, scene.origin));
  const Relief& ground = landscape.ground;
  for (const double x : {4.0, 30.0, 60.0})
    for (const double y : {4.0, 96.0, 180.0}) {
      Index<2> at;
      for (int k = 0; k < 2; ++k)
        at[static_cast<std::size_t>(k)] = static_cast<int>(((k == 0 ? x : y) - ground.origin[k]) / ground.spacing);
      CHECK(ground.snow[flat<2>(at, ground.shape)] == Approx(1).margin(0.2));
    }
}
