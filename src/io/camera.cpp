#include "io/camera.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"

namespace spindrift {
namespace {

constexpr double focal_in_sides = 1.5;  // focal length over the picture's longer side: 37 degrees

Camera camera_towards(const Outlook& outlook, const Compass& compass, int width, int height) {
  SPINDRIFT_CHECK(width > 0 && height > 0 && std::isfinite(outlook.azimuth) && std::isfinite(outlook.elevation));
  Camera camera;
  camera.width = width;
  camera.height = height;
  camera.focal = focal_in_sides * std::max(width, height);
  camera.forward = -compass.direction(outlook.azimuth, outlook.elevation);
  // Level, also where the camera looks straight down.
  camera.right = compass.direction(outlook.azimuth - std::numbers::pi / 2, 0);
  camera.up = camera.right.cross(camera.forward);
  return camera;
}

}  // namespace

Compass::Compass(const Vec<3>& gravity) {
  if (!(gravity.norm() > 0)) return;
  up = -gravity.normalized();
  const Vec<3> level = Vec<3>::UnitX() - up[0] * up;
  // Where gravity acts along x, y is as good an east.
  east = level.norm() > 1e-6 ? level.normalized() : (Vec<3>::UnitY() - up[1] * up).normalized();
  north = up.cross(east);
}

Vec<3> Compass::direction(double azimuth, double elevation) const {
  return std::cos(elevation) * (std::sin(azimuth) * east + std::cos(azimuth) * north) + std::sin(elevation) * up;
}

double Compass::azimuth_of(const Vec<3>& v) const {
  const double angle = std::atan2(v.dot(east), v.dot(north));
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

Camera::Seen Camera::project(const Vec<3>& position) const {
  const Vec<3> d = position - eye;
  const double depth = d.dot(forward);
  return {0.5 * width + focal * d.dot(right) / depth, 0.5 * height - focal * d.dot(up) / depth, depth};
}

Vec<3> Camera::ray(double x, double y) const {
  return forward + ((x - 0.5 * width) / focal) * right + ((0.5 * height - y) / focal) * up;
}

Camera camera_at(const Vec<3>& target, double distance, const Outlook& outlook, const Compass& compass, int width,
                 int height) {
  Camera camera = camera_towards(outlook, compass, width, height);
  camera.eye = target - distance * camera.forward;
  return camera;
}

Camera camera_around(std::span<const Vec<3>> points, double margin, const Outlook& outlook, const Compass& compass,
                     int width, int height) {
  SPINDRIFT_CHECK(!points.empty() && margin >= 0 && margin < 0.5);
  Camera camera = camera_towards(outlook, compass, width, height);
  const Vec<2> slope = (0.5 - margin) / camera.focal * Vec<2>(width, height);  // of the picture's sides
  const auto sideways = [&](const Vec<3>& x) { return Vec<2>(x.dot(camera.right), x.dot(camera.up)); };
  // A point is inside the sides where  |sideways(x) - e| <= slope (forward . x - f)  of an eye at (e, f): of both signs
  // one point is the outermost, whatever e and f are.
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Vec<2> most = Vec<2>::Constant(-infinity), least = Vec<2>::Constant(infinity);
  for (const Vec<3>& x : points) {
    most = most.cwiseMax(sideways(x) - slope * x.dot(camera.forward));
    least = least.cwiseMin(sideways(x) + slope * x.dot(camera.forward));
  }
  const double f = (least - most).cwiseQuotient(2 * slope).minCoeff();
  const Vec<2> e = (least + most) / 2;
  camera.eye = e[0] * camera.right + e[1] * camera.up + f * camera.forward;
  return camera;
}

}  // namespace spindrift
