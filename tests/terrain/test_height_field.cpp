#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include "core/error.hpp"
#include "terrain/terrain.hpp"

using namespace spindrift;

namespace {

using Surface = std::function<double(double, double)>;

/// Samples a surface over [0, nx - 1] x [0, ny - 1] cells from `first` on.
HeightGrid sampled(const Surface& z, const Vec<2>& first, double cell, const Index<2>& points) {
  HeightGrid grid{first, cell, points, {}};
  for_each_index<2>(points,
                    [&](const Index<2>& i) { grid.z.push_back(z(first[0] + cell * i[0], first[1] + cell * i[1])); });
  return grid;
}

/// Hills and gullies of several wavelengths, of slopes up to about 60 degrees.
double rough(double x, double y) {
  return 3 * std::sin(0.5 * x) * std::cos(0.4 * y) + 0.8 * std::sin(1.9 * x + 0.7) * std::sin(1.6 * y) - 0.6 * x;
}

/// The least distance to a fine lattice of the surface's places within 12 m, and how fine that is.
double by_brute_force(const HeightField& ground, const Vec<3>& x) {
  double least = std::numeric_limits<double>::infinity();
  for (double u = x[0] - 12; u <= x[0] + 12; u += 0.04)
    for (double v = x[1] - 12; v <= x[1] + 12; v += 0.04)
      least = std::min(least, (Vec<3>(u, v, ground.height({u, v})) - x).norm());
  return least;
}

}  // namespace

TEST_CASE("The cubic through four points, by hand", "[height_field]") {
  // Half-way between the middle two of 0, 0, 1, 0: z = 1/2 + (1/2 - 0)/8, z_x = 3/2 (1 - 0) - (1/2 + 0)/4.
  HeightGrid grid{{0, 0}, 1, {4, 4}, {}};
  for (int i = 0; i < 16; ++i) grid.z.push_back(i % 4 == 2);
  const HeightField ground(grid);
  CHECK(ground.height({1.5, 1.3}) == Approx(0.5625).epsilon(1e-14));
  const Vec<3> n = ground.normal({1.5, 1.3});
  CHECK(-n[0] / n[2] == Approx(1.375).epsilon(1e-14));
  CHECK(n[1] == Approx(0).margin(1e-15));
  for (int i = 0; i < 4; ++i) CHECK(ground.height({i, 2}) == Approx(grid.z[static_cast<std::size_t>(i)]).margin(1e-15));
}

TEST_CASE("The foot on a plane is the formula's", "[height_field]") {
  const double tan_x = GENERATE(0.0, -0.5, 1.0), tan_y = GENERATE(0.0, 0.7);
  const double cell = GENERATE(0.3, 5.0);
  const auto z = [&](double x, double y) { return 20 + tan_x * x + tan_y * y; };
  const HeightField ground(sampled(z, {-4 * cell, -4 * cell}, cell, {24, 20}));
  const Vec<3> n = Vec<3>(-tan_x, -tan_y, 1).normalized();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int i = 0; i < 500; ++i) {
    const Vec<2> place(cell * (1 + 12 * unit(random)), cell * (1 + 10 * unit(random)));
    const double distance = cell * (4 * unit(random) - 2);
    const Vec<3> x = Vec<3>(place[0], place[1], z(place[0], place[1])) + distance * n;
    const Foot<3> foot = ground.foot(x);
    CHECK(foot.distance == Approx(distance).margin(1e-11));
    CHECK((foot.normal - n).norm() < 1e-11);
    CHECK((foot.place - place).norm() < 1e-10);
    CHECK((ground.position(place, distance) - x).norm() < 1e-11);
  }
}

TEST_CASE("The foot of a position is its place, on rough ground", "[height_field]") {
  const HeightField ground(sampled(rough, {-20, -20}, 0.5, {81, 81}));
  std::mt19937 random(2);
  std::uniform_real_distribution<double> over(-15, 15), off(-0.15, 0.15);
  double worst_place = 0, worst_distance = 0, worst_normal = 0;
  for (int i = 0; i < 20000; ++i) {
    const Vec<2> place(over(random), over(random));
    const double distance = off(random);
    const Foot<3> foot = ground.foot(ground.position(place, distance));
    worst_place = std::max(worst_place, (foot.place - place).norm());
    worst_distance = std::max(worst_distance, std::abs(foot.distance - distance));
    worst_normal = std::max(worst_normal, (foot.normal - ground.normal(place)).norm());
  }
  CHECK(worst_place < 1e-10);
  CHECK(worst_distance < 1e-10);
  CHECK(worst_normal < 1e-10);
}

