#include "simulation/scenery.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "simulation/cover_relief.hpp"
#include "simulation/setup.hpp"

namespace spindrift {
namespace {

constexpr double degrees = std::numbers::pi / 180;
constexpr double aside = 50 * degrees;  // of the camera from the valley's side
constexpr double camera_elevation = 24 * degrees;
constexpr double sun_aside = 65 * degrees;  // of the sun to the left of the camera
constexpr double sun_elevation = 38 * degrees;
constexpr double picture_rim = 0.04;  // kept free around the ground
constexpr double headroom = 0.10;     // over the ground that is seen too, of its extent; thrice if the domain has it

constexpr int points_along = 300;  // of the ground, along the domain's longer side
constexpr double beyond = 0.60;    // of the domain's longer side: ground that fades away around it

/// Radius of a ball of the volume of a cube of edge 1.
const double ball_of_cube = std::cbrt(3 / (4 * std::numbers::pi));

/// Where the ground falls to, as seen from above; east where it is level.
double downhill(std::span<const Vec<3>> ground, const Compass& compass) {
  Vec<3> middle = Vec<3>::Zero();
  for (const Vec<3>& x : ground) middle += x / static_cast<double>(ground.size());
  // The plane through the ground, by least squares.
  Mat<2> squares = Mat<2>::Zero();
  Vec<2> rise = Vec<2>::Zero();
  for (const Vec<3>& x : ground) {
    const Vec<3> d = x - middle;
    const Vec<2> level(d.dot(compass.east), d.dot(compass.north));
    squares += level * level.transpose();
    rise += level * d.dot(compass.up);
  }
  const Vec<2> slope = squares.inverse() * rise;
  const double steep = slope.norm();
  if (!(steep > 0.02)) return compass.azimuth_of(compass.east);
  return compass.azimuth_of(-slope[0] * compass.east - slope[1] * compass.north);
}

/// Ground within a part of the plan, on a coarse grid.
std::vector<Vec<3>> ground_points(const Relief& ground, const Box<2>& part) {
  std::vector<Vec<3>> points;
  Index<2> step;
  for (int k = 0; k < 2; ++k)
    step[k] = std::clamp(static_cast<int>(part.size()[k] / ground.spacing / 16), 1, std::max(1, ground.shape[k] / 32));
  for (int j = 0; j < ground.shape[1]; j += step[1])
    for (int i = 0; i < ground.shape[0]; i += step[0]) {
      const Vec<2> place = ground.place({i, j}).cwiseMax(part.lower).cwiseMin(part.upper);
      if ((place - ground.place({i, j})).norm() > std::max(step[0], step[1]) * ground.spacing) continue;
      const float z = ground.height[flat<2>({i, j}, ground.shape)];
      if (std::isfinite(z)) points.emplace_back(place[0], place[1], static_cast<double>(z));
    }
  return points;
}

Box<3> bounds(std::span<const Vec<3>> points) {
  Box<3> box{points.front(), points.front()};
  for (const Vec<3>& x : points) box = {box.lower.cwiseMin(x), box.upper.cwiseMax(x)};
  return box;
}

}  // namespace

View preview_view(const Scene& scene) {
  View view;
  view.width = scene.output.preview_width / 2 * 2;
  view.height = (view.width * 9 + 16) / 32 * 2;
  return view;
}

Scenery::Scenery(const Scene& scene, const View& view) : opaque_smoke_(scene.output.opaque_smoke) {
  fill_ground(scene);
  if (scene.dense_flow) spacing_ = scene.dense_flow->spacing();
  const Compass compass(make_gravity<3>(scene));
  place_camera(compass, view);
}

void Scenery::fill_ground(const Scene& scene) {
  const Walls<3> walls = make_walls<3>(scene);
  domain_ = walls.domain;
  obstacles_ = walls.obstacles;
  cover_ = make_cover_area(scene, walls);
  if (!walls.terrain && walls.sides[2][0] == Side::open) return;
  const Vec<2> size = domain_.size().head<2>();
  const double rim = beyond * size.maxCoeff();
  ground_.spacing = size.maxCoeff() / points_along;
  ground_.origin = domain_.lower.head<2>() - Vec<2>::Constant(rim);
  for (int k = 0; k < 2; ++k)
    ground_.shape[static_cast<std::size_t>(k)] = static_cast<int>(std::ceil((size[k] + 2 * rim) / ground_.spacing)) + 1;
  const Vec<2> clear = Vec<2>::Constant(0.3 * rim);
  ground_.shown = {domain_.lower.head<2>() - clear, domain_.upper.head<2>() + clear};
  ground_.height.reserve(count<2>(ground_.shape));
  for_each_index<2>(ground_.shape, [&](const Index<2>& i) {
    const Vec<2> place = ground_.place(i);
    // Where an elevation model has no heights there is no ground to be seen.
    const bool beside = (place - place.cwiseMax(domain_.lower.head<2>()).cwiseMin(domain_.upper.head<2>())).norm() > 0;
    const bool unknown = scene.elevation && (beside || !walls.known.at(place));
    const double z = unknown         ? std::numeric_limits<double>::quiet_NaN()
                     : walls.terrain ? walls.terrain->height({place[0], place[1], 0})
                                     : domain_.lower[2];
    ground_.height.push_back(static_cast<float>(z));
  });
}

void Scenery::place_camera(const Compass& compass, const View& view) {
  const Box<2> part = view.part.value_or(Box<2>{domain_.lower.head<2>(), domain_.upper.head<2>()});
  std::vector<Vec<3>> ground = ground_.empty() ? std::vector<Vec<3>>{} : ground_points(ground_, part);
  const bool none = ground.empty();
  if (none)
    for (int corner = 0; corner < 8; ++corner) {
      Vec<3> x = domain_.lower;
      for (int k = 0; k < 3; ++k)
        if (corner >> k & 1) x[k] = domain_.upper[k];
      ground.push_back(x);
    }
  const Box<3> extent = bounds(ground);
  const Vec<3> middle = (extent.lower + extent.upper) / 2;

  Outlook outlook;
  outlook.azimuth = view.azimuth.value_or(downhill(ground, compass) + aside);
  outlook.elevation = view.elevation.value_or(camera_elevation);
  if (!none) {
    const std::size_t n = ground.size();
    const double size = extent.size().norm(), above = domain_.upper[2] - extent.upper[2];
    const double room = std::min(std::clamp(above, headroom * size, 3 * headroom * size), domain_.size()[2]);
    for (std::size_t i = 0; i < n; ++i) ground.push_back(ground[i] + room * compass.up);
  }
  camera_ = camera_around(ground, picture_rim, outlook, compass, view.width, view.height);
  middle_depth_ = camera_.project(middle).depth;
  if (view.distance || view.zoom != 1) {
    middle_depth_ = view.distance.value_or(middle_depth_) / view.zoom;
    camera_ = camera_at(middle, middle_depth_, outlook, compass, view.width, view.height);
  }
  light_.up = compass.up;
  light_.sun = compass.direction(view.sun_azimuth.value_or(outlook.azimuth + sun_aside),
                                 view.sun_elevation.value_or(sun_elevation));
}

Landscape Scenery::landscape(const PictureFrame& frame) const {
  Landscape landscape;
  landscape.ground = ground_;
  landscape.boxes = obstacles_;
  landscape.opaque_smoke = opaque_smoke_;
  landscape.snow_radius = ball_of_cube * spacing_;
  if (!ground_.empty() && !frame.positions.empty())
    add_cover(landscape.ground, domain_, spacing_, cover_ ? &*cover_ : nullptr, frame);
  for (std::size_t i = 0; i < frame.layer.size(); ++i) {
    if (frame.layer[i] != 0) continue;
    const float* const x = frame.positions.data() + 3 * i;
    landscape.snow.push_back(Eigen::Map<const Eigen::Vector3f>(x).cast<double>());
    landscape.snow_kind.push_back(frame.entrained_at[i] >= 0);
  }
  if (!frame.smoke.empty()) {
    SmokeLattice& smoke = landscape.smoke;
    smoke.density = frame.smoke;
    smoke.solid = frame.solid;
    for (int k = 0; k < 3; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      smoke.shape[axis] = static_cast<int>(frame.lattice.shape[axis]);
      smoke.origin[k] = frame.lattice.origin[axis];
    }
    smoke.spacing = frame.lattice.spacing[0];
  }
  return landscape;
}

std::vector<std::byte> Scenery::png(const PictureFrame& frame) const {
  return landscape_png(landscape(frame), camera_, light_, frame.time, middle_depth_);
}

}  // namespace spindrift
