// Maps seen from above: peaks, deposit, erosion.

#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>

#include "core/parallel.hpp"
#include "io/temporary_folder.hpp"
#include "simulation/pylons.hpp"
#include "simulation/rasters.hpp"
#include "simulation/run.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;
namespace fs = std::filesystem;

namespace {

constexpr double slope = 35 * M_PI / 180;

/// A slab on a plane that falls along x, 0.9 m thick under a square of 4 m, at 10 m/s down the slope.
const std::string slab = R"(
schema_version = 1
[scene]
name = "slab"
dim = 3
end_time = 0.3
[domain]
lower = [0, 0, 0]
upper = [16, 8, 16]
[terrain]
shape = "plane"
start = [0, 12]
angle = "35 deg"
[dense_flow]
support_radius = 0.4
[[release]]
shape = "area"
thickness = 0.8
points = [[2, 2], [6, 2], [6, 6], [2, 6]]
velocity = [8.191520, 0, -5.735764]
)";

const std::string with_cover = slab + "[cover]\ndepth = 0.6\n[entrainment]\nrate = 100\n";

/// A box of snow that flies at 40 m/s through a domain without gravity, 1 m over level ground.
const std::string flight = R"(
schema_version = 1
[scene]
name = "flight"
dim = 3
end_time = 0.4
[domain]
lower = [0, 0, 0]
upper = [24, 6, 6]
gravity = [0, 0, 0]
[terrain]
shape = "plane"
start = [0, 0.5]
angle = 0
[dense_flow]
support_radius = 0.5
friction_acts_on = "none"
[[release]]
shape = "box"
lower = [1, 1, 2]
upper = [4, 5, 3]
velocity = [40, 0, 0]
)";

const Raster& named(const std::vector<Raster>& all, const std::string& name) {
  const auto found = std::find_if(all.begin(), all.end(), [&](const Raster& r) { return r.name == name; });
  REQUIRE(found != all.end());
  return *found;
}

double at(const ElevationGrid& map, double x, double y) {
  return map.at(static_cast<int>(std::lround((x - map.x) / map.cell)),
                static_cast<int>(std::lround((y - map.y) / map.cell)));
}

/// sum of value times area of ground, on a plane of that angle.
double integral(const ElevationGrid& map, double angle) {
  return std::accumulate(map.z.begin(), map.z.end(), 0.0) * map.cell * map.cell / std::cos(angle);
}

/// The maps after a run to the scene's end.
std::vector<Raster> maps_of(Simulation<3>& simulation) {
  Rasters rasters(simulation);
  rasters.follow(simulation);
  while (!simulation.done()) {
    simulation.step();
    rasters.follow(simulation);
  }
  return rasters.maps(simulation);
}

}  // namespace

TEST_CASE("Values go from cells to larger, smaller and shifted ones by the area that they share", "[rasters]") {
  const MacGrid<2> from{{0, 0}, 1, {2, 2}};
  const std::vector<double> values{1, 3, 5, 9};
  CHECK(on_cells(from, values, {{0, 0}, 2, {1, 1}}) == std::vector<double>{4.5});
  CHECK(on_cells(from, values, {{0, 0}, 0.5, {4, 2}}) == std::vector<double>{1, 1, 3, 3, 1, 1, 3, 3});
  CHECK(on_cells(from, values, {{0.25, 0}, 1, {1, 1}})[0] == Approx(1.5));
  CHECK(on_cells(from, values, {{1.5, 1.5}, 1, {2, 1}}) == std::vector<double>{9, 0});
}

TEST_CASE("Ground under a cell: that of a plane and of a profile", "[rasters]") {
  const MacGrid<2> cells{{4, 2}, 1.5, {3, 2}};
  const Simulation<3> plane(scene_of(slab));
  for (const double area : ground_areas(*plane.walls().terrain, cells, 2))
    CHECK(area == Approx(1.5 * 1.5 / std::cos(slope)).epsilon(1e-6));
  const Terrain<3> profile(std::vector<Vec<2>>{{0, 10}, {20, -10}});
  for (const double area : ground_areas(profile, cells, 1)) CHECK(area == Approx(1.5 * 1.5 * std::sqrt(2)));
}

