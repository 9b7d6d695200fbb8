#include "simulation/raised_ground.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/outline.hpp"

namespace spindrift {
namespace {

/// Share of the square of edge `size` around `middle` that lies inside, by 8 x 8 samples.
double covered_share(const Outline& outline, const Vec<2>& middle, double size) {
  constexpr int samples = 8;
  int n = 0;
  for_each_index<2>({samples, samples}, [&](const Index<2>& i) {
    const Vec<2> place = middle + size * (Vec<2>(i[0] + 0.5, i[1] + 0.5) / samples - Vec<2>::Constant(0.5));
    n += inside(outline, place[0], place[1]);
  });
  return static_cast<double>(n) / (samples * samples);
}

}  // namespace

void raise_obstacles(HeightGrid& grid, const std::vector<ObstacleSection>& obstacles) {
  for (const ObstacleSection& obstacle : obstacles) {
    if (obstacle.shape != "area") continue;
    const Box<2> extent = extent_of(obstacle.points);
    Index<2> first, shape;
    for (int k = 0; k < 2; ++k) {
      const double end = grid.points[k] - 1.0;
      const auto point = [&](double place) { return std::clamp((place - grid.first[k]) / grid.cell, 0.0, end); };
      first[k] = static_cast<int>(std::floor(point(extent.lower[k] - grid.cell)));
      shape[k] = static_cast<int>(std::ceil(point(extent.upper[k] + grid.cell))) - first[k] + 1;
    }
    for_each_index<2>(shape, [&](const Index<2>& i) {
      const Index<2> at{first[0] + i[0], first[1] + i[1]};
      const Vec<2> middle = grid.first + grid.cell * Vec<2>(at[0], at[1]);
      grid.z[flat<2>(at, grid.points)] += obstacle.height * covered_share(obstacle.points, middle, grid.cell);
    });
  }
}

}  // namespace spindrift
