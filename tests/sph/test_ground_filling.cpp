// Snow on height fields: cover, and what is per area of ground.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/parallel.hpp"
#include "sph/sampling.hpp"
#include "sph/standing_columns.hpp"

using namespace spindrift;

namespace {

constexpr double d = 0.105;

Terrain<3> field(const std::function<double(double, double)>& z, double cell = 1) {
  HeightGrid grid{{-4 * cell, -4 * cell}, cell, {40, 40}, {}};
  for_each_index<2>(grid.points, [&](const Index<2>& i) {
    grid.z.push_back(z(grid.first[0] + cell * i[0], grid.first[1] + cell * i[1]));
  });
  return Terrain<3>(HeightField(grid));
}

/// A plane of the given slope that falls towards `direction` in plan.
Terrain<3> plane(double slope, double direction) {
  const double fall = std::tan(slope);
  return field([=](double x, double y) { return -fall * (std::cos(direction) * x + std::sin(direction) * y); });
}

CoverLayer layer(double depth, double to) {
  return {.from = 0, .to = to, .y = {0, 6}, .depth = depth};
}

Cover<3> sampled(const Terrain<3>& terrain, double depth, double to = 8) {
  return sample_cover<3>(terrain, layer(depth, to), {.spacing = d, .density = 100, .first_id = 1000});
}

constexpr double degree = M_PI / 180;

}  // namespace

TEST_CASE("Cover on a height field has its mass per area of ground, whatever the slope", "[sampling][height_field]") {
  const double slope = GENERATE(0.0, 30.0, 45.0, 60.0) * degree, direction = GENERATE(0.0, 45.0, 110.0) * degree;
  const double depth = GENERATE(0.525, 0.3);
  CAPTURE(slope / degree, direction / degree, depth);
  const Cover<3> cover = sampled(plane(slope, direction), depth);
  const double area = 8 * 6 / std::cos(slope);
  const double mass = 100 * std::pow(d, 3) * static_cast<double>(cover.particles.size());
  CHECK(mass / area == Approx(100 * depth).epsilon(0.01));

  const NearestNeighbours nearest = nearest_neighbours<3>(cover.particles.position);
  CHECK(nearest.mean == Approx(d).epsilon(0.05));
  CHECK(nearest.least >= 0.7 * d);
}

TEST_CASE("Cover on hills has the mass of its area and its depth, and lies inside its layer",
          "[sampling][height_field]") {
  const Terrain<3> terrain =
      field([](double x, double y) { return -0.6 * x + 0.8 * std::sin(0.5 * x) * std::cos(0.4 * y); });
  const double depth = 0.525;
  const Cover<3> cover = sampled(terrain, depth, 20);
  double area = 0;
  for (double x = 0.05; x < 20; x += 0.1)
    for (double y = 0.05; y < 6; y += 0.1) area += 0.01 * terrain.area_ratio({x, y});
  CHECK(std::pow(d, 3) * static_cast<double>(cover.particles.size()) == Approx(area * depth).epsilon(0.01));
  std::vector<double> share(5, 0);
  for (std::size_t i = 0; i < cover.particles.size(); ++i) {
    const Foot<3> foot = terrain.foot(cover.particles.position[i]);
    REQUIRE((foot.distance > 0 && foot.distance < depth));
    REQUIRE(foot.distance == Approx(cover.foot[i].distance).margin(1e-9));
    REQUIRE((foot.place - cover.foot[i].place).norm() < 1e-8);
    REQUIRE((foot.normal - cover.foot[i].normal).norm() < 1e-8);
    REQUIRE((foot.place[0] >= 0 && foot.place[0] <= 20 && foot.place[1] >= 0 && foot.place[1] <= 6));
    share[static_cast<std::size_t>(foot.distance / depth * 5)] += 5.0 / static_cast<double>(cover.particles.size());
  }
  for (std::size_t k = 1; k < 4; ++k) CHECK(share[k] == Approx(1.11).margin(0.06));  // pressed from both faces
  CHECK(share[0] == Approx(share[4]).margin(0.1));
  // The bins' surface is the cover's in the mean.
  double surface = 0, n = 0;
  for_each_index<2>(cover.shape, [&](Index<2> bin) {
    for (int k = 0; k < 2; ++k) bin[k] += cover.lower[k];
    if (cover.slots_in(bin).size() > 10) surface += cover.surface(bin), ++n;
  });
  CHECK(surface / n == Approx(depth).margin(0.15 * d));
}

TEST_CASE("A layer of few particles, or thinner than one, has its exact volume in the mean",
          "[sampling][height_field]") {
  const double spacing = GENERATE(0.5, 2.0), thickness = GENERATE(0.3, 0.1), slope = GENERATE(0.0, 36.0) * degree;
  const std::uint64_t seed = GENERATE(1, 7);
  CAPTURE(spacing, thickness, slope / degree, seed);
  const double size = 150 * spacing;
  const Terrain<3> terrain =
      field([=](double x, double y) { return -std::tan(slope) * (0.8 * x + 0.6 * y); }, spacing * 5);
  const GroundLayer layer{.extent = {{0, 0}, {size, size}}, .thickness = thickness, .spacing = spacing, .seed = seed};
  const auto places = fill_ground(*terrain.height_field(), layer, [](const Vec<2>&) { return true; });
  const double expected = size * size / std::cos(slope) * thickness / std::pow(spacing, 3);
  CHECK(static_cast<double>(places.size()) == Approx(expected).epsilon(0.01));
  for (const FilledPlace& place : places) REQUIRE((place.foot.distance > 0 && place.foot.distance < thickness));
}

