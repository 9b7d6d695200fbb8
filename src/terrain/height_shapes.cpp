#include "terrain/height_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "terrain/profile.hpp"

namespace spindrift {
namespace {

using std::numbers::pi;

constexpr double resolution = 0.1;  // of a slope's arc [m]

/// From 0 to 1 over [0, 1], level at both ends.
double smooth_step(double t) {
  const double s = std::clamp(t, 0.0, 1.0);
  return s * s * (3 - 2 * s);
}

/// Height over the lowest point of a parabola at `way` from it, straight beyond the length at which it has `angle`.
double on_parabola(double way, double angle, double drop) {
  const double length = 2 * drop / std::tan(angle);
  return way < length ? drop * (way / length) * (way / length) : drop + std::tan(angle) * (way - length);
}

std::shared_ptr<const Profile> ground_of(SlopeProfile slope, double end_x) {
  slope.bump_height = slope.cliff_height = 0;
  return std::make_shared<const Profile>(slope_profile(slope, end_x, resolution));
}

[[noreturn]] void refuse(const char* why) {
  throw Error(ExitCode::bad_input, std::string("terrain: ") + why);
}

}  // namespace

HeightFunction tilted_plane(const Vec<3>& start, double angle, double side_angle) {
  const double fall_x = std::tan(angle), fall_y = std::tan(side_angle);
  return [=](double x, double y) { return start[2] - fall_x * (x - start[0]) - fall_y * (y - start[1]); };
}

HeightFunction parabola(const Vec<3>& start, double angle, double drop) {
  const double lowest_x = start[0] + 2 * drop / std::tan(angle);
  return [=](double x, double) { return start[2] - drop + on_parabola(std::max(0.0, lowest_x - x), angle, drop); };
}

HeightFunction bowl(const Vec<3>& start, double angle, double drop) {
  const double lowest_x = start[0] + 2 * drop / std::tan(angle);
  return [=](double x, double y) {
    return start[2] - drop + on_parabola(std::hypot(x - lowest_x, y - start[1]), angle, drop);
  };
}

HeightFunction helix(const Helix& h) {
  const double end = h.drop / (h.radius * std::tan(h.angle));  // phi of the channel's end
  const double free = 2 * pi - end;
  if (!(free >= pi / 2))
    refuse("the helix would run more than three quarters of its circle: less drop, or a larger radius");
  return [=](double x, double y) {
    const double to_x = x - h.start[0], to_y = y - h.start[1] - h.radius, r = std::hypot(to_x, to_y);
    double phi = std::atan2(to_x, -to_y);
    if (phi < -free / 2) phi += 2 * pi;  // what lies free is halved between before the start and behind the end
    const double fallen = phi < 0     ? smooth_step(-phi / free)
                          : phi < end ? phi / end
                                      : smooth_step((end + free - phi) / free);
    const double share = smooth_step(2 * r / h.radius);
    const double across = 2 * (r - h.radius) / h.width;
    return h.start[2] - h.drop * (0.5 + share * (fallen - 0.5)) + h.depth * (1 - std::exp(-2 * across * across));
  };
}

HeightFunction ridge(const SlopeProfile& slope, const Vec<3>& start, double end_x, double height, double width,
                     double at) {
  return [=, ground = ground_of(slope, end_x)](double x, double y) {
    const double s = (std::isnan(at) ? y - start[1] : x - start[0] - at) / width;
    return ground->height(x) + height * std::exp(-s * s / 2);
  };
}

HeightFunction cliff_band(const SlopeProfile& slope, double end_x, double cliff_angle) {
  const double fall = std::tan(slope.angle), steepest = std::tan(cliff_angle);
  if (!(steepest > fall)) refuse("the band of cliffs must be steeper than the slope");
  const double begin = slope.start[0] + slope.cliff_at / fall, length = 1.5 * slope.cliff_height / (steepest - fall);
  SlopeProfile rest = slope;
  rest.drop -= slope.cliff_height;
  return [=, cliff = slope.cliff_height, ground = ground_of(rest, end_x)](double x, double) {
    return ground->height(x) - cliff * smooth_step((x - begin) / length);
  };
}

HeightFunction valley(const Vec<3>& start, double angle, double width, double wall_angle, double radius) {
  const double fall = std::tan(angle), rise = std::tan(wall_angle), c = radius * rise;
  return [=](double x, double y) {
    const double e = std::max(0.0, std::abs(y - start[1]) - width / 2);
    return start[2] - fall * (x - start[0]) + rise * (std::hypot(e, c) - c);
  };
}

HeightGrid sampled(const HeightFunction& z, const Box<2>& extent, double rim, double cell) {
  HeightGrid grid;
  grid.cell = cell;
  Vec<2> points;
  for (int k = 0; k < 2; ++k) {
    const double first = std::floor((extent.lower[k] - rim) / cell), last = std::ceil((extent.upper[k] + rim) / cell);
    grid.first[k] = first * cell;
    points[k] = last - first + 1;
  }
  if (!(points.prod() <= 5e7))
    throw Error(ExitCode::would_not_fit,
                "the ground would have " + std::to_string(points.prod()) +
                    " points, at most 5e7 can be: a larger terrain.cell_size or a smaller domain");
  grid.points = {static_cast<int>(points[0]), static_cast<int>(points[1])};
  grid.z.resize(count<2>(grid.points));
  parallel_for(grid.z.size(), [&](std::size_t n) {
    const Index<2> i = unflat<2>(n, grid.points);
    grid.z[n] = z(grid.first[0] + cell * i[0], grid.first[1] + cell * i[1]);
  });
  return grid;
}

}  // namespace spindrift
