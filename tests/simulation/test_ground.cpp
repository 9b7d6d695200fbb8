// Scenes on height fields: their shapes, elevation models, areas of release, and what is wrong with them.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/esri_grid.hpp"
#include "io/temporary_folder.hpp"
#include "io/vtkhdf.hpp"
#include "scene_support.hpp"
#include "simulation/ground.hpp"
#include "simulation/plan.hpp"
#include "simulation/release.hpp"
#include "simulation/run.hpp"
#include "simulation/scene_warnings.hpp"
#include "simulation/scenery.hpp"
#include "simulation/setup.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;
namespace fs = std::filesystem;

namespace {

/// An avalanche of some hundred particles; `ground` are the keys of [terrain].
std::string avalanche(const std::string& ground) {
  return "schema_version = 1\n[scene]\ndim = 3\nend_time = 0.05\n[domain]\nlower = [0, 0, 0]\nupper = [12, 8, 24]\n"
         "[terrain]\n" +
         ground +
         "[dense_flow]\nsupport_radius = 0.6\n[release]\nshape = \"area\"\nthickness = 0.9\nvelocity = [3, 0, -2]\n"
         "points = [[2, 2], [5, 2], [5, 5], [2, 5]]\n"
         "[cover]\ndepth = 0.6\n[entrainment]\n[suspension]\ncell_size = 1\n[coupling.drag]\n[coupling.generation]\n"
         "threshold_speed = 0\n[coupling.adhesion]\n[output]\nframes_per_second = 20\n";
}

/// A hill of 17 x 13 points, 1 m apart, the south-western one at (x, y).
ElevationGrid hill(double x, double y) {
  ElevationGrid grid{17, 13, x, y, 1, {}};
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column)
      grid.z.push_back(14 - 0.7 * column + 0.02 * (row - 6) * (row - 6));
  return grid;
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

std::string refusal_of(const fs::path& scene) {
  try {
    read_scene(scene);
  } catch (const Error& error) {
    return error.code() == ExitCode::bad_input ? error.what() : "wrong exit code";
  }
  return "";
}

}  // namespace

TEST_CASE("Every 3D shape carries an avalanche with a closed ledger", "[ground]") {
  const std::string shape = GENERATE("plane", "parabola", "bowl", "helix", "ridge", "cliff_band", "valley");
  CAPTURE(shape);
  std::string keys = "shape = \"" + shape + "\"\nstart = [0, 20]\nangle = \"35 deg\"\ncell_size = 0.5\n";
  if (shape != "plane" && shape != "valley") keys += "drop = 12\n";
  if (shape == "ridge" || shape == "cliff_band") keys += "transition_radius = 2\n";
  if (shape == "cliff_band") keys += "cliff_at = 5\ncliff_height = 3\n";
  if (shape == "helix") keys += "bend_radius = 10\nchannel_depth = 1\nchannel_width = 6\n";
  if (shape == "valley") keys += "floor_width = 4\ntransition_radius = 2\n";
  const Scene scene = parse_scene(avalanche(keys), "a.toml");
  Simulation<3> simulation(scene);
  REQUIRE(simulation.walls().terrain->height_field() != nullptr);
  REQUIRE(simulation.dense()->particles.size() > 200);
  REQUIRE(simulation.cover()->particles.size() > 1000);
  for (int i = 0; i < 5; ++i) simulation.step();
  CHECK(std::abs(simulation.mass_error()) < 1e-12);
  CHECK(simulation.masses().n_outflow == 0);
}

