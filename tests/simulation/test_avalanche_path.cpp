// The way along a line on the ground, and the front that is measured along it.

#include <catch2/catch.hpp>
#include <cmath>

#include "scene_support.hpp"
#include "simulation/avalanche_path.hpp"
#include "simulation/instruments.hpp"
#include "simulation/local_origin.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

namespace {

/// 41 x 41 points, 5 m apart, from (0, 0) on; a height of each.
template <class F>
HeightField ground_of(F&& height) {
  HeightGrid grid{Vec<2>::Zero(), 5, {41, 41}, {}};
  for (int j = 0; j < 41; ++j)
    for (int i = 0; i < 41; ++i) grid.z.push_back(height(5.0 * i, 5.0 * j));
  return HeightField(grid);
}

const Box<2> domain{Vec<2>(0, 0), Vec<2>(200, 200)};

const std::string slope =
    "schema_version = 1\n[scene]\ndim = 3\n[domain]\nlower = [0, 0, 0]\nupper = [60, 40, 60]\n"
    "[terrain]\nshape = \"plane\"\nstart = [0, 50]\nangle = \"35 deg\"\n";

}  // namespace

TEST_CASE("On level ground the way is that of the nearest point of the line", "[path]") {
  // From (50, 50) 60 m along x, then 80 m along y.
  const AvalanchePath path({{50, 50}, {110, 50}, {110, 130}}, ground_of([](double, double) { return 7.0; }), domain);
  CHECK(path.length() == Approx(140));
  CHECK(path.along({50, 50}) == Approx(0).margin(1e-12));
  CHECK(path.along({80, 50}) == Approx(30));
  CHECK(path.along({80, 90}) == Approx(100));  // 30 m from the second piece, 40 m from the first
  CHECK(path.along({80, 60}) == Approx(30));   // 10 m from the first
  CHECK(path.along({130, 30}) == Approx(60));  // outside the bend: its corner
  CHECK(path.along({200, 100}) == Approx(110));
}

TEST_CASE("The line goes on straight beyond its ends, to the edge of the domain", "[path]") {
  const AvalanchePath path({{50, 50}, {110, 50}, {110, 130}}, ground_of([](double, double) { return 7.0; }), domain);
  CHECK(path.along({20, 45}) == Approx(-30));
  CHECK(path.along({105, 160}) == Approx(170));
  CHECK(path.along({110, 260}) == Approx(210));  // no farther than the domain
  CHECK(path.along({-40, 50}) == Approx(-50));
  // An end on the edge has nothing beyond it.
  const AvalanchePath across({{0, 20}, {200, 20}}, ground_of([](double, double) { return 0.0; }), domain);
  CHECK(across.length() == Approx(200));
  CHECK(across.along({-5, 30}) == Approx(0).margin(1e-12));
}

TEST_CASE("On a slope the way is longer than seen from above", "[path]") {
  const HeightField ground = ground_of([](double x, double) { return 300 - 0.75 * x; });
  const AvalanchePath down({{40, 100}, {160, 100}}, ground, domain);
  CHECK(down.length() == Approx(120 * 1.25));
  CHECK(down.along({100, 117}) == Approx(60 * 1.25));
  const AvalanchePath level({{40, 40}, {40, 160}}, ground, domain);
  CHECK(level.length() == Approx(120));
  // 30 degrees off the fall line.
  const double c = std::cos(M_PI / 6), s = std::sin(M_PI / 6);
  const AvalanchePath askew({{40, 40}, {40 + 100 * c, 40 + 100 * s}}, ground, domain);
  CHECK(askew.length() == Approx(std::hypot(100, 75 * c)));
}

TEST_CASE("Waves of the ground are followed, to second order in its cells", "[path]") {
  // Of z = a sin(k x): the arc length of one wave by the trapezoidal rule, which is exact for periodic functions.
  const double a = 4, k = 2 * M_PI / 40;
  double exact = 0;
  for (int i = 0; i < 64; ++i) exact += 40.0 / 64 * std::hypot(1, a * k * std::cos(2 * M_PI * i / 64));
  const auto error = [&](double cell) {
    HeightGrid grid{Vec<2>::Zero(), cell, {static_cast<int>(200 / cell) + 1, 2}, {}};
    for (int j = 0; j < 2; ++j)
      for (int i = 0; i < grid.points[0]; ++i) grid.z.push_back(a * std::sin(k * cell * i));
    return std::abs(AvalanchePath({{40, 0}, {160, 0}}, HeightField(grid), domain).length() - 3 * exact);
  };
  CHECK(error(5) / (3 * exact) < 1e-2);
  CHECK(error(2.5) < 0.3 * error(5));
}

TEST_CASE("The front runs along the scene's path, in the scene's coordinates", "[path]") {
  const std::string snow =
      "[dense_flow]\nsupport_radius = 2\n[[release]]\nshape = \"ball\"\ncenter = [20, 20, 37.5]\nradius = 1.5\n";
  const auto front_along = [&](const std::string& path) {
    Simulation<3> simulation(around_local_origin(parse_scene(slope + snow + path, "a.toml")));
    Instruments<3> instruments;
    instruments.follow(simulation);
    return instruments.front;
  };
  // The ball's 99th percentile lies some 1 m before its middle: straight down from x = 10, and across from y = 35.
  const double per_metre = 1 / std::cos(35 * M_PI / 180);
  CHECK(front_along("[path]\npoints = [[10, 20], [50, 20]]\n") == Approx(11.2 * per_metre).margin(0.4 * per_metre));
  CHECK(front_along("[path]\npoints = [[20, 35], [20, 5]]\n") == Approx(16.2).margin(0.4));
  CHECK(front_along("") < 2);
}

TEST_CASE("A path that cannot be is told", "[path]") {
  const auto told = [](const std::string& keys, const std::string& before = slope) {
    return refusal(before + "[path]\n" + keys);
  };
  CHECK(told("points = [[1, 1], [2, 2]]\n") == "");
  CHECK(told("") == "a.toml:11:2: path.points: missing, expected at least 2 points (x, y)");
  CHECK(told("points = [[1, 1]]\n") == "a.toml:12:10: path.points: got 1 point, expected at least 2 (x, y)");
  CHECK(told("points = [[1, 1], [1, 1], [2, 3]]\n") == "a.toml:12:10: path.points: got (1, 1) twice in a row");
  CHECK(told("points = [[1, 1], [70, 2]]\n") ==
        "a.toml:12:10: path.points: reaches 70 along x, expected it inside the domain, whose domain.upper stands at "
        "a.toml:6:9");
  CHECK_THAT(told("points = [[1, 1], [2, 2]]\n", "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [9, 9]\n"),
             Catch::StartsWith("a.toml:5:2: path: needs one of the 3D grounds"));
  CHECK(told("file = \"none.shp\"\n") == "a.toml:12:8: path.file: none.shp: there is no such file");
  CHECK_THAT(told("file = \"none.shp\"\npoints = [[1, 1], [2, 2]]\n"),
             Catch::Contains("path.file: contradicts path.points at a.toml:13:10: leave out one"));
}