TEST_CASE("No place of the ground is nearer than the foot", "[height_field]") {
  const HeightField ground(sampled(rough, {-20, -20}, 0.5, {81, 81}));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> over(-10, 10), off(-6, 8);
  for (int i = 0; i < 150; ++i) {
    const Vec<2> place(over(random), over(random));
    const Vec<3> x(place[0], place[1], ground.height(place) + off(random));
    const Foot<3> foot = ground.foot(x);
    const double least = by_brute_force(ground, x);
    CAPTURE(x.transpose(), foot.distance, least);
    REQUIRE(std::abs(foot.distance) <= least + 1e-12);
    REQUIRE(std::abs(foot.distance) >= least - 0.06);
    REQUIRE((foot.distance >= 0) == (x[2] >= ground.height(place)));
    const Vec<3> surface(foot.place[0], foot.place[1], ground.height(foot.place));
    REQUIRE((surface - x).norm() == Approx(std::abs(foot.distance)).margin(1e-10));
    for (const double reach : {0.3, 1.0, 3.0}) {
      const Foot<3> near = ground.foot(x, reach);
      if (std::abs(foot.distance) < reach) {
        REQUIRE(near.distance == Approx(foot.distance).margin(1e-10));
      } else {
        REQUIRE(std::abs(near.distance) >= reach);
        REQUIRE(std::signbit(near.distance) == std::signbit(foot.distance));
      }
      if (ground.clears(x, reach)) REQUIRE(foot.distance >= reach);
    }
  }
}

TEST_CASE("A foot that is certain up to a distance is the nearest one below it, and stationary beyond",
          "[height_field]") {
  const HeightField ground(sampled(rough, {-20, -20}, 0.5, {81, 81}));
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  std::mt19937 random(5);
  std::uniform_real_distribution<double> over(-12, 12), off(-4, 10);
  int another = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vec<2> place(over(random), over(random));
    const Vec<3> x(place[0], place[1], ground.height(place) + off(random));
    const Foot<3> nearest = ground.foot(x);
    for (const double certain : {0.1, 1.0, 2.5}) {
      const Foot<3> foot = ground.foot(x, anywhere, certain);
      CAPTURE(x.transpose(), certain, nearest.distance, foot.distance);
      if (std::abs(nearest.distance) < certain - 1e-9) {
        REQUIRE(foot.distance == Approx(nearest.distance).margin(1e-10));
        REQUIRE((foot.place - nearest.place).norm() < 1e-6);
        continue;
      }
      REQUIRE(std::abs(foot.distance) >= std::abs(nearest.distance) - 1e-10);
      REQUIRE(std::signbit(foot.distance) == std::signbit(nearest.distance));
      REQUIRE((ground.position(foot.place, foot.distance) - x).norm() < 1e-8);
      another += std::abs(foot.distance) > std::abs(nearest.distance) + 1e-6;
    }
  }
  CHECK(another > 100);  // else the case shows nothing
}

TEST_CASE("Heights and normals converge: third and second order", "[height_field]") {
  const auto errors = [](double cell) {
    const int n = static_cast<int>(std::lround(10 / cell)) + 1;
    const HeightField ground(sampled(rough, {0, 0}, cell, {n, n}));
    std::array<double, 2> worst{};
    for (double u = 3; u < 7; u += 0.0371)
      for (double v = 3; v < 7; v += 0.0413) {
        worst[0] = std::max(worst[0], std::abs(ground.height({u, v}) - rough(u, v)));
        const double h = 1e-5;
        const Vec<3> exact =
            Vec<3>(-(rough(u + h, v) - rough(u - h, v)) / (2 * h), -(rough(u, v + h) - rough(u, v - h)) / (2 * h), 1)
                .normalized();
        worst[1] = std::max(worst[1], (ground.normal({u, v}) - exact).norm());
      }
    return worst;
  };
  const auto coarse = errors(0.2), fine = errors(0.1);
  CHECK(std::log2(coarse[0] / fine[0]) > 2.7);
  CHECK(std::log2(coarse[1] / fine[1]) > 1.8);
}

TEST_CASE("The distance to a bowl is that to its sphere", "[height_field]") {
  constexpr double radius = 30;
  const auto sphere = [](double x, double y) { return radius - std::sqrt(radius * radius - x * x - y * y); };
  const HeightField ground(sampled(sphere, {-18, -18}, 0.25, {145, 145}));
  std::mt19937 random(4);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (int i = 0; i < 500; ++i) {
    const Vec<3> out = Vec<3>(0.4 * unit(random), 0.4 * unit(random), -1).normalized();
    const double from_middle = radius - 6 * unit(random);
    const Foot<3> foot = ground.foot(Vec<3>(0, 0, radius) + from_middle * out);
    CHECK(foot.distance == Approx(radius - from_middle).margin(2e-5));
    CHECK((foot.normal + out).norm() < 1e-4);
  }
  // All of it is equally near, but for the cells at its edge, which bend level.
  CHECK(ground.foot({0, 0, radius}).distance == Approx(radius).margin(0.03));
}