TEST_CASE("An area of release has its thickness normal to the ground", "[ground]") {
  const double tilt = GENERATE(0.0, 40.0);
  const Scene scene = parse_scene(avalanche("shape = \"plane\"\nstart = [0, 16]\nangle = \"35 deg\"\nside_angle = \"" +
                                            std::to_string(tilt) + " deg\"\n"),
                                  "a.toml", {"dense_flow.support_radius=0.3"});
  const Walls<3> walls = make_walls<3>(scene);
  const ReleasedSnow<3> snow = released_snow<3>(scene, walls);
  const double ratio = std::hypot(1, std::tan(35 * M_PI / 180), std::tan(tilt * M_PI / 180));
  const double volume = 9 * ratio * 0.9;
  CHECK(static_cast<double>(snow.particles.size()) == Approx(volume / std::pow(0.15, 3)).epsilon(0.02));
  CHECK(snow.releases[0].buried == 0);
  for (const Vec<3>& x : snow.particles.position) {
    const Foot<3> foot = walls.terrain->foot(x);
    REQUIRE((foot.distance > 0.6 && foot.distance < 1.5));
    REQUIRE((foot.place[0] > 2 && foot.place[0] < 5 && foot.place[1] > 2 && foot.place[1] < 5));
  }
  const Plan plan = plan_scene(scene);
  CHECK(plan.n_release == Approx(volume / std::pow(0.15, 3)).epsilon(0.01));
  CHECK(plan.n_cover == Approx(12 * 8 * ratio * 0.6 / std::pow(0.15, 3)).epsilon(0.01));
}

TEST_CASE("Two areas of release never lie in each other, and obstacles stay free", "[ground]") {
  const std::string text = avalanche("shape = \"plane\"\nstart = [0, 16]\n");
  const auto count = [&](const std::string& more) {
    const Scene scene = parse_scene(text + more, "a.toml");
    return released_snow<3>(scene, make_walls<3>(scene));
  };
  const std::size_t alone = count("").particles.size();
  const ReleasedSnow<3> with_box = count("[obstacle]\nlower = [3, 3, 0]\nupper = [4, 4, 24]\n");
  CHECK(with_box.releases[0].buried > 0);
  CHECK(with_box.particles.size() + with_box.releases[0].buried == alone);
  std::string two = text;
  const std::string release = "[release]\nshape = \"area\"\n";
  two.replace(two.find(release), release.size(), "[[release]]\nshape = \"area\"\n");
  const Scene scene = parse_scene(
      two + "[[release]]\nshape = \"area\"\nthickness = 0.9\npoints = [[4, 2], [7, 2], [7, 5], [4, 5]]\n", "a.toml");
  const ReleasedSnow<3> both = released_snow<3>(scene, make_walls<3>(scene));
  CHECK(both.releases[0].placed == alone);
  CHECK(static_cast<double>(both.releases[1].doubled) == Approx(static_cast<double>(alone) / 3).epsilon(0.15));
}

TEST_CASE("The ground of an elevation model goes through its heights, holes beyond the domain are filled", "[ground]") {
  Scene scene = parse_scene(avalanche("shape = \"plane\"\n"), "a.toml");
  scene.terrain->shape = "grid";
  ElevationGrid model = hill(-2, -2);
  model.at(16, 0) = std::nan("");
  scene.elevation = std::make_shared<const ElevationGrid>(model);
  const Terrain<3> ground = make_terrain<3>(scene);
  CHECK(ground.height({3, 4, 0}) == Approx(model.at(5, 6)));
  CHECK(ground.height({14, -1, 0}) == Approx(model.at(16, 1)));
  CHECK(ground.height({14, -2, 0}) == Approx(ground.height({13, -2, 0})));  // the two neighbours are as near
}

TEST_CASE("An elevation model is kept in the run folder, from where the run can be done again", "[ground]") {
  const TemporaryFolder folder;
  write(folder.path() / "dem.asc", esri_grid_text(hill(-2.5, -1.75)));
  write(folder.path() / "a.toml", avalanche("shape = \"grid\"\nfile = \"dem.asc\"\n"));
  const auto digest_of = [&](const fs::path& scene, const std::string& to) {
    RunOptions options;
    options.folder = folder.path() / to;
    REQUIRE(run_scene(read_scene(scene), options) == ExitCode::done);
    std::ifstream file(options.folder / "run.json");
    return nlohmann::json::parse(file)["digest"].get<std::string>();
  };
  const std::string first = digest_of(folder.path() / "a.toml", "one");
  fs::remove(folder.path() / "dem.asc");
  CHECK(digest_of(folder.path() / "one" / "scene.toml", "two") == first);
}

