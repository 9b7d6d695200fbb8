#include "terrain/profiles.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/error.hpp"

namespace spindrift {
namespace {

using std::numbers::pi;

Vec<2> downhill(double angle) {
  return {std::cos(angle), -std::sin(angle)};
}
Vec<2> out_of_ground(double angle) {
  return {std::sin(angle), std::cos(angle)};
}

/// Bump height over the distance s along a slope of length l: a sine that fades to zero at both ends.
double bump(const SlopeProfile& slope, double s, double l) {
  const double fade = std::min({1.0, 2 * s / slope.bump_length, 2 * (l - s) / slope.bump_length});
  const double smooth = fade * fade * (3 - 2 * fade);
  return 0.5 * slope.bump_height * smooth * std::sin(2 * pi * s / slope.bump_length);
}

}  // namespace

std::vector<Vec<2>> slope_profile(const SlopeProfile& slope, double end_x, double resolution) {
  const auto refuse = [](const char* why) { throw Error(ExitCode::bad_input, std::string("terrain: ") + why); };
  const Vec<2> along = downhill(slope.angle);
  const double turn = slope.angle - slope.runout_angle;
  const double tangent_length = slope.transition_radius * std::tan(std::abs(turn) / 2);
  const double slope_drop = slope.drop - slope.cliff_height;
  const double length = std::abs(along[1]) > 0 ? slope_drop / -along[1] : 0;
  if (length <= tangent_length) refuse("the slope is too short for its transition radius");

  std::vector<Vec<2>> v{slope.start};
  const double straight = length - tangent_length;
  if (slope.bump_height > 0) {
    const int n = std::max(2, static_cast<int>(std::ceil(straight / resolution)));
    for (int i = 1; i < n; ++i) {
      const double s = straight * i / n;
      v.push_back(slope.start + s * along + bump(slope, s, straight) * out_of_ground(slope.angle));
    }
  }
  Vec<2> offset = Vec<2>::Zero();
  if (slope.cliff_height > 0) {
    const double s = slope.cliff_at / -along[1];
    if (s <= 0 || s >= straight) refuse("the cliff lies outside the slope");
    v.push_back(slope.start + s * along);
    offset[1] = -slope.cliff_height;
    v.push_back(v.back() + offset);
  }
  const Vec<2> arc_begin = slope.start + straight * along + offset;
  v.push_back(arc_begin);
  const double side = turn >= 0 ? 1 : -1;
  const Vec<2> centre = arc_begin + side * slope.transition_radius * out_of_ground(slope.angle);
  const int n = static_cast<int>(std::ceil(slope.transition_radius * std::abs(turn) / resolution));
  for (int i = 1; i <= n; ++i)
    v.push_back(centre - side * slope.transition_radius * out_of_ground(slope.angle - turn * i / n));
  const Vec<2> run = downhill(slope.runout_angle);
  if (v.back()[0] >= end_x) refuse("the slope's foot lies beyond the domain");
  if (run[0] <= 0) refuse("the run-out angle must be below 90 degrees");
  v.push_back(v.back() + (end_x - v.back()[0]) / run[0] * run);
  return v;
}

}  // namespace spindrift