TEST_CASE("Of two walls of a gully the nearer one counts", "[height_field]") {
  // A sharp V of 45 degrees; above its bottom, the vertical below is the farthest stationary place of three.
  const HeightField ground(sampled([](double x, double) { return std::abs(x - 10); }, {0, 0}, 0.25, {81, 41}));
  for (const double shift : {-0.3, 0.3}) {
    const Foot<3> foot = ground.foot({10 + shift, 5, 4});
    CHECK(foot.distance == Approx((4 - std::abs(shift)) / std::sqrt(2.0)).margin(1e-6));
    CHECK((foot.place[0] - 10) * shift > 0);
    CHECK(foot.place[1] == Approx(5).margin(1e-9));
  }
}

TEST_CASE("Beyond its edge the ground goes on level and smooth", "[height_field]") {
  const HeightField ground(sampled(rough, {0, 0}, 0.5, {21, 21}));
  for (const double y : {2.0, 3.3}) {
    CHECK(ground.height({50, y}) == Approx(ground.height({10.5, y})));
    CHECK(ground.normal({50, y})[0] == Approx(0).margin(1e-15));
    CHECK(ground.height({-50, y}) == Approx(ground.height({-0.5, y})));
  }
  CHECK(ground.height({10, 3}) == Approx(rough(10, 3)));
  CHECK(ground.height({50, 3}) == Approx(rough(10, 3)));
  for (double x = 9.8; x < 11; x += 0.01)
    CHECK((ground.normal({x + 1e-6, 3.3}) - ground.normal({x - 1e-6, 3.3})).norm() < 1e-4);
  const Foot<3> foot = ground.foot({80, 70, 2});
  CHECK(foot.distance == Approx(2 - rough(10, 10)));
  CHECK(foot.place == Vec<2>(80, 70));
}

TEST_CASE("Grids that make no ground are refused", "[height_field]") {
  const HeightGrid good{{0, 0}, 1, {2, 2}, {0, 0, 0, 0}};
  CHECK(HeightField(good).height({0.5, 0.5}) == 0);
  const auto refused = [&](auto&& change) {
    HeightGrid bad = good;
    change(bad);
    CHECK_THROWS_AS(HeightField(bad), Error);
  };
  refused([](HeightGrid& g) { g.points = {1, 4}; });
  refused([](HeightGrid& g) { g.points = {4, 4}; });
  refused([](HeightGrid& g) { g.cell = 0; });
  refused([](HeightGrid& g) { g.cell = -1; });
  refused([](HeightGrid& g) { g.cell = std::numeric_limits<double>::infinity(); });
  refused([](HeightGrid& g) { g.first[1] = std::numeric_limits<double>::quiet_NaN(); });
  refused([](HeightGrid& g) { g.z[3] = std::numeric_limits<double>::quiet_NaN(); });
}

TEST_CASE("Absurd positions get an answer", "[height_field]") {
  const HeightField ground(sampled(rough, {0, 0}, 0.5, {21, 21}));
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e300, -1e300);
  for (int k = 0; k < 3; ++k) {
    Vec<3> x(3, 3, 3);
    x[k] = bad;
    static_cast<void>(ground.foot(x));
    static_cast<void>(ground.foot(x, 1));
    static_cast<void>(ground.clears(x, 1));
  }
  SUCCEED();
}

TEST_CASE("A ground of either kind says how much of it lies over a place", "[height_field]") {
  const Terrain<3> profile({{0, 0}, {40, -30}});
  const Terrain<3> field(HeightField(sampled([](double x, double) { return -0.75 * x; }, {0, 0}, 1, {41, 11})));
  CHECK(profile.area_ratio({20, 5}) == 1);
  CHECK(field.area_ratio({20, 5}) == Approx(1.25));
  CHECK(profile.height({20, 5, 100}) == Approx(field.height({20, 5, 100})));
  const Vec<3> x(20, 5, -14);
  CHECK(profile.foot(x).distance == Approx(field.foot(x).distance));
  CHECK((profile.foot(x).normal - field.foot(x).normal).norm() < 1e-12);
  CHECK(field.profile() == nullptr);
  CHECK(profile.height_field() == nullptr);
  CHECK_FALSE(profile.clears({20, 5, 100}, 1));
  CHECK(field.clears({20, 5, 100}, 1));
}