TEST_CASE("Far from zero the same avalanche runs to the bit, and is written in the scene's coordinates", "[ground]") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, double x, double y) {
    write(folder.path() / (name + ".asc"), esri_grid_text(hill(x - 2, y - 2)));
    const auto pair = [&](double dx, double dy) { return std::to_string(x + dx) + ", " + std::to_string(y + dy); };
    std::string text = avalanche("shape = \"grid\"\nfile = \"" + name + ".asc\"\n");
    const auto replace = [&](const std::string& from, const std::string& to) {
      text.replace(text.find(from), from.size(), to);
    };
    replace("lower = [0, 0, 0]", "lower = [" + pair(0, 0) + ", 0]");
    replace("upper = [12, 8, 24]", "upper = [" + pair(12, 8) + ", 24]");
    replace("[[2, 2], [5, 2], [5, 5], [2, 5]]",
            "[[" + pair(2, 2) + "], [" + pair(5, 2) + "], [" + pair(5, 5) + "], [" + pair(2, 5) + "]]");
    text += "[obstacle]\nlower = [" + pair(7, 3) + ", 0]\nupper = [" + pair(8, 4) + ", 20]\n";
    write(folder.path() / (name + ".toml"), text);
    RunOptions options;
    options.folder = folder.path() / name;
    REQUIRE(run_scene(read_scene(folder.path() / (name + ".toml")), options) == ExitCode::done);
    std::ifstream file(options.folder / "run.json");
    return nlohmann::json::parse(file)["digest"].get<std::string>();
  };
  CHECK(run("near", 0, 0) == run("far", 223000, 5365000));
  const auto frame_of = [&](const std::string& frame) {
    std::ifstream file(folder.path() / frame, std::ios::binary);
    const std::string text{std::istreambuf_iterator<char>(file), {}};
    return read_vtkhdf(std::as_bytes(std::span(text)), frame);
  };
  const auto first_of = [&](const std::string& frame) {
    const StoredFrame stored = frame_of(frame);
    const auto points = std::ranges::find(stored.arrays, "Points", &StoredArray::name);
    return std::visit([](const auto& v) { return Vec<3>(double(v[0]), double(v[1]), double(v[2])); }, points->values);
  };
  const std::string particles = "/frames/particles_000000.hdf", smoke = "/frames/smoke_000000.hdf";
  CHECK((first_of("far" + particles) - first_of("near" + particles) - Vec<3>(223000, 5365000, 0)).norm() < 1e-5);
  CHECK(frame_of("far" + smoke).lattice->origin[1] == Approx(5365000.5).epsilon(1e-12));
}

