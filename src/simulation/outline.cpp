#include "simulation/outline.hpp"

#include <algorithm>
#include <cmath>

namespace spindrift {

bool inside(const Outline& corners, double x, double z) {
  bool in = false;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const auto& [xi, zi] = corners[i];
    const auto& [xj, zj] = corners[j];
    if ((zi > z) != (zj > z) && x < xi + (xj - xi) * (z - zi) / (zj - zi)) in = !in;
  }
  return in;
}

bool inside_any(const std::vector<Outline>& outlines, const Vec<2>& place) {
  return std::any_of(outlines.begin(), outlines.end(),
                     [&](const Outline& outline) { return inside(outline, place[0], place[1]); });
}

Box<2> extent_of(const Outline& corners) {
  Box<2> extent{{corners[0][0], corners[0][1]}, {corners[0][0], corners[0][1]}};
  for (const auto& [x, y] : corners) {
    extent.lower = extent.lower.cwiseMin(Vec<2>(x, y));
    extent.upper = extent.upper.cwiseMax(Vec<2>(x, y));
  }
  return extent;
}

Box<2> hull_of(const Box<2>& a, const Box<2>& b) {
  return {a.lower.cwiseMin(b.lower), a.upper.cwiseMax(b.upper)};
}

double area_of(const Outline& corners) {
  double twice = 0;
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    // About the first corner: coordinates of a map have six digits before the point.
    const auto &a = corners[j], &b = corners[i], &o = corners[0];
    twice += (a[0] - o[0]) * (b[1] - o[1]) - (b[0] - o[0]) * (a[1] - o[1]);
  }
  return std::abs(twice) / 2;
}

}  // namespace spindrift
