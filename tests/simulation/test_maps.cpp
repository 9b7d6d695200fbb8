// Scenes whose areas stand in map files, and whole folders of AvaFrame.

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/map_polygons.hpp"
#include "io/temporary_folder.hpp"
#include "scene_support.hpp"
#include "simulation/ground.hpp"
#include "simulation/local_origin.hpp"
#include "simulation/outline.hpp"
#include "simulation/plan.hpp"
#include "simulation/release.hpp"
#include "simulation/run.hpp"
#include "simulation/scene_writer.hpp"
#include "simulation/setup.hpp"
#include "simulation/simulation.hpp"

#ifdef SPINDRIFT_GDAL

#include "io/map_files.hpp"

using namespace spindrift;
namespace fs = std::filesystem;

namespace {

using Ring = std::vector<std::array<double, 2>>;

constexpr double east = 223000, north = 5365000;  // [m]

/// A slope of 61 x 41 points, 2 m apart, that falls by 0.6 along x.
ElevationGrid slope() {
  ElevationGrid grid{61, 41, east, north, 2, {}};
  for (int i = 0; i < grid.columns * grid.rows; ++i) grid.z.push_back(1500 - 0.6 * 2 * (i % grid.columns));
  return grid;
}

Ring square(double x, double y, double size) {
  return {{east + x, north + y},
          {east + x + size, north + y},
          {east + x + size, north + y + size},
          {east + x, north + y + size}};
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

/// An avalanche of about a thousand particles in a folder of AvaFrame.
class MountainFolder {
 public:
  MountainFolder() {
    fs::create_directories(ava() / "REL"), fs::create_directories(ava() / "ENT");
    write(ava() / "dem.asc", esri_grid_text(slope()));
    release({{{square(10, 20, 20)}, "1.2"}, {{square(10, 50, 10)}, " 0.8"}});
    write_shapefile(ava() / "ENT" / "ent.shp", {{{square(20, 10, 40)}, "0.5"}});
    scene("[terrain]\navaframe = \"ava\"\n");
  }
  void release(const std::vector<TestPolygon>& polygons, const char* field = "thickness", int epsg = 0) const {
    write_shapefile(ava() / "REL" / "rel.shp", polygons, field, epsg);
  }
  void scene(const std::string& text) const {
    write(path() / "a.toml", "schema_version = 1\n[scene]\ndim = 3\nend_time = 0.05\n" + text +
                                 "[dense_flow]\nsupport_radius = 2\n[cover]\n[entrainment]\n[output]\n"
                                 "frames_per_second = 20\npreview = false\n");
  }
  Scene read(const std::vector<std::string>& settings = {}) const { return read_scene(path() / "a.toml", settings); }
  std::string refusal(const std::vector<std::string>& settings = {}) const {
    try {
      read(settings);
    } catch (const Error& error) {
      return error.code() == ExitCode::bad_input ? error.what() : "wrong exit code";
    }
    return "";
  }
  const fs::path& path() const { return folder_.path(); }
  fs::path ava() const { return path() / "ava"; }

 private:
  TemporaryFolder folder_;
};

const std::string grid_keys = "[terrain]\nshape = \"grid\"\nfile = \"ava/dem.asc\"\n";

}  // namespace

TEST_CASE("A folder of AvaFrame is a scene: ground, domain, release and cover", "[map]") {
  const MountainFolder folder;
  const Scene scene = folder.read();
  CHECK(scene.terrain->shape == "grid");
  CHECK(scene.elevation->columns == 61);
  CHECK(scene.domain.lower == std::vector<double>{east + 1, north + 1, 1418});
  CHECK(scene.domain.upper == std::vector<double>{east + 119, north + 79, 1600});
  CHECK(scene.domain.front == "open");
  REQUIRE(scene.release.size() == 2);
  CHECK(scene.release[0].shape == "area");
  CHECK(scene.release[0].thickness == 1.2);
  CHECK(scene.release[1].thickness == 0.8);
  CHECK(scene.release[1].points.size() == 4);
  CHECK(scene.cover->depth == 0.5);
  REQUIRE(scene.cover->areas.size() == 1);

  const Plan plan = plan_scene(scene);
  const double ratio = std::hypot(1, 0.6);
  CHECK(plan.release_area == Approx(500 * ratio).epsilon(0.01));
  CHECK(plan.release_volume == Approx((400 * 1.2 + 100 * 0.8) * ratio).epsilon(0.01));
  CHECK(plan.cover_area == Approx(1600 * ratio).epsilon(0.01));
  const Scene near = around_local_origin(scene);
  const Walls<3> walls = make_walls<3>(near);
  auto cover = make_cover<3>(near, walls, 0);
  make_sleeping_cover(near, walls)->wake_all(*cover, *walls.terrain->height_field());
  CHECK(static_cast<double>(cover->particles.size()) == Approx(plan.n_cover).epsilon(0.02));
  for (const Foot<3>& foot : cover->foot) REQUIRE(inside(near.cover->areas[0], foot.place[0], foot.place[1]));
  // Where a release reaches over the cover its snow lies on the cover, elsewhere on the ground.
  const ReleasedSnow<3> snow = released_snow<3>(near, walls);
  CHECK(static_cast<double>(snow.particles.size()) == Approx(plan.n_release).epsilon(0.03));
  for (const Vec<3>& x : snow.particles.position) {
    const Foot<3> foot = walls.terrain->foot(x);
    const double base = inside(near.cover->areas[0], foot.place[0], foot.place[1]) ? 0.5 : 0;
    REQUIRE((foot.distance > base && foot.distance < base + 1.2));
  }
}

TEST_CASE("The folder may be told on the command line, be written in Inputs, and have a GeoTIFF", "[map]") {
  const MountainFolder folder;
  folder.scene("[terrain]\n[domain]\nback = \"closed\"\n[release]\ndensity = 250\n");
  const std::string set = "terrain.avaframe=" + folder.ava().string();
  const Scene scene = folder.read({set});
  CHECK(scene.release[1].density == 250);
  CHECK(scene.domain.back == "closed");
  CHECK(scene.domain.front == "open");
  fs::create_directory(folder.ava() / "Inputs");
  for (const char* part : {"dem.asc", "REL", "ENT"}) fs::rename(folder.ava() / part, folder.ava() / "Inputs" / part);
  CHECK(same(folder.read({set}), scene) == false);  // terrain.file is another
  CHECK(folder.read({set}).release[0].points == scene.release[0].points);
  write_geotiff(folder.ava() / "Inputs" / "dem.tif", slope());
  CHECK_THAT(folder.refusal({set}), Catch::StartsWith("--set: terrain.avaframe: ") &&
                                        Catch::Contains("2 elevation models, Inputs/dem.asc, Inputs/dem.tif"));
  fs::remove(folder.ava() / "Inputs" / "dem.asc");
  CHECK(folder.read({set}).elevation->z[7] == Approx(scene.elevation->z[7]).epsilon(1e-6));
}

TEST_CASE("The run folder of a map's scene runs again to the same digest, without the maps", "[map]") {
  const MountainFolder folder;
  const auto digest_of = [&](const Scene& scene, const std::string& to) {
    RunOptions options;
    options.folder = folder.path() / to;
    REQUIRE(run_scene(scene, options) == ExitCode::done);
    std::ifstream file(options.folder / "run.json");
    return nlohmann::json::parse(file)["digest"].get<std::string>();
  };
  const std::string first = digest_of(folder.read(), "one");
  fs::remove_all(folder.ava());
  CHECK(digest_of(read_scene(folder.path() / "one" / "scene.toml"), "two") == first);
}

TEST_CASE("A folder that is no scene is told, with what it has", "[map]") {
  const MountainFolder folder;
  const std::string place = (folder.path() / "a.toml").string() + ":6:12: terrain.avaframe: ";
  const std::string ava = folder.ava().string();
  const auto says = [&](const std::string& message) { CHECK(folder.refusal() == place + message); };
  SECTION("no folder") {
    fs::remove_all(folder.ava());
    says(ava + ": there is no such folder");
  }
  SECTION("no elevation model") {
    fs::remove(folder.ava() / "dem.asc");
    says(ava + ": no elevation model, an .asc or .tif, in it or in Inputs/; it has ENT, REL");
  }
  SECTION("no release") {
    fs::remove_all(folder.ava() / "REL");
    says(ava + ": no areas of release, a .shp in REL/ or Inputs/REL/; it has ENT, dem.asc");
  }
  SECTION("no cover") {
    fs::remove_all(folder.ava() / "ENT");
    says("no areas of the cover, a .shp in ENT/ or Inputs/ENT/: say cover.file, or leave out [cover]");
  }
  SECTION("cut off") {
    fs::resize_file(folder.ava() / "REL" / "rel.shp", 150);
    CHECK_THAT(folder.refusal(), Catch::StartsWith(place) && Catch::Contains("rel.shp: "));
  }
  SECTION("keys that contradict it") {
    folder.scene("[terrain]\navaframe = \"ava\"\nfile = \"dem.asc\"\n");
    CHECK_THAT(folder.refusal(), Catch::StartsWith(place + "contradicts terrain.file at "));
    folder.scene("[terrain]\navaframe = \"ava\"\nshape = \"plane\"\n");
    CHECK_THAT(folder.refusal(), Catch::StartsWith(place + "contradicts terrain.shape at "));
    folder.scene("[terrain]\navaframe = \"ava\"\n[release]\npoints = [[1, 1], [2, 2], [2, 3]]\n");
    CHECK_THAT(folder.refusal(), Catch::StartsWith(place + "contradicts release.points at "));
    folder.scene("[terrain]\navaframe = \"ava\"\n[release]\nshape = \"ball\"\n");
    CHECK_THAT(folder.refusal(), Catch::StartsWith(place + "contradicts release.shape at "));
    folder.scene("[terrain]\navaframe = \"ava\"\n");
    CHECK_THAT(folder.refusal({"scene.dim=2"}), Catch::Contains("needs scene.dim = 3"));
  }
}

TEST_CASE("Thickness comes from the map or the scene, and is told where neither has it", "[map]") {
  const MountainFolder folder;
  const std::string place = (folder.path() / "a.toml").string() + ":6:12: terrain.avaframe: ";
  const std::string file = (folder.ava() / "REL" / "rel.shp").string();
  const auto with = [&](const std::string& thickness, const char* field = "thickness") {
    folder.release({{{square(10, 20, 20)}, "1"}, {{square(10, 50, 10)}, thickness}}, field);
    return folder.refusal();
  };
  CHECK(with("0.7", "D0") == "");
  CHECK(folder.read().release[1].thickness == 0.7);
  const std::string none =
      place + file +
      ": polygon 2: has no thickness, expected metres in its field \"thickness\" or \"d0\", or release.thickness in "
      "the scene";
  CHECK(with("") == none);
  CHECK(with("None") == none);
  CHECK(with("1", "depth") != "");
  const std::string scene = "[terrain]\navaframe = \"ava\"\n[release]\nthickness = 1.5\n";
  folder.scene(scene);
  CHECK(with("") == "");
  CHECK(folder.read().release[1].thickness == 1.5);
  folder.scene("[terrain]\navaframe = \"ava\"\n");
  for (const char* bad : {"0", "-1", "101"})
    CHECK(with(bad) == place + file + ": polygon 2: thickness: got " + bad + ", expected above 0 and at most 100 m");
  for (const char* bad : {"nan", "much", "inf"}) CHECK_THAT(with(bad), Catch::Contains("polygon 2: thickness: got"));
}

TEST_CASE("Polygons off the elevation model, over its holes or in other coordinates are told", "[map]") {
  const MountainFolder folder;
  const std::string place = (folder.path() / "a.toml").string() + ":6:12: terrain.avaframe: ";
  const std::string who = place + (folder.ava() / "REL" / "rel.shp").string() + ": polygon 1: ";
  folder.release({{{square(110, 20, 20)}, "1"}});
  CHECK(folder.refusal() == who +
                                "reaches 223130 along x, expected it over the elevation model, which has heights "
                                "from 222999 to 223121");
  folder.release({{{square(-0.5, 20, 10)}, "1"}});
  CHECK(folder.refusal() ==
        who + "reaches 222999.5 along x, expected it inside the domain, which goes from 223001 to 223119");
  folder.release({{{square(10, 20, 20)}, "1"}}, "thickness", 31287);
  CHECK(folder.refusal() == "");
  ElevationGrid holed = slope();
  holed.at(8, 12) = std::nan("");
  write(folder.ava() / "dem.asc", esri_grid_text(holed));
  CHECK(folder.refusal() == who + "lies over a hole of the elevation model at (223016, 5365024)");
  write(folder.ava() / "dem.asc", esri_grid_text(slope()));
  write_shapefile(folder.path() / "other.shp", {{{square(1, 2, 2)}, "1"}}, "thickness", 32632);
  fs::copy_file(folder.path() / "other.prj", folder.ava() / "dem.prj");
  CHECK_THAT(folder.refusal(), Catch::Contains("is in another system of coordinates than"));
}

TEST_CASE("Releases, cover and obstacles from files of one's own, with holes", "[map]") {
  const MountainFolder folder;
  Ring hole = square(16, 26, 8);
  std::reverse(hole.begin(), hole.end());
  write_shapefile(folder.path() / "own.shp", {{{square(10, 20, 20), hole}, "1"}});
  write_shapefile(folder.path() / "dam.shp", {{{square(80, 20, 10)}, ""}, {{square(80, 50, 10)}, ""}});
  folder.scene(
      grid_keys +
      "[[release]]\nshape = \"area\"\nthickness = 1\npoints = [[223050, 5365050], [223060, 5365050], [223060, "
      "5365060]]\n[[release]]\nshape = \"area\"\nfile = \"own.shp\"\nvelocity = [1, 2, 3]\n[obstacle]\nshape = "
      "\"area\"\nfile = \"dam.shp\"\nheight = 7\n");
  const Scene scene = folder.read({"cover.file=ava/ENT/ent.shp", "cover.depth=0.25"});
  REQUIRE(scene.release.size() == 2);
  CHECK(scene.release[1].velocity == std::vector<double>{1, 2, 3});
  CHECK(scene.cover->depth == 0.25);
  CHECK(scene.cover->areas.size() == 1);
  REQUIRE(scene.obstacle.size() == 2);
  CHECK(scene.obstacle[1].height == 7);
  const Plan plan = plan_scene(scene);
  CHECK(plan.release_area == Approx((400 - 64 + 50) * std::hypot(1, 0.6)).epsilon(0.02));
  const Walls<3> walls = make_walls<3>(scene);
  CHECK(walls.obstacles.empty());
  CHECK(walls.terrain->height({east + 85, north + 55, 0}) == Approx(1500 - 0.6 * 85 + 7));
  for (const Vec<3>& x : released_snow<3>(scene, walls).particles.position) {
    const Foot<3> foot = walls.terrain->foot(x);
    REQUIRE_FALSE((std::abs(foot.place[0] - east - 20) < 4 && std::abs(foot.place[1] - north - 30) < 4));
  }
  const std::string start = (folder.path() / "a.toml").string();
  folder.scene(grid_keys + "[release]\nfile = \"own.shp\"\n");
  CHECK_THAT(folder.refusal(),
             Catch::StartsWith(start + ":9:8: release.file: needs release.shape = \"area\"; it is \"slab\" at "));
  folder.scene(grid_keys + "[release]\nshape = \"area\"\nfile = \"own.shp\"\npoints = [[1, 1], [2, 2], [2, 3]]\n");
  CHECK_THAT(folder.refusal(), Catch::Contains("release.file: contradicts release.points at"));
  folder.scene(grid_keys + "[release]\nshape = \"area\"\nfile = \"none.shp\"\n");
  CHECK(folder.refusal() ==
        start + ":10:8: release.file: " + (folder.path() / "none.shp").string() + ": there is no such file");
  write_shapefile(folder.path() / "two.shp", {{{square(10, 20, 20)}, "0.3"}, {{square(40, 20, 20)}, "0.4"}});
  folder.scene(grid_keys);
  CHECK_THAT(folder.refusal({"cover.file=two.shp"}),
             Catch::Contains("polygon 2: is 0.4 m thick, others are 0.3 m: the cover has one depth, say cover.depth"));
}

TEST_CASE("The avalanche's path comes from the folder's LINES or from a file of one's own", "[map][path]") {
  const MountainFolder folder;
  CHECK(!folder.read().path);
  const Ring line{{east + 10, north + 30}, {east + 60, north + 30}, {east + 100, north + 60}};
  fs::create_directories(folder.ava() / "LINES");
  write_lines(folder.ava() / "LINES" / "path_aimec.shp", {line});
  write_lines(folder.ava() / "LINES" / "something_else.shp", {line, line});
  const Scene scene = folder.read();
  REQUIRE(scene.path);
  CHECK(scene.path->points == line);
  CHECK(around_local_origin(scene).path->points[0] == std::array<double, 2>{10, 30});
  CHECK(parse_scene(write_scene(scene), (folder.path() / "kept.toml").string()).path->points == line);

  // The scene's own goes before.
  write_lines(folder.path() / "own.shp", {{line[0], line[2]}});
  CHECK(folder.read({"path.file=own.shp"}).path->points.size() == 2);
  CHECK(folder.read({"path.points=[[223020, 5365020], [223040, 5365040]]"}).path->points[1][0] == 223040);

  const std::string place = (folder.path() / "a.toml").string() + ":6:12: terrain.avaframe: ";
  const std::string file = (folder.ava() / "LINES" / "path_aimec.shp").string();
  write_lines(file, {{line[0], {east + 130, north + 30}}});
  CHECK(folder.refusal() ==
        place + file + ": reaches 223130 along x, expected it inside the domain, which goes from 223001 to 223119");
  write_lines(file, {line, line});
  CHECK(folder.refusal() == place + file + ": there are 2 lines in it, expected one");
  write_shapefile(file, {{{square(10, 20, 20)}, ""}});
  CHECK(folder.refusal() == place + file + ": feature 1 is a Polygon, expected a line");
  write_lines(folder.ava() / "LINES" / "b_aimec.shp", {line});
  CHECK_THAT(folder.refusal(), Catch::Contains("b_aimec.shp and ") && Catch::Contains(": say path.file"));
  CHECK(folder.refusal({"path.file=own.shp"}) == "");
  write_lines(folder.path() / "own.shp", {line}, 32632);
  write_shapefile(folder.path() / "other.shp", {{{square(1, 2, 2)}, "1"}}, "thickness", 31287);
  fs::copy_file(folder.path() / "other.prj", folder.ava() / "dem.prj");
  CHECK_THAT(folder.refusal({"path.file=own.shp"}),
             Catch::Contains("--set: path.file: ") && Catch::Contains("is in another system of coordinates than"));
}

TEST_CASE("The scenes of configs/real run on a folder of AvaFrame", "[map][configs]") {
  const MountainFolder folder;
  for (const char* name : {"kot", "hit"}) {
    CAPTURE(name);
    const fs::path file = fs::path(SPINDRIFT_SOURCE_DIR) / "configs" / "real" / (std::string(name) + ".toml");
    const Scene scene = read_scene(file, {"terrain.avaframe=" + folder.ava().string(), "dense_flow.support_radius=2"});
    Simulation<3> simulation(scene);
    for (int i = 0; i < 5; ++i) simulation.step();
    CHECK(std::abs(simulation.mass_error()) < 1e-12);
    CHECK_THROWS_AS(read_scene(file), Error);
  }
}

#endif