TEST_CASE("Ground that does not go with its scene is told with its place", "[ground]") {
  const std::string head =
      "schema_version = 1\n[domain]\nlower = [0, 0, 0]\nupper = [12, 8, 24]\n[scene]\ndim = 3\n[terrain]\n";  // 7 lines
  const auto says = [](const std::string& text, const std::string& message) { CHECK(refusal(text) == message); };
  says("schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [9, 9]\n[terrain]\nshape = \"bowl\"\n",
       "a.toml:6:9: terrain.shape: got \"bowl\", expected ground of a slice, as \"slope\" or \"polyline\": scene.dim "
       "is 2");
  says(head + "shape = \"boul\"\n",
       "a.toml:8:9: terrain.shape: got \"boul\", expected \"slope\", \"bumps\", \"cliff\", \"polyline\", \"plane\", "
       "\"parabola\", \"bowl\", \"helix\", \"ridge\", \"cliff_band\", \"valley\" or \"grid\"; did you mean \"bowl\"?");
  says(head + "shape = \"grid\"\n",
       "a.toml:7:2: terrain.file: missing, expected the path of an elevation model, or terrain.avaframe");
  says(head + "shape = \"grid\"\nfile = \"no.asc\"\n", "a.toml:9:8: terrain.file: there is no file no.asc");
  says(head + "shape = \"ridge\"\nfile = \"no.asc\"\n",
       "a.toml:9:8: terrain.file: needs terrain.shape = \"polyline\" or \"grid\"; it is \"ridge\" at a.toml:8:9");
  says(head + "angle = 0\n", "a.toml:8:9: terrain.angle: got 0, expected more: ground of shape \"slope\" falls");
  CHECK(refusal(head + "shape = \"valley\"\nangle = 0\n") == "");
  says(head + "shape = \"cliff_band\"\ncliff_angle = 0.5\nangle = 0.7\n",
       "a.toml:9:15: terrain.cliff_angle: got 0.5 rad, expected more than the slope's angle of 0.7 rad at "
       "a.toml:10:9");
  const std::string snow = "[dense_flow]\n[release]\n";
  says(head + "shape = \"plane\"\n" + snow,
       "a.toml:10:2: release.shape: \"slab\" needs ground that is the same all along y, terrain.shape is \"plane\" at "
       "a.toml:8:9; did you mean \"area\"?");
  says(head + snow + "shape = \"area\"\npoints = [[1, 1], [2, 1], [2, 2]]\n",
       "a.toml:10:9: release.shape: \"area\" needs one of the 3D grounds \"plane\", \"parabola\", \"bowl\", \"helix\", "
       "\"ridge\", \"cliff_band\", \"valley\", \"grid\", terrain.shape is \"slope\" at a.toml:7:2; did you mean "
       "\"slab\"?");
  says(head + "shape = \"plane\"\n" + snow + "shape = \"area\"\npoints = [[1, 1], [2, 9]]\n",
       "a.toml:12:10: release.points: got 2 points, expected at least 3 (x, y)");
  says(head + "shape = \"plane\"\n" + snow + "shape = \"area\"\npoints = [[1, 1], [2, 9], [3, 3]]\n",
       "a.toml:12:10: release.points: reaches 9 along y, expected it inside the domain, whose domain.upper stands at "
       "a.toml:4:9");
}

TEST_CASE("An elevation model lies under the whole domain, and has heights where snow is", "[ground]") {
  const TemporaryFolder folder;
  const fs::path scene = folder.path() / "a.toml", model = folder.path() / "dem.asc";
  write(scene, avalanche("shape = \"grid\"\nfile = \"dem.asc\"\n"));
  const std::string place = scene.string() + ":10:8: terrain.file: ";
  write(model, esri_grid_text(hill(-2, -2)));
  CHECK(refusal_of(scene) == "");
  write(model, esri_grid_text(hill(1, -2)));
  CHECK(refusal_of(scene) == scene.string() +
                                 ":6:9: domain.lower: reaches 0 along x, expected it over the grid of "
                                 "terrain.file at " +
                                 scene.string() + ":10:8, which has heights from 0.5 to 17.5");
  ElevationGrid holed = hill(-2, -2);
  holed.at(0, 0) = holed.at(10, 5) = std::nan("");
  write(model, esri_grid_text(holed));
  CHECK(refusal_of(scene) == "");
  holed.at(6, 5) = holed.at(7, 5) = std::nan("");
  write(model, esri_grid_text(holed));
  const std::string release = scene.string() + ":17:10: release.points: ";
  CHECK(refusal_of(scene) == release + "lies over a hole of the elevation model at (4, 3)");
  for (double& z : holed.z) z = std::nan("");
  write(model, esri_grid_text(holed));
  CHECK(refusal_of(scene) == place + model.string() + ": has no heights, all are holes");
  write(model, esri_grid_text(hill(-2, -2)).substr(0, 300));
  CHECK_THAT(refusal_of(scene), Catch::StartsWith(place + model.string() + ": ends after "));
}

