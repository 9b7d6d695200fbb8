#include <catch2/catch.hpp>

#include "bad_scenes.hpp"
#include "simulation/scene_warnings.hpp"

using namespace spindrift;

namespace {

std::vector<std::string> warnings(const std::string& text, const std::vector<std::string>& settings = {}) {
  Origins origins;
  const Scene scene = parse_scene(text, "a.toml", settings, &origins);
  return scene_warnings(scene, origins);
}

struct Doubtful {
  std::string text, warning;
};

const std::string good = head +
                         "[terrain]\nstart = [0, 45]\nangle = \"30 deg\"\ndrop = 30\n[dense_flow]\nsupport_radius = 1\n"
                         "[release]\n";  // lines 1 to 11

}  // namespace

TEST_CASE("a scene that makes sense has no warnings", "[scene]") {
  CHECK(warnings(good).empty());
  CHECK(warnings(good + "[cover]\n[entrainment]\n[suspension]\ncell_size = 1\n[coupling.drag]\n[coupling.generation]\n"
                        "[coupling.adhesion]\n")
            .empty());
}

TEST_CASE("scenes that hardly mean what they say get a warning with its place and reason", "[scene]") {
  const auto [text, warning] = GENERATE(values<Doubtful>({
      {good + "[cover]\n", "a.toml:12:2: warning: cover: nothing takes it up: there is no section [entrainment]"},
      {good + "[suspension]\ncell_size = 0.1\n",
       "a.toml:13:13: warning: suspension.cell_size: cells of 0.1 m are finer than the particles, 0.5 m apart: the air "
       "would see every single one, at 125 times the cost of cells of that size"},
      {good + "radius = 2\n",
       "a.toml:12:10: warning: release.radius: has no effect, it belongs to release.shape = "
       "\"ball\""},
      {good + "density = 200\n",
       "a.toml:12:11: warning: release.density: snow takes on dense_flow.density = 300 kg/m^3 within the 0.1 s of "
       "dense_flow.compaction_time; 0 s there lets it keep its own"},
      {head + "[dense_flow]\n", "a.toml:5:2: warning: dense_flow: no snow will move: there is no section [release]"},
      {head, "a.toml:2:2: warning: domain: nothing to compute: neither [dense_flow] nor [suspension]"},
      {good + "shape = \"box\"\nlower = [0, 0]\nupper = [4, 4]\n",
       "a.toml:11:2: warning: release: 64 of its 64 particles are left out: they lie in the ground, the cover, an "
       "obstacle or a wall"},
      {head + "[dense_flow]\nsupport_radius = 1\n[[release]]\nshape = \"box\"\nlower = [1, 1]\nupper = [3, 3]\n"
              "[[release]]\nshape = \"box\"\nlower = [2, 1]\nupper = [4, 3]\n",
       "a.toml:11:1: warning: release[1]: 8 of its 16 particles are left out: they lie in an earlier release"},
      {head + "[dense_flow]\nsupport_radius = 1\n[release]\nshape = \"box\"\nlower = [1, 1]\nupper = [1.2, 3]\n",
       "a.toml:7:2: warning: release: too small for a single particle: no snow is released"},
      {good + "at = 130\n",
       "a.toml:11:2: warning: release: 40 of its 40 particles lie outside the domain and will be "
       "gone at once"},
      {good + "[obstacle]\nlower = [50, 0]\nupper = [50.5, 30]\n",
       "a.toml:12:2: warning: obstacle: thinner than two particles or cells (1 m): snow feels what lies behind it, and "
       "the air whole faces of cells"},
      {good + "[suspension]\ncell_size = 1\nwall = \"no_slip\"\n",
       "a.toml:14:8: warning: suspension.wall: has no effect on air without viscosity: suspension.viscosity is 0"},
      {head + "left = \"closed\"\n[suspension]\nwind = [3, 0]\n",
       "a.toml:7:8: warning: suspension.wind: comes through a closed side of the domain: it will die down"},
      {head + "[suspension]\ninitial_flow = \"rotation\"\ninitial_speed = 0\n",
       "a.toml:6:16: warning: suspension.initial_flow: is air at rest: suspension.initial_speed is 0"},
      {head + "[suspension]\ninitial_speed = 2\n",
       "a.toml:6:17: warning: suspension.initial_speed: has no effect, it belongs to suspension.initial_flow = "
       "\"vortices\" or \"rotation\" or \"potential\""},
      {head + "[suspension]\nfrozen = true\nviscosity = 2\n",
       "a.toml:7:13: warning: suspension.viscosity: has no effect on air that is frozen: suspension.frozen is true"},
      {head + "[suspension]\nfrozen = true\n[suspension.confinement]\n",
       "a.toml:7:13: warning: suspension.confinement: has no effect on air that is frozen: suspension.frozen is true"},
      {head + "[suspension]\n[smoke]\nlower = [1, 1]\nupper = [2, 2]\ndensity = 0\n",
       "a.toml:6:2: warning: smoke: brings no smoke: its density and its rate are 0"},
      {head + "gravity = [0, 9.81]\n[suspension]\n", "a.toml:5:11: warning: domain.gravity: points upwards"},
      {head + "[suspension]\nscheme = \"reflection\"\ncfl = 20\n",
       "a.toml:7:7: warning: suspension.cfl: the reflection scheme can gain energy in steps of more than ten cells"},
      {good + "[suspension]\ncell_size = 1\nair_density = 301\n",
       "a.toml:9:2: warning: dense_flow.density: snow lighter than the air with its smoke, 301 kg/m^3: the air throws "
       "it about, and the run may end as unstable"},
      {good + "[suspension]\ncell_size = 1\n[coupling]\n",
       "a.toml:14:2: warning: coupling: nothing is exchanged: it has none of drag, lift, generation and adhesion"},
      {good + "[suspension]\ncell_size = 1\n[coupling.adhesion]\n",
       "a.toml:14:11: warning: coupling.adhesion: there will be no smoke to adhere: neither [coupling.generation] nor "
       "[smoke]"},
      {good + "[cover]\ndepth = 0.3\n[entrainment]\n",
       "a.toml:13:9: warning: cover.depth: a cover of 0.3 m is thinner than one particle of 0.5 m"},
  }));
  const std::vector<std::string> said = warnings(text);
  REQUIRE(said.size() == 1);
  CHECK(said[0] == warning);
}

TEST_CASE("a ground that misses the domain is told", "[scene]") {
  const std::vector<std::string> low = warnings(good, {"terrain.drop=80"});
  REQUIRE(low.size() == 1);
  CHECK(low[0].starts_with("a.toml:5:2: warning: terrain: lies below the domain over "));
  const std::vector<std::string> high = warnings(good, {"terrain.start=[0, 80]"});
  REQUIRE(high.size() >= 1);
  CHECK(high[0].starts_with("a.toml:5:2: warning: terrain: fills the whole height of the domain over "));
}