TEST_CASE("Maps have the cells of the elevation model, of the ground or of the particles", "[rasters]") {
  Scene scene = scene_of(slab, {"domain.upper=[16, 7.5, 16]"});
  CHECK(empty_map(scene).cell == 1);
  CHECK(empty_map(scene).columns == 16);
  CHECK(empty_map(scene).rows == 8);
  CHECK(empty_map(scene).x == 0.5);
  scene.output.raster_cell = 5;
  CHECK(empty_map(scene).columns == 4);
  CHECK(empty_map(scene_of(small_avalanche_3d)).cell == 0.3);
  scene.output.raster_cell = 1e-4;
  CHECK_THROWS_AS(empty_map(scene), Error);

  auto model = std::make_shared<ElevationGrid>(ElevationGrid{40, 30, 500000.5, 200000.5, 2, {}});
  model->z.assign(1200, 0);
  scene.output.raster_cell = 0;
  scene.elevation = model;
  scene.domain.lower = {10, 5, 0}, scene.domain.upper = {30, 25, 9};
  scene.origin = {500000, 200000, 0};
  const ElevationGrid map = empty_map(scene);
  CHECK(map.x == 500008.5);
  CHECK(map.y == 200004.5);
  CHECK(map.columns == 12);
  CHECK(map.rows == 12);
  CHECK(cells_of(map, scene.origin).origin == Vec<2>(7.5, 3.5));
}

TEST_CASE("A slab has its thickness, speed and pressure on maps of any cell", "[rasters]") {
  const std::string cell = GENERATE("0.1", "0.4", "0.5", "1");
  CAPTURE(cell);
  const Simulation<3> simulation(scene_of(slab, {"output.raster_cell=" + cell}));
  const std::vector<Raster> maps = Rasters(simulation).maps(simulation);
  const double volume =
      std::accumulate(simulation.dense()->particles.volume.begin(), simulation.dense()->particles.volume.end(), 0.0);
  CHECK(integral(named(maps, "deposit").map, slope) == Approx(volume).epsilon(1e-3));
  double mean = 0;
  for (double x = 3.0; x < 5.01; x += 0.1)
    for (double y = 3.0; y < 5.01; y += 0.1) {
      const double thickness = at(named(maps, "flow_thickness").map, x, y);
      CHECK(thickness == Approx(0.8).epsilon(0.1));  // no holes, no heaps
      mean += thickness / (21 * 21);
      CHECK(at(named(maps, "flow_speed").map, x, y) == Approx(10).epsilon(1e-4));
      CHECK(at(named(maps, "flow_pressure").map, x, y) == Approx(30).epsilon(1e-4));
    }
  CHECK(mean == Approx(0.8).epsilon(0.02));
  CHECK(at(named(maps, "flow_thickness").map, 10, 4) == 0);
  CHECK(at(named(maps, "flow_pressure").map, 10, 4) == 0);
  CHECK(maps.size() == 4);
}

TEST_CASE("Deposit and erosion hold the mass that lies there and that was taken", "[rasters]") {
  const std::string cell = GENERATE("0", "0.15", "3");
  CAPTURE(cell);
  const Scene scene = scene_of(with_cover, {"output.raster_cell=" + cell, "dense_flow.friction_mu=2"});
  Simulation<3> simulation(scene);
  const std::vector<Raster> maps = maps_of(simulation);
  REQUIRE(simulation.masses().n_entrained > 20);
  CHECK(integral(named(maps, "erosion").map, slope) * scene.cover->density ==
        Approx(simulation.masses().entrained).epsilon(0.01));
  const auto& volume = simulation.dense()->particles.volume;
  CHECK(integral(named(maps, "deposit").map, slope) ==
        Approx(std::accumulate(volume.begin(), volume.end(), 0.0)).epsilon(0.01));
  for (std::size_t i = 0; i < maps[0].map.z.size(); ++i)
    CHECK(named(maps, "deposit").map.z[i] <= named(maps, "flow_thickness").map.z[i]);
}

TEST_CASE("Snow that has settled holds the mass of its deposit", "[rasters][slow]") {
  // Compaction makes all snow as dense as the flow.
  const Scene scene =
      scene_of(with_cover, {"scene.end_time=2.5", "dense_flow.friction_mu=2", "domain.right=\"closed\""});
  Simulation<3> simulation(scene);
  const std::vector<Raster> maps = maps_of(simulation);
  CHECK(integral(named(maps, "deposit").map, slope) * scene.dense_flow->density ==
        Approx(simulation.dense_mass()).epsilon(0.01));
}

TEST_CASE("A fast flow leaves its peak in every cell on its way", "[rasters]") {
  const std::string cell = GENERATE("0.25", "0.5", "1");
  CAPTURE(cell);
  Simulation<3> simulation(scene_of(flight, {"output.raster_cell=" + cell}));
  const std::vector<Raster> maps = maps_of(simulation);
  for (double x = 2.5; x < 15; x += 0.125) {
    CAPTURE(x);
    CHECK(at(named(maps, "flow_thickness").map, x, 2.6) == Approx(1).epsilon(0.05));
    CHECK(at(named(maps, "flow_pressure").map, x, 2.6) == Approx(480).epsilon(0.01));
  }
}

