// Snow on height fields: cover, and what is per area of ground.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <functional>

#include "core/parallel.hpp"
#include "sph/columns.hpp"
#include "sph/sampling.hpp"

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
  WARN("mass ratio " << mass / area / (100 * depth) << " nearest " << nearest.mean / d << " " << nearest.least / d);
}
