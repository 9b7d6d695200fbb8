#include <catch2/catch.hpp>
#include <numbers>

#include "core/parallel.hpp"
#include "io/depth_band.hpp"
#include "io/landscape.hpp"
#include "io/sun_map.hpp"

using namespace spindrift;

namespace {

constexpr double degrees = std::numbers::pi / 180;

/// Level ground under snow, 40 m x 40 m about the origin.
Landscape plain() {
  Landscape landscape;
  landscape.ground.shape = {41, 41};
  landscape.ground.origin = {-20, -20};
  landscape.ground.height.assign(41 * 41, 0.0f);
  landscape.ground.snow.assign(41 * 41, 0.5f);
  landscape.ground.shown = {{-18, -18}, {18, 18}};
  return landscape;
}

/// From the south, 30 m away, 20 degrees up; x goes right.
const Camera camera = camera_at({0, 0, 0}, 30, {180 * degrees, 20 * degrees}, Compass(), 320, 180);
const Light light{Vec<3>(-0.5, -0.3, 0.6).normalized(), Vec<3>::UnitZ()};

struct Pixels {
  std::vector<std::uint32_t> all;
  explicit Pixels(const Landscape& landscape) : all(draw_landscape(landscape, camera, light)) {}
  std::array<int, 3> at(int x, int y) const {
    const std::uint32_t p = all[static_cast<std::size_t>(y * camera.width + x)];
    return {static_cast<int>(p >> 16 & 0xff), static_cast<int>(p >> 8 & 0xff), static_cast<int>(p & 0xff)};
  }
  int brightness(int x, int y) const { return at(x, y)[0] + at(x, y)[1] + at(x, y)[2]; }
  int brightness(const Vec<3>& place) const {
    const Camera::Seen seen = camera.project(place);
    return brightness(static_cast<int>(seen.x), static_cast<int>(seen.y));
  }
};

/// A ball of smoke, 20^3 cells of a metre about `centre`.
struct Ball {
  std::vector<float> density;
  SmokeLattice lattice;
  Ball(const Vec<3>& centre, double radius, float value) : density(8000, 0.0f) {
    const Index<3> shape{20, 20, 20};
    lattice = {density, shape, centre - Vec<3>::Constant(9.5), 1, {}};
    for_each_index<3>(shape, [&](const Index<3>& i) {
      if ((Vec<3>(i[0], i[1], i[2]) - Vec<3>::Constant(9.5)).norm() < radius) density[flat<3>(i, shape)] = value;
    });
  }
};

}  // namespace

TEST_CASE("the nearer triangle or ball is seen, in whatever order they are drawn", "[landscape]") {
  const auto draw = [](bool near_first) {
    DepthBand band;
    band.clear(8, 0, 8);
    const auto near = [&] { band.triangle({0, 0, 0.5f}, {16, 0, 0.5f}, {0, 16, 0.5f}, 1); };
    const auto far = [&] { band.triangle({0, 0, 0.25f}, {0, 16, 0.25f}, {16, 0, 0.25f}, 2); };
    const auto ball = [&] { band.ball({4, 4, 2, 0.45f, 0.1f}, 3); };
    if (near_first) near(), ball(), far();
    if (!near_first) far(), ball(), near();
    return band;
  };
  for (const bool near_first : {true, false}) {
    const DepthBand band = draw(near_first);
    CHECK(band.what(0, 0) == 1);
    CHECK(band.nearness(0, 0) == 0.5f);
    CHECK(band.what(4, 4) == 3);  // the ball's middle stands out of the nearer triangle
    CHECK(band.nearness(4, 4) > 0.5f);
    CHECK(band.what(5, 2) == 1);  // its rim does not
  }
}