TEST_CASE("Smoke and cloud are those of the columns of air", "[rasters]") {
  const std::string smoke = without(slab, {"dense_flow", "[release]"}) +
                            "[suspension]\ncell_size = 0.5\nsettling_speed = 0\nfrozen = true\nwind = [10, 0, 0]\n"
                            "[smoke]\ndensity = 2\nlower = [2, 2, 14]\nupper = [4, 4, 15]\n[output]\nraster_cell = 1\n";
  Simulation<3> simulation(scene_of(smoke, {"scene.end_time=0.8"}));
  const std::vector<Raster> maps = maps_of(simulation);
  CHECK(maps.size() == 2);
  CHECK(at(named(maps, "smoke_density").map, 2.5, 3.5) == 2);
  CHECK(at(named(maps, "smoke_density").map, 7.5, 3.5) == Approx(2).epsilon(0.15));
  CHECK(at(named(maps, "smoke_density").map, 7.5, 6.5) == 0);
  // The middle of the highest cell, normal to the plane; a cell of the map has two columns along the slope.
  const double height = 14.75 - (12 - 2.5 * std::tan(slope));
  CHECK(at(named(maps, "cloud_height").map, 2.5, 3.5) == Approx(height * std::cos(slope)).epsilon(1e-3));
}

TEST_CASE("Smoke on tiles lies where it lies in the whole grid", "[rasters][pylons]") {
  const std::string smoke =
      without(slab, {"dense_flow", "[release]"}) +
      "[[pylon]]\nposition = [3, 3]\nheight = 4\n[[pylon]]\nposition = [15.5, 7.5]\nheight = 12\n"
      "[suspension]\ncell_size = 0.25\n[smoke]\ndensity = 2\nlower = [2, 2, 12]\nupper = [4, 4, 15]\n";
  const Simulation<3> whole(scene_of(smoke)), tiles(scene_of(smoke + "[suspension.tiles]\n"));
  REQUIRE(tiles.suspension()->smoke_mass().size() < whole.suspension()->smoke_mass().size());
  const std::vector<Raster> a = Rasters(whole).maps(whole), b = Rasters(tiles).maps(tiles);
  for (const std::size_t k : {0, 1}) CHECK(a[k].map.z == b[k].map.z);
  Pylons<3> felt(whole), felt_on_tiles(tiles);
  CHECK(*felt.follow(whole) == *felt_on_tiles.follow(tiles));
  CHECK((*Pylons<3>(tiles).follow(tiles))[1] == Approx(2));
}

TEST_CASE("Maps are the same bits with any number of threads", "[rasters]") {
  std::vector<std::string> texts;
  for (const int n : {1, 2, 5}) {
    const ThreadLimit threads(n);
    Simulation<3> simulation(scene_of(with_cover, {"scene.end_time=0.05"}));
    texts.emplace_back();
    for (const Raster& raster : maps_of(simulation)) texts.back() += raster.name + esri_grid_text(raster.map);
  }
  CHECK(texts[0] == texts[1]);
  CHECK(texts[0] == texts[2]);
}

TEST_CASE("A run leaves its maps, whatever its frames, and none where it is not to", "[rasters][run]") {
  const TemporaryFolder folder;
  const auto run = [&](const char* name, std::string_view text, std::vector<std::string> settings) {
    RunOptions options;
    options.folder = folder.path() / name;
    settings.insert(settings.end(), {"scene.end_time=0.04", "output.preview=false"});
    REQUIRE(run_scene(scene_of(text, settings), options) == ExitCode::done);
    return options.folder;
  };
  const fs::path bare = run("bare", slab, {"output.frames_per_second=0"});
  const fs::path often = run("often", slab, {"output.frames_per_second=200"});
  for (const char* name : {"flow_thickness", "flow_speed", "flow_pressure", "deposit"}) {
    const fs::path file = fs::path("peaks") / (std::string(name) + ".asc");
    CAPTURE(file.string());
    CHECK(text_of(bare / file) == text_of(often / file));
    CHECK(read_esri_grid(bare / file).columns == 16);
  }
  CHECK(!fs::exists(run("off", slab, {"output.rasters=false"}) / "peaks"));
  CHECK(!fs::exists(run("flat", small_avalanche, {}) / "peaks"));
}
