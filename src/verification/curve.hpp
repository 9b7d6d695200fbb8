#pragma once
/// A quantity over another, as points.

#include <array>
#include <cstddef>
#include <vector>

namespace spindrift {

/// (x, y), x ascending.
using Curve = std::vector<std::array<double, 2>>;

/// y at x, linear between the points, and beyond them along the first and the last piece.   Pre: two points.
inline double interpolated(const Curve& curve, double x) {
  std::size_t i = 1;
  while (i + 1 < curve.size() && curve[i][0] < x) ++i;
  const auto& [x0, y0] = curve[i - 1];
  const auto& [x1, y1] = curve[i];
  return y0 + (y1 - y0) * (x - x0) / (x1 - x0);
}

}  // namespace spindrift