TEST_CASE("a slanting triangle is as near as its corners say, and touches the samples inside alone", "[landscape]") {
  DepthBand band;
  band.clear(10, 5, 4);
  band.triangle({2, 0, 1}, {6, 0, 2}, {2, 20, 1}, 7);
  CHECK(band.what(1, 6) == DepthBand::nothing);
  CHECK(band.nearness(1, 6) == 0);
  CHECK(band.what(2, 6) == 7);
  CHECK(band.nearness(2, 6) == Approx(1 + 0.5 / 4));
  CHECK(band.nearness(3, 8) == Approx(1 + 1.5 / 4));
  CHECK(band.what(6, 6) == DepthBand::nothing);
  // Behind the eye, without area, or nowhere: nothing.
  DepthBand none;
  none.clear(4, 0, 4);
  const float nan = std::numeric_limits<float>::quiet_NaN();
  none.triangle({0, 0, 1}, {9, 0, -1}, {0, 9, 1}, 1);
  none.triangle({0, 0, 1}, {3, 3, 1}, {1, 1, 1}, 1);
  none.triangle({0, 0, 1}, {nan, 0, 1}, {0, 9, 1}, 1);
  none.ball({2, nan, 1, 1, 0}, 1);
  none.ball({2, 2, 1, 0, 0}, 1);
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 4; ++x) CHECK(none.what(x, y) == DepthBand::nothing);
}

TEST_CASE("neighbouring triangles leave no gap", "[landscape]") {
  DepthBand band;
  band.clear(64, 0, 64);
  // A fan about a point between the samples.
  const ScreenPoint middle{31.37f, 32.81f, 1};
  for (int k = 0; k < 23; ++k) {
    const auto corner = [](int n) {
      const float angle = static_cast<float>(n) * 2 * std::numbers::pi_v<float> / 23;
      return ScreenPoint{31.37f + 90 * std::cos(angle), 32.81f + 90 * std::sin(angle), 1};
    };
    band.triangle(middle, corner(k), corner(k + 1), 1);
  }
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) CHECK(band.what(x, y) == 1);
}

TEST_CASE("ground hides what is behind it and shows what is before it", "[landscape]") {
  Landscape landscape = plain();
  const Pixels empty(landscape);
  // A wall across the plain at y = 5, 8 m high.
  for (int j = 25; j < 27; ++j)
    for (int i = 0; i < 41; ++i) landscape.ground.height[static_cast<std::size_t>(j * 41 + i)] = 8;
  const Pixels wall(landscape);
  landscape.snow = {{0, 10, 1}};  // behind it
  landscape.snow_radius = 1;
  CHECK(Pixels(landscape).all == wall.all);
  landscape.snow = {{0, 0, 1}};  // before it
  CHECK(Pixels(landscape).all != wall.all);
  CHECK(wall.all != empty.all);
}

TEST_CASE("bare ground is dark, snow is white, and both end in the sky", "[landscape]") {
  Landscape landscape = plain();
  const Pixels snow(landscape);
  landscape.ground.snow.clear();
  const Pixels bare(landscape);
  CHECK(snow.brightness(160, 95) > bare.brightness(160, 95) + 200);
  CHECK(snow.at(160, 1) == bare.at(160, 1));
  CHECK(snow.at(160, 1)[2] > snow.at(160, 1)[0] + 40);
  landscape.ground = {};
  const Pixels sky(landscape);
  CHECK(sky.at(160, 1) == snow.at(160, 1));
  CHECK(sky.brightness(160, 175) > sky.brightness(160, 5));
}

TEST_CASE("boxes and particles keep the sun from the ground behind them", "[landscape]") {
  Landscape landscape = plain();
  const ReliefSurface surface(landscape.ground);
  const bool box = GENERATE(true, false);
  if (box) landscape.boxes = {{{-1, -1, 0}, {1, 1, 4}}};
  if (!box) {
    landscape.snow = {{0, 0, 2}};
    landscape.snow_radius = 1.5;
  }
  const SunMap map(landscape, &surface, light);
  const Vec<3> shadow = Vec<3>(0, 0, 2) - 2 / light.sun[2] * light.sun;  // on the ground, right and behind
  CHECK(map.lit(shadow, Vec<3>::UnitZ()) < 0.01f);
  CHECK(map.lit({-shadow[0], -shadow[1], 0}, Vec<3>::UnitZ()) == Approx(1));
  CHECK(map.lit({12, 12, 0}, Vec<3>::UnitZ()) == Approx(1));
  const Pixels with(landscape), without(plain());
  CHECK(with.brightness(shadow) < without.brightness(shadow) - 60);
  CHECK(with.brightness(Vec<3>(-8, 0, 0)) == without.brightness(Vec<3>(-8, 0, 0)));
}

