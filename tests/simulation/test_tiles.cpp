// Air that is computed on tiles around the cloud alone, against that of the whole box.
#include <catch2/catch.hpp>
#include <cmath>

#include "grid/active_tiles.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

/// Heavy smoke that falls in a wide box.
const std::string cloud = R"(schema_version = 1
[scene]
end_time = 2
max_step = 0.02
[domain]
lower = [-64, 0]
upper = [64, 96]
[suspension]
cell_size = 0.5
settling_speed = 0
tolerance = 1e-8
[smoke]
shape = "ball"
center = [1, 50]
radius = 3
)";

const std::string cloud_3d = R"(schema_version = 1
[scene]
dim = 3
end_time = 1
max_step = 0.02
[domain]
lower = [-32, -32, 0]
upper = [32, 32, 64]
[suspension]
cell_size = 1
settling_speed = 0
tolerance = 1e-8
[smoke]
shape = "ball"
center = [1, 0, 34]
radius = 3
)";

template <int Dim>
Simulation<Dim> run(const std::vector<std::string>& settings) {
  Simulation<Dim> simulation(scene_of(Dim == 2 ? cloud : cloud_3d, settings));
  while (!simulation.done()) simulation.step();
  return simulation;
}

/// Largest difference of the velocities on the faces of the part's grid, over the largest velocity.
template <int Dim>
double difference(const Suspension<Dim>& part, const Suspension<Dim>& whole) {
  double most = 0;
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for_each_index<Dim>(part.velocity()[axis].shape(), [&](const Index<Dim>& face) {
      Index<Dim> there = face;
      for (std::size_t k = 0; k < Dim; ++k) there[k] += part.grid().lower[k] - whole.grid().lower[k];
      most = std::max(most, std::abs(part.velocity()[axis][face] - whole.velocity()[axis][there]));
    });
  return most / whole.max_speed();
}

template <int Dim>
std::size_t n_computed(const Suspension<Dim>& air) {
  const auto kinds = air.kind().values();
  return static_cast<std::size_t>(std::ranges::count(kinds, CellKind::open));
}

}  // namespace

TEST_CASE("Tiles of places, boxes and their margin, by hand", "[tiles]") {
  MacGrid<2> whole;
  whole.origin = {-10, 0};
  whole.dx = 0.5;
  whole.cells = {100, 70};  // 7 x 5 tiles, the last ones cut off
  const ActiveTiles<2>::Sides sides{{{Side::closed, Side::open}, {Side::closed, Side::closed}}};
  ActiveTiles<2> tiles(whole, sides, {.margin = 1});
  CHECK(tiles.window().cells == Index<2>{16, 16});
  tiles.add(Vec<2>(-10 + 8.1, 8.1));  // the second tile along both axes
  CHECK(tiles.window().lower == Index<2>{16, 16});
  CHECK(tiles.window().cells == Index<2>{16, 16});
  tiles.add_margin();
  CHECK(tiles.window().lower == Index<2>{0, 0});
  CHECK(tiles.window().cells == Index<2>{48, 48});
  CHECK(tiles.sides(tiles.window()) == ActiveTiles<2>::Sides{{{Side::closed, Side::open}, {Side::closed, Side::open}}});
  const MacGrid<2> window = tiles.window();
  tiles.add(Box<2>{{30, 34}, {60, 90}});
  CHECK(tiles.window().cells == Index<2>{100, 70});
  CHECK(tiles.sides(tiles.window()) == sides);
  const StillTiles<2> still = tiles.still(tiles.window());
  CHECK(!still(Index<2>{47, 47}));
  CHECK(still(Index<2>{48, 47}));
  CHECK(!still(Index<2>{99, 69}));
  CHECK(still.faces(0, {0, 8}, tiles.window().cells).end == 49);
  CHECK(still.faces(1, {0, 48}, tiles.window().cells).end == 48);
  CHECK(still.faces(1, {0, 49}, tiles.window().cells).empty());
  CHECK(still.faces(1, {0, 70}, tiles.window().cells).begin == 80);
  // Room to grow where the old window is left, none elsewhere.
  CHECK(tiles.window(window).cells == Index<2>{100, 70});
  tiles.clear();
  tiles.add(Vec<2>(-9, 1));
  CHECK(same_window<2>(tiles.window(tiles.whole()), tiles.window()));
  tiles.add(Vec<2>(-10 + 24.1, 1));
  CHECK(tiles.window(window).lower == Index<2>{0, 0});
  CHECK(tiles.window(window).cells == Index<2>{96, 16});
  CHECK(same_window<2>(tiles.window(tiles.window(window)), tiles.window(window)));
}