TEST_CASE("Snow that comes to a hole of the elevation model leaves, and is booked", "[ground]") {
  const TemporaryFolder folder;
  ElevationGrid holed = hill(-2, -2);
  for (int row = 0; row < holed.rows; ++row)
    for (int column = 8; column < holed.columns; ++column) holed.at(column, row) = std::nan("");
  write(folder.path() / "dem.asc", esri_grid_text(holed));
  write(folder.path() / "a.toml", avalanche("shape = \"grid\"\nfile = \"dem.asc\"\n"));
  const Scene scene = read_scene(folder.path() / "a.toml", {"release.velocity=[30, 0, -20]"});
  const Scenery scenery(scene, preview_view(scene));
  const Landscape picture = scenery.landscape(picture_frame(0, nullptr, nullptr, {}));
  for_each_index<2>(picture.ground.shape, [&](const Index<2>& i) {
    const Vec<2> x = picture.ground.place(i);
    const bool inside_domain = x[0] >= 0 && x[0] <= 12 && x[1] >= 0 && x[1] <= 8;
    if (inside_domain && x[0] < 5) CHECK(std::isfinite(picture.ground.height[flat<2>(i, picture.ground.shape)]));
    if (!inside_domain || x[0] > 6) CHECK(std::isnan(picture.ground.height[flat<2>(i, picture.ground.shape)]));
  });
  bool told = false;
  for (const std::string& line : scene_warnings(scene, {}))
    told = told || line == "warning: terrain: has no heights under 54 % of the domain: snow that comes there leaves";
  CHECK(told);
  Simulation<3> simulation(scene);
  while (simulation.time() < 0.1) simulation.step();
  CHECK(simulation.masses().n_outflow > 0);
  CHECK(std::abs(simulation.mass_error()) < 1e-12);
  for (const Vec<3>& x : simulation.dense()->particles.position) CHECK(x[0] < 5.5);
}

TEST_CASE("An area of obstacle raises the ground by its height, and keeps its volume where it is narrow", "[ground]") {
  const auto ground_with = [](const std::string& points) {
    const std::string text = avalanche("shape = \"plane\"\nstart = [0, 16]\nangle = \"20 deg\"\ncell_size = 0.5\n");
    const Scene scene = parse_scene(
        text + (points.empty() ? "" : "[obstacle]\nshape = \"area\"\nheight = 3\npoints = " + points + "\n"), "a.toml");
    return make_terrain<3>(scene);
  };
  const Terrain<3> bare = ground_with(""), wall = ground_with("[[8, 1], [10, 1], [10, 7], [8, 7]]");
  const auto raised = [&](const Terrain<3>& ground, double x, double y) {
    return ground.height({x, y, 0}) - bare.height({x, y, 0});
  };
  CHECK(raised(wall, 9, 4) == Approx(3));
  CHECK(raised(wall, 6.9, 4) == Approx(0).margin(1e-12));
  CHECK(raised(wall, 11.1, 4) == Approx(0).margin(1e-12));
  const Terrain<3> narrow = ground_with("[[8, 1], [8.2, 1], [8.2, 7], [8, 7]]");
  double volume = 0;
  for (double x = 5.05; x < 12; x += 0.1)
    for (double y = 0.05; y < 8; y += 0.1) volume += 0.01 * raised(narrow, x, y);
  CHECK(volume == Approx(0.2 * 6 * 3).epsilon(0.3));
  CHECK(raised(narrow, 8, 4) < 3);
}

TEST_CASE("Ground outside the domain's height is told by its share of the area", "[ground]") {
  const Scene scene = parse_scene(avalanche("shape = \"plane\"\nstart = [0, 4]\nangle = \"45 deg\"\n"), "a.toml");
  bool told = false;
  for (const std::string& line : scene_warnings(scene, {}))
    told = told || line == "warning: terrain: lies below the domain over 66 % of its area: snow leaves there";
  CHECK(told);
}
