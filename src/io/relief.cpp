#include "io/relief.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

/// dz along one axis, of the two neighbours or of the one that there is.   step: 1 or the row's length
float slope(const float* z, int i, int n, std::ptrdiff_t step, float spacing) {
  const float before = i > 0 ? z[-step] : z[0], after = i + 1 < n ? z[step] : z[0];
  const float apart = i > 0 && i + 1 < n ? 2 * spacing : spacing;
  const float rise = (after - before) / apart;
  return std::isfinite(rise) ? rise : 0;
}

/// 1 within [lower, upper], smoothly 0 towards first and last.
double shown_along(double x, double lower, double upper, double first, double last) {
  double outside = 0;
  if (x < lower) outside = lower > first ? (lower - x) / (lower - first) : 1;
  if (x > upper) outside = last > upper ? (x - upper) / (last - upper) : 1;
  const double inside = 1 - std::clamp(outside, 0.0, 1.0);
  return inside * inside * (3 - 2 * inside);
}

}  // namespace

ReliefSurface::ReliefSurface(const Relief& relief) : relief_(relief), points_(count<2>(relief.shape)) {
  SPINDRIFT_CHECK(!relief.empty() && relief.height.size() == points_.size());
  SPINDRIFT_CHECK(relief.snow.empty() || relief.snow.size() == points_.size());
  const Vec<2> last = relief.place({relief.shape[0] - 1, relief.shape[1] - 1});
  const auto row = [&](std::size_t j) {
    const int y = static_cast<int>(j);
    for (int x = 0; x < relief.shape[0]; ++x) {
      const std::size_t n = flat<2>({x, y}, relief.shape);
      const float* const z = relief.height.data() + n;
      const float spacing = static_cast<float>(relief.spacing);
      const Vec<2> place = relief.place({x, y});
      double shown = 1;
      for (int k = 0; k < 2; ++k)
        shown *= shown_along(place[k], relief.shown.lower[k], relief.shown.upper[k], relief.origin[k], last[k]);
      points_[n] = {slope(z, x, relief.shape[0], 1, spacing), slope(z, y, relief.shape[1], relief.shape[0], spacing),
                    relief.snow.empty() ? 0.0f : relief.snow[n], static_cast<float>(shown)};
    }
  };
  parallel_for(static_cast<std::size_t>(relief.shape[1]), row, 16);
}

ReliefSurface::Point ReliefSurface::at(double x, double y) const {
  const auto locate = [&](double along, int axis, int& i) {
    const double s = std::clamp((along - relief_.origin[axis]) / relief_.spacing, 0.0, relief_.shape[axis] - 1.0);
    i = std::min(static_cast<int>(s), relief_.shape[axis] - 2);
    return static_cast<float>(s - i);
  };
  Index<2> i;
  const float a = locate(x, 0, i[0]), b = locate(y, 1, i[1]);
  const Point* const p = points_.data() + flat<2>(i, relief_.shape);
  const Point* const q = p + relief_.shape[0];
  const auto mix = [&](float Point::*m) {
    return (1 - b) * ((1 - a) * p[0].*m + a * p[1].*m) + b * ((1 - a) * q[0].*m + a * q[1].*m);
  };
  return {mix(&Point::slope_x), mix(&Point::slope_y), mix(&Point::snow), mix(&Point::shown)};
}

}  // namespace spindrift
