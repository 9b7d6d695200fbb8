#include "simulation/local_origin.hpp"

#include <algorithm>
#include <cmath>

#include "io/lattice_points.hpp"

namespace spindrift {
namespace {

constexpr double step = 1e3;  // [m]

}  // namespace

Scene around_local_origin(Scene scene) {
  if (scene.scene.dim != 3) return scene;
  std::array<double, 2> origin{};
  for (std::size_t k = 0; k < 2; ++k) {
    if (std::max(std::abs(scene.domain.lower[k]), std::abs(scene.domain.upper[k])) > far_from_zero)
      origin[k] = step * std::floor(scene.domain.lower[k] / step);
    scene.origin[k] += origin[k];
  }
  if (origin[0] == 0 && origin[1] == 0) return scene;

  const auto move = [&](std::vector<double>& place) {
    for (std::size_t k = 0; k < std::min<std::size_t>(place.size(), 2); ++k) place[k] -= origin[k];
  };
  const auto move_points = [&](std::vector<std::array<double, 2>>& points, bool from_above) {
    for (auto& point : points) {
      point[0] -= origin[0];
      if (from_above) point[1] -= origin[1];
    }
  };
  move(scene.domain.lower), move(scene.domain.upper);
  if (scene.terrain) {
    scene.terrain->start[0] -= origin[0];
    move_points(scene.terrain->points, false);
  }
  for (ObstacleSection& obstacle : scene.obstacle) {
    move(obstacle.lower), move(obstacle.upper);
    move_points(obstacle.points, true);
  }
  if (scene.cover)
    for (auto& area : scene.cover->areas) move_points(area, true);
  for (ReleaseSection& release : scene.release) {
    move(release.lower), move(release.upper), move(release.center);
    move_points(release.points, release.shape == "area");
  }
  for (SmokeSection& smoke : scene.smoke) {
    move(smoke.lower), move(smoke.upper), move(smoke.center);
    move_points(smoke.points, false);
  }
  if (scene.path) move_points(scene.path->points, true);
  for (PylonSection& pylon : scene.pylon) move(pylon.position);
  return scene;
}

}  // namespace spindrift