TEST_CASE("no smoke changes nothing, smoke shows and throws a soft shadow", "[landscape]") {
  Landscape landscape = plain();
  landscape.ground.snow.clear();
  landscape.snow = {{3, 2, 0.5}, {-4, 1, 0.2}};
  landscape.snow_radius = 0.4;
  const Pixels without(landscape);
  const Ball none({0, 0, 4}, 0, 1), some({-3, 0, 4}, 2.5, 1.5f);
  landscape.smoke = none.lattice;
  CHECK(Pixels(landscape).all == without.all);
  landscape.smoke = some.lattice;
  const Pixels with(landscape);
  CHECK(with.brightness(Vec<3>(-3, 0, 4)) > without.brightness(Vec<3>(-3, 0, 4)) + 200);
  const Vec<3> shadow = Vec<3>(-3, 0, 4) - 4 / light.sun[2] * light.sun;
  CHECK(with.brightness(shadow) < without.brightness(shadow) - 60);
  CHECK(with.at(4, 175) == without.at(4, 175));
  // Smoke behind a particle does not hide it, smoke before it does.
  const Camera::Seen seen = camera.project({-3, 0, 4});
  const Vec<3> ray = camera.ray(seen.x, seen.y);
  landscape.snow = {camera.eye + (seen.depth - 5) * ray};
  const Pixels before(landscape);
  landscape.snow = {camera.eye + (seen.depth + 5) * ray};
  const Pixels behind(landscape);
  landscape.snow.clear();
  const Pixels alone(landscape);
  const auto differs = [&](const Pixels& a) {
    int most = 0;
    for (int y = -4; y <= 4; ++y)
      for (int x = -4; x <= 4; ++x) {
        const int px = static_cast<int>(seen.x) + x, py = static_cast<int>(seen.y) + y;
        most = std::max(most, std::abs(a.brightness(px, py) - alone.brightness(px, py)));
      }
    return most;
  };
  CHECK(differs(before) > 20);
  CHECK(differs(behind) < 6);
}

TEST_CASE("a picture is the same with any number of threads", "[landscape][threads]") {
  Landscape landscape = plain();
  for (std::size_t n = 0; n < landscape.ground.height.size(); ++n)
    landscape.ground.height[n] =
        2 * std::sin(0.1f * static_cast<float>(n % 41)) * std::cos(0.01f * static_cast<float>(n));
  for (int n = 0; n < 3000; ++n) {
    landscape.snow.push_back({6 * std::sin(0.7 * n), 5 * std::cos(1.1 * n), 2 + std::sin(0.3 * n)});
    landscape.snow_kind.push_back(n % 2);
  }
  landscape.snow_radius = 0.3;
  landscape.boxes = {{{3, 3, 0}, {5, 6, 5}}};
  const Ball smoke({0, 0, 5}, 6, 0.3f);
  landscape.smoke = smoke.lattice;
  const auto with = [&](int n) {
    const ThreadLimit limit(n);
    return Pixels(landscape).all;
  };
  const auto one = with(1);
  CHECK(with(2) == one);
  CHECK(with(7) == one);
  CHECK(with(7) == one);
}

TEST_CASE("what is no place is left out", "[landscape]") {
  Landscape landscape = plain();
  const Pixels before(landscape);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  landscape.snow = {{nan, 0, 0}, {0, 0, std::numeric_limits<double>::infinity()}, camera.eye, {0, -1e6, 0}};
  landscape.snow_radius = 0.1;
  CHECK(Pixels(landscape).all == before.all);
  // A hole in the ground shows the sky.
  landscape.ground.height[20 * 41 + 20] = std::numeric_limits<float>::quiet_NaN();
  const Pixels hole(landscape);
  const Camera::Seen seen = camera.project({0, 0, 0});
  const int x = static_cast<int>(seen.x), y = static_cast<int>(seen.y);
  CHECK(hole.brightness(x, y) < before.brightness(x, y) - 150);
  CHECK(hole.at(20, 150) == before.at(20, 150));
}
