#include <algorithm>
#include <cmath>
#include <limits>

#include "io/smoke_volume.hpp"

namespace spindrift {
namespace {

constexpr double step_in_cells = 1.0 / 3;
constexpr float hidden = 0.004f;  // share of what is behind that is seen no more

}  // namespace

/// Eight cells around a place and the place's weights between them.
struct SmokeVolume::Corner {
  std::size_t first = 0;
  float a = 0, b = 0, c = 0;
  bool inside = false;

  /// s: the place in cells from the first one's centre.
  Corner(const SmokeVolume& volume, float x, float y, float z) {
    const Index<3>& n = volume.shape_;
    inside = x >= 0 && y >= 0 && z >= 0 && x < static_cast<float>(n[0] - 1) && y < static_cast<float>(n[1] - 1) &&
             z < static_cast<float>(n[2] - 1);
    if (!inside) return;
    const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
    first = volume.at(i, j, k);
    a = x - static_cast<float>(i), b = y - static_cast<float>(j), c = z - static_cast<float>(k);
  }
  Corner(const SmokeVolume& volume, const Vec<3>& x)
      : Corner(volume, static_cast<float>((x[0] - volume.origin_[0]) / volume.spacing_),
               static_cast<float>((x[1] - volume.origin_[1]) / volume.spacing_),
               static_cast<float>((x[2] - volume.origin_[2]) / volume.spacing_)) {}
};

float SmokeVolume::between(const Values& values, const Corner& corner) const {
  const float* const v = values.data() + corner.first;
  const std::size_t y = static_cast<std::size_t>(shape_[0]), z = y * static_cast<std::size_t>(shape_[1]);
  const auto line = [&](const float* from) { return from[0] + corner.a * (from[1] - from[0]); };
  const float low = line(v) + corner.b * (line(v + y) - line(v));
  const float high = line(v + z) + corner.b * (line(v + z + y) - line(v + z));
  return low + corner.c * (high - low);
}

float SmokeVolume::extinction(const Vec<3>& x) const {
  if (empty()) return 0;
  const Corner corner(*this, x);
  return corner.inside ? between(extinction_, corner) : 0.0f;
}

/// Cuts [from, to] to where eye + t direction is between the cells' centres; false: nowhere.
bool SmokeVolume::range(const Vec<3>& eye, const Vec<3>& direction, double& from, double& to) const {
  for (int k = 0; k < 3; ++k) {
    const double low = origin_[k], high = origin_[k] + spacing_ * (shape_[static_cast<std::size_t>(k)] - 1);
    if (direction[k] == 0) {
      if (eye[k] < low || eye[k] >= high) return false;
      continue;
    }
    const double a = (low - eye[k]) / direction[k], b = (high - eye[k]) / direction[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from < to;
}

float SmokeVolume::sunlight(const Vec<3>& x) const {
  if (empty()) return 1;
  const Corner here(*this, x);
  if (here.inside) return between(sunlight_, here);
  double from = 0, to = std::numeric_limits<double>::infinity();
  if (!range(x, light_.sun, from, to)) return 1;
  // A little further in, so that it is inside for sure.
  const Corner entry(*this, Vec<3>(x + std::min(from + 1e-3 * spacing_, 0.5 * (from + to)) * light_.sun));
  return entry.inside ? between(sunlight_, entry) : 1.0f;
}

float SmokeVolume::skylight(const Vec<3>& x) const {
  if (empty()) return 1;
  constexpr double fades_over = 4;  // cells
  Vec<3> nearest;
  for (int k = 0; k < 3; ++k) {
    const double last = shape_[static_cast<std::size_t>(k)] - 1;
    nearest[k] = std::clamp(x[k], origin_[k] + 1e-3 * spacing_, origin_[k] + (last - 1e-3) * spacing_);
  }
  const double outside = (x - nearest).norm() / (fades_over * spacing_);
  const Corner corner(*this, nearest);
  const float light = corner.inside ? between(skylight_, corner) : 1.0f;
  return 1 - (1 - light) * static_cast<float>(std::exp(-outside));
}

void SmokeVolume::pass(Seen& seen, const Vec<3>& eye, const Vec<3>& direction, double from, double to,
                       double jitter) const {
  if (empty() || seen.clear < hidden || !range(eye, direction, from, to)) return;
  const double length = direction.norm();
  const double step = step_in_cells * spacing_ / length;
  const Vec<3> start = (eye - origin_) / spacing_, pace = direction / spacing_;
  const auto place = [&](double t, int k) { return static_cast<float>(start[k] + t * pace[k]); };
  for (double n = std::floor(from / step); n * step < to; ++n) {
    const double begin = std::max(n * step, from), end = std::min((n + 1) * step, to);
    const double t = std::clamp((n + jitter) * step, begin, end);
    const Corner corner(*this, place(t, 0), place(t, 1), place(t, 2));
    if (!corner.inside) continue;
    Index<3> b;
    for (int k = 0; k < 3; ++k) b[static_cast<std::size_t>(k)] = static_cast<int>(place(t, k)) / block;
    if (!smoky_[flat<3>(b, blocks_)]) {
      // On to where the ray leaves the clear block.
      double leaves = to;
      for (int k = 0; k < 3; ++k) {
        if (pace[k] == 0) continue;
        const double side = block * (b[static_cast<std::size_t>(k)] + (pace[k] > 0 ? 1 : 0));
        leaves = std::min(leaves, (side - start[k]) / pace[k]);
      }
      n = std::max(n, std::floor(leaves / step) - 1);
      continue;
    }
    const float extinction = between(extinction_, corner);
    if (extinction <= 0) continue;
    const float clear = std::exp(-extinction * static_cast<float>((end - begin) * length));
    const float turned = seen.clear * (1 - clear);
    seen.sun += turned * with_turned(between(sunlight_, corner));
    seen.sky += turned * with_turned(between(skylight_, corner));
    seen.clear *= clear;
    if (seen.clear < hidden) return;
  }
}

}  // namespace spindrift