TEST_CASE("Places in a window have the bits of the whole grid", "[tiles]") {
  MacGrid<3> whole;
  whole.origin = {0.1, -7.3, 1e3};
  whole.dx = 0.33;
  whole.cells = {40, 40, 40};
  MacGrid<3> window = whole;
  window.lower = {8, 16, 24};
  window.cells = {8, 8, 8};
  for (int n = 0; n < 8; ++n) {
    const Index<3> here{n, 7 - n, n / 2}, there{n + 8, 23 - n, n / 2 + 24};
    CHECK(window.cell_centre(here) == whole.cell_centre(there));
    CHECK(window.face_centre(1, here) == whole.face_centre(1, there));
    CHECK(window.cell_of(window.cell_centre(here)) == here);
  }
}

TEMPLATE_TEST_CASE_SIG("Air on all tiles of the box has the bits of air without tiles", "[tiles]", ((int Dim), Dim), 2,
                       3) {
  const Simulation<Dim> all = run<Dim>({"suspension.tiles.margin=100", "scene.end_time=0.3"});
  const Simulation<Dim> whole = run<Dim>({"scene.end_time=0.3"});
  CHECK(all.suspension()->grid().cells == whole.suspension()->grid().cells);
  CHECK(difference(*all.suspension(), *whole.suspension()) == 0);
  CHECK(all.smoke_mass() == whole.smoke_mass());
}

TEMPLATE_TEST_CASE_SIG("Where nothing moves nothing is computed", "[tiles]", ((int Dim), Dim), 2, 3) {
  Simulation<Dim> simulation(
      scene_of(Dim == 2 ? cloud : cloud_3d,
               {"domain.gravity=" + std::string(Dim == 2 ? "[0, 0]" : "[0, 0, 0]"), "suspension.tiles={}"}));
  for (int i = 0; i < 9; ++i) simulation.step();
  CHECK(simulation.suspension()->max_speed() == 0);
  CHECK(simulation.masses().smoke_outflow == 0);
  CHECK(count<Dim>(simulation.suspension()->grid().cells) < std::pow(Dim == 2 ? 5 * 16 : 5 * 8, Dim) + 1);
}

TEMPLATE_TEST_CASE_SIG("Tiles leave the whole box's flow to an error that shrinks with the margin", "[tiles][slow]",
                       ((int Dim), Dim), 2, 3) {
  const Simulation<Dim> whole = run<Dim>({});
  std::vector<double> errors;
  for (const char* margin : {"1", "2", "3"}) {
    const Simulation<Dim> part =
        run<Dim>({"suspension.tiles.still_speed=0.5", "suspension.tiles.margin=" + std::string(margin)});
    CHECK(n_computed(*part.suspension()) <= n_computed(*whole.suspension()) / (margin[0] == '1' ? 3 : 1));
    CHECK(std::abs(part.mass_error()) < 1e-12);
    CHECK(part.masses().smoke_outflow < 1e-3 * part.masses().initial);
    errors.push_back(difference(*part.suspension(), *whole.suspension()));
  }
  CAPTURE(errors);
  CHECK(errors[0] < 0.1);
  CHECK(errors[1] < 0.75 * errors[0]);
  CHECK(errors[2] < 0.75 * errors[1]);
}

TEST_CASE("Tiles want air that begins at rest", "[tiles]") {
  const std::string text = cloud + "[suspension.tiles]\n";
  const auto refused = [&](const std::string& setting) {
    CHECK_THROWS_WITH(scene_of(text, {setting}), Catch::Contains("suspension.tiles: contradicts suspension."));
  };
  refused("suspension.wind=[1, 0]");
  refused("suspension.initial_flow=vortices");
}