TEST_CASE("Cover on a height field is the same again, with any number of threads, and piece by piece",
          "[sampling][height_field]") {
  const Terrain<3> terrain = plane(35 * degree, 0.3);
  const Cover<3> cover = sampled(terrain, 0.525);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const Cover<3> again = sampled(terrain, 0.525);
    CHECK(again.particles.position == cover.particles.position);
    CHECK(again.particles.id == cover.particles.id);
  }
  const auto before = [](const Vec<3>& a, const Vec<3>& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  };
  const Cover<3> shorter = sampled(terrain, 0.525, 4);
  std::vector<Vec<3>> all = cover.particles.position;
  std::sort(all.begin(), all.end(), before);
  REQUIRE(shorter.particles.size() > 10000);
  for (const Vec<3>& x : shorter.particles.position) REQUIRE(std::binary_search(all.begin(), all.end(), x, before));
}

TEST_CASE("Cover on a height field keeps off obstacles and steep ground, and absurd layers are empty",
          "[sampling][height_field]") {
  const Terrain<3> terrain = plane(35 * degree, 0);
  const std::vector<Box<3>> obstacles{{{2, 2, -10}, {3, 3, 10}}};
  const Cover<3> cover = sample_cover<3>(terrain, layer(0.525, 4), {.spacing = d}, obstacles);
  for (const Vec<3>& x : cover.particles.position) REQUIRE(surface_of<3>(obstacles[0], x).distance >= 0.5 * d);
  CHECK(cover.particles.size() > 0.85 * static_cast<double>(sampled(terrain, 0.525, 4).particles.size()));
  const Terrain<3> step = field([](double x, double) { return x < 2 ? 20 : 0; }, 0.5);
  for (const Foot<3>& foot : sampled(step, 0.3, 4).foot) REQUIRE(foot.normal[2] >= 0.1);
  CHECK(sampled(terrain, 0, 4).particles.empty());
  CHECK(sampled(terrain, -1, 4).particles.empty());
  CHECK(sampled(terrain, 0.5, 0).particles.empty());
}

TEST_CASE("Columns on a height field are per area of ground", "[columns][height_field]") {
  const double slope = GENERATE(0.0, 45.0, 60.0) * degree;
  const Terrain<3> terrain = plane(slope, 0.7);
  const double thickness = 0.8;
  GroundLayer all{.extent = {{0, 0}, {6, 6}}, .base = 0, .thickness = thickness, .spacing = d};
  const Particles<3> snow =
      sample_area(*terrain.height_field(), all, {.spacing = d, .density = 300}, [](const Vec<2>&) { return true; });
  StandingColumns<3> columns;
  build_columns<3>(columns, terrain, snow, nullptr, d, 2 * d);
  double mass = 0, mean_thickness = 0, n = 0;
  for (const Column<3>& c : columns.columns) {
    CHECK(c.area == Approx(4 * d * d / std::cos(slope)));
    mass += c.mass_per_area * c.area;
    if (c.bin[0] < 2 || c.bin[1] < 2 || c.bin[0] > 25 || c.bin[1] > 25) continue;
    mean_thickness += c.thickness, ++n;
  }
  CHECK(mass == Approx(300 * std::pow(d, 3) * static_cast<double>(snow.size())).epsilon(1e-6));
  CHECK(mean_thickness / n == Approx(thickness).epsilon(0.01));
}

TEST_CASE("A wedge of cover on a height field tilts the normals by its slope along the ground",
          "[cover][height_field]") {
  // Ground that falls by 45 degrees along x; the cover grows by 0.3 for each metre along it, or across.
  const Terrain<3> terrain = plane(45 * degree, 0);
  const bool across = GENERATE(false, true);
  Cover<3> cover;
  cover.spacing = d;
  cover.in_plan = true;
  for (double x = d; x < 6; x += 2 * d)
    for (double y = d; y < 6; y += 2 * d) {
      const double height = 0.3 * (across ? y : x * std::sqrt(2.0));
      cover.particles.id.push_back(cover.foot.size());
      cover.particles.position.push_back(terrain.position({x, y}, height));
      cover.particles.velocity.push_back(Vec<3>::Zero());
      cover.particles.mass.push_back(1), cover.particles.volume.push_back(1), cover.particles.pressure.push_back(0);
      cover.particles.entrained_at.push_back(-1);
      Foot<3> foot = terrain.foot(cover.particles.position.back());
      cover.foot.push_back(foot);
    }
  cover.hazard.assign(cover.foot.size(), 0);
  index_cover(cover);
  const Vec<3> normal(std::sqrt(0.5), 0, std::sqrt(0.5)), along(std::sqrt(0.5), 0, -std::sqrt(0.5));
  const Vec<3> expected = (normal - 0.3 * (across ? Vec<3>(0, 1, 0) : along)).normalized();
  int n = 0;
  for (std::size_t i = 0; i < cover.foot.size(); ++i) {
    const Vec<2>& at = cover.foot[i].place;
    if (at.minCoeff() < 10 * d || at.maxCoeff() > 6 - 10 * d) continue;
    CHECK((cover.surface_normal[i] - expected).norm() < 1e-9);
    CHECK(cover.ground_area(ground_bin<3>(at, 2 * d)) == Approx(4 * d * d * std::sqrt(2.0)));
    ++n;
  }
  CHECK(n > 20);
}
