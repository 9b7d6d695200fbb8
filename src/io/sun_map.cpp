#include "io/sun_map.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "io/solids.hpp"

namespace spindrift {
namespace {

constexpr int most_cells = 1024;  // along a side of the raster
constexpr int band_rows = 32;

}  // namespace

SunMap::SunMap(const Landscape& landscape, const ReliefSurface* surface, const Light& light) : sun_(light.sun) {
  across_ = (std::abs(sun_[0]) < 0.8 ? Vec<3>::UnitX() : Vec<3>::UnitY()).cross(sun_).normalized();
  along_ = sun_.cross(across_);
  Vec<3> least = Vec<3>::Constant(std::numeric_limits<double>::infinity()), most = -least;
  const auto include = [&](const Vec<3>& x, double radius) {
    if (!x.allFinite()) return;
    const Vec<3> place(x.dot(across_), x.dot(along_), x.dot(sun_));
    least = least.cwiseMin(place - Vec<3>::Constant(radius));
    most = most.cwiseMax(place + Vec<3>::Constant(radius));
  };
  if (surface) for_each_index<2>(landscape.ground.shape, [&](const Index<2>& i) { include(surface->position(i), 0); });
  for (const Box<3>& box : landscape.boxes) include((box.lower + box.upper) / 2, box.size().norm() / 2);
  for (const Vec<3>& x : landscape.snow) include(x, landscape.snow_radius);
  if (!(least[0] <= most[0])) return;

  cell_ = std::max((most - least).head<2>().maxCoeff() / most_cells, 1e-6);
  lower_ = least.head<2>();
  farthest_ = least[2] - cell_;
  width_ = static_cast<int>((most[0] - least[0]) / cell_) + 1;
  height_ = static_cast<int>((most[1] - least[1]) / cell_) + 1;
  nearness_.resize(static_cast<std::size_t>(width_) * static_cast<std::size_t>(height_));

  Projection projection;
  projection.point = [this](const Vec<3>& x) {
    return ScreenPoint{static_cast<float>((x.dot(across_) - lower_[0]) / cell_),
                       static_cast<float>((x.dot(along_) - lower_[1]) / cell_),
                       static_cast<float>(x.dot(sun_) - farthest_)};
  };
  const float radius = static_cast<float>(landscape.snow_radius);
  const float radius_in_cells = std::max(static_cast<float>(landscape.snow_radius / cell_), 0.71f);
  projection.ball = [&, radius, radius_in_cells](const Vec<3>& x) {
    const ScreenPoint middle = projection.point(x);
    return ScreenBall{middle.x, middle.y, radius_in_cells, middle.nearness, radius};
  };
  const Solids solids(landscape, surface, projection, height_);
  const auto draw = [&](std::size_t b) {
    DepthBand band;
    const int first = static_cast<int>(b) * band_rows, n = std::min(band_rows, height_ - first);
    band.clear(width_, first, n);
    solids.draw(band);
    std::copy_n(band.row(first), static_cast<std::size_t>(n) * static_cast<std::size_t>(width_),
                nearness_.begin() + first * std::ptrdiff_t{width_});
  };
  parallel_for(static_cast<std::size_t>((height_ + band_rows - 1) / band_rows), draw, 1);
}

float SunMap::lit(const Vec<3>& x, const Vec<3>& normal) const {
  if (nearness_.empty()) return 1;
  // Off the surface by the reach of the mean below, or a slanting surface would shade itself.
  const Vec<3> from = x + cell_ * (2.8 * normal + 0.5 * sun_);
  const float own = static_cast<float>(from.dot(sun_) - farthest_);
  const double u = (from.dot(across_) - lower_[0]) / cell_ - 0.5, v = (from.dot(along_) - lower_[1]) / cell_ - 0.5;
  if (!(std::abs(u) < 1e6 && std::abs(v) < 1e6)) return 1;
  const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
  const float a = static_cast<float>(u - i), b = static_cast<float>(v - j);
  // The mean over a square of three cells' edge about the place.
  const float weight_u[4] = {1 - a, 1, 1, a}, weight_v[4] = {1 - b, 1, 1, b};
  float sum = 0;
  for (int m = 0; m < 4; ++m)
    for (int k = 0; k < 4; ++k) {
      const int p = i - 1 + k, q = j - 1 + m;
      const bool outside = p < 0 || q < 0 || p >= width_ || q >= height_;
      if (outside ||
          nearness_[static_cast<std::size_t>(q) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(p)] <=
              own)
        sum += weight_u[k] * weight_v[m];
    }
  return sum / 9;
}

}  // namespace spindrift
