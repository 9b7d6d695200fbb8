#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "terrain/height_shapes.hpp"

using namespace spindrift;

namespace {

constexpr double degree = std::numbers::pi / 180;
const Vec<3> start(10, 20, 100);

/// Slope of z along x.
double slope_x(const HeightFunction& z, double x, double y) {
  return (z(x + 1e-6, y) - z(x - 1e-6, y)) / 2e-6;
}

}  // namespace

TEST_CASE("A plane falls along x and y", "[terrain]") {
  const HeightFunction z = tilted_plane(start, std::atan(0.5), std::atan(0.25));
  CHECK(z(10, 20) == 100);
  CHECK(z(14, 20) == Approx(98));
  CHECK(z(10, 24) == Approx(99));
  CHECK(z(6, 16) == Approx(103));
}

TEST_CASE("A parabola begins with its angle and ends level", "[terrain]") {
  const HeightFunction z = parabola(start, 45 * degree, 30);
  CHECK(z(10, 0) == Approx(100));
  CHECK(slope_x(z, 10, 0) == Approx(-1));
  CHECK(z(40, 7) == Approx(70 + 30.0 / 4));  // half-way: a quarter of the drop is left
  CHECK(z(70, 0) == Approx(70));
  CHECK(z(500, 0) == Approx(70));
  CHECK(z(0, 0) == Approx(110));
}

TEST_CASE("A bowl is the same from all sides", "[terrain]") {
  const HeightFunction z = bowl(start, 45 * degree, 30);
  CHECK(z(10, 20) == Approx(100));
  CHECK(z(70, 20) == Approx(70));
  for (double phi = 0; phi < 6; phi += 0.5) {
    CHECK(z(70 + 60 * std::cos(phi), 20 + 60 * std::sin(phi)) == Approx(100));
    CHECK(z(70 + 80 * std::cos(phi), 20 + 80 * std::sin(phi)) == Approx(120));
  }
}

TEST_CASE("A helix falls along its channel and is closed and continuous", "[terrain]") {
  const Helix shape{start, 30 * degree, 60, 40, 5, 16};
  const HeightFunction z = helix(shape);
  CHECK(z(10, 20) == Approx(100));
  const double end = 60 / (40 * std::tan(30 * degree));
  const auto at = [&](double phi, double r) { return z(10 + r * std::sin(phi), 60 - r * std::cos(phi)); };
  for (double phi = 0; phi <= end; phi += 0.1) {
    CHECK(at(phi, 40) == Approx(100 - 40 * phi * std::tan(30 * degree)));
    CHECK(at(phi, 48) == Approx(at(phi, 40) + 5 * (1 - std::exp(-2.0))));
    CHECK(at(phi, 32) == Approx(at(phi, 48)));
  }
  CHECK(at(end, 40) == Approx(40));
  double jump = 0;
  for (double r = 0; r < 80; r += 2)
    for (double phi = 0; phi < 7; phi += 0.01) jump = std::max(jump, std::abs(at(phi + 0.01, r) - at(phi, r)));
  CHECK(jump < 0.01 * 3 * 60);
  CHECK_THROWS_AS(helix({start, 30 * degree, 120, 40, 5, 16}), Error);
}

TEST_CASE("A ridge stands on its slope, across or along it", "[terrain]") {
  SlopeProfile slope;
  slope.start = {10, 100};
  slope.angle = 30 * degree;
  const auto bare = [&](double x) { return 100 - std::tan(30 * degree) * (x - 10); };
  const HeightFunction across = ridge(slope, start, 300, 6, 4, 25);
  CHECK(across(35, -50) == Approx(bare(35) + 6));
  CHECK(across(39, 0) == Approx(bare(39) + 6 * std::exp(-0.5)));
  CHECK(across(10, 0) == Approx(100).margin(1e-6));
  const HeightFunction along = ridge(slope, start, 300, 6, 4, std::numeric_limits<double>::quiet_NaN());
  CHECK(along(40, 20) == Approx(bare(40) + 6));
  CHECK(along(40, 28) == Approx(bare(40) + 6 * std::exp(-2.0)));
}

TEST_CASE("A band of cliffs is as high and as steep as it says", "[terrain]") {
  SlopeProfile slope;
  slope.start = {10, 100};
  slope.angle = 30 * degree;
  slope.drop = 80;
  slope.cliff_at = 20;
  slope.cliff_height = 15;
  const HeightFunction z = cliff_band(slope, 400, 75 * degree);
  const double begin = 10 + 20 / std::tan(30 * degree);
  CHECK(z(begin, 3) == Approx(80));
  CHECK(z(begin + 20, 3) == Approx(80 - 15 - 20 * std::tan(30 * degree)));
  CHECK(z(390, 0) == Approx(20));
  double steepest = 0;
  for (double x = begin; x < begin + 20; x += 0.01) steepest = std::min(steepest, slope_x(z, x, 0));
  CHECK(std::atan(-steepest) == Approx(75 * degree).epsilon(1e-3));
  CHECK_THROWS_AS(cliff_band(slope, 400, 20 * degree), Error);
}

TEST_CASE("A valley has a level floor and walls that rise towards their angle", "[terrain]") {
  const HeightFunction z = valley(start, 0, 20, 45 * degree, 5);
  for (const double y : {10.0, 17.0, 30.0}) CHECK(z(77, y) == Approx(100));
  CHECK(z(0, 35) == Approx(z(0, 5)));
  CHECK(z(0, 42) == Approx(100 + 13 - 5));  // 12 off the floor: sqrt(12^2 + 5^2) - 5
  CHECK((z(0, 5000.5) - z(0, 4999.5)) == Approx(1).epsilon(1e-4));
  CHECK(valley(start, std::atan(0.1), 20, 1, 5)(20, 20) == Approx(99));
}

TEST_CASE("Sampling covers the extent and its rim, at multiples of the cell", "[terrain]") {
  const HeightGrid grid = sampled([](double x, double y) { return x + 100 * y; }, {{0.3, -1}, {2.2, 1}}, 0.5, 0.5);
  CHECK(grid.first == Vec<2>(-0.5, -1.5));
  CHECK(grid.points == Index<2>{8, 7});
  CHECK(grid.z[0] == Approx(-150.5));
  CHECK(grid.z[9] == Approx(-100));
  CHECK_THROWS_AS(sampled([](double, double) { return 0; }, {{0, 0}, {1e5, 1e5}}, 1, 1), Error);
  CHECK_THROWS_AS(sampled([](double, double) { return 0; }, {{0, 0}, {1e300, 1}}, 1, 1), Error);
}
