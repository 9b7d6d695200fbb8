#pragma once
/// Some rows of a picture while solid things are drawn into it: what is nearest, at every sample.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

/// A point in a picture. `nearness` grows towards the eye, is above 0, and runs linearly over the picture of a plane:
/// 1 / depth in perspective, any constant less the depth in a parallel projection.
struct ScreenPoint {
  float x, y;
  float nearness;  ///< 0 or less: behind the eye
};

/// A ball in a picture: nearness + bulge sqrt(1 - q^2) at q radii from its middle.
struct ScreenBall {
  float x, y, radius;  ///< [px]
  float nearness, bulge;
};

/// A z-buffer of the rows [first_row, first_row + n_rows).
class DepthBand {
 public:
  void clear(int width, int first_row, int n_rows) {
    width_ = width, first_row_ = first_row, n_rows_ = n_rows;
    const std::size_t n = static_cast<std::size_t>(width) * static_cast<std::size_t>(n_rows);
    nearness_.assign(n, 0.0f);
    what_.assign(n, nothing);
  }

  /// Draws with the number `what`, where nothing nearer is; of what is equally near the first stays.
  void triangle(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, std::int32_t what);
  void ball(const ScreenBall& ball, std::int32_t what);

  static constexpr std::int32_t nothing = -1;
  float nearness(int x, int y) const { return nearness_[at(x, y)]; }  ///< 0 where there is nothing
  std::int32_t what(int x, int y) const { return what_[at(x, y)]; }
  int first_row() const { return first_row_; }
  int n_rows() const { return n_rows_; }
  const float* row(int y) const { return nearness_.data() + at(0, y); }

 private:
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y - first_row_) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }
  void draw(std::size_t n, float nearness, std::int32_t what) {
    if (nearness <= nearness_[n]) return;
    nearness_[n] = nearness;
    what_[n] = what;
  }

  int width_ = 0, first_row_ = 0, n_rows_ = 0;
  std::vector<float> nearness_;
  std::vector<std::int32_t> what_;
};

inline void DepthBand::triangle(const ScreenPoint& a, const ScreenPoint& b, const ScreenPoint& c, std::int32_t what) {
  if (!(a.nearness > 0 && b.nearness > 0 && c.nearness > 0)) return;
  const float bottom = static_cast<float>(first_row_ + n_rows_), top = static_cast<float>(first_row_);
  const float least_y = std::min({a.y, b.y, c.y}), most_y = std::max({a.y, b.y, c.y});
  const float least_x = std::min({a.x, b.x, c.x}), most_x = std::max({a.x, b.x, c.x});
  if (!(most_y > top && least_y < bottom && most_x > 0 && least_x < static_cast<float>(width_))) return;
  const float area = (b.x - a.x) * (c.y - a.y) - (c.x - a.x) * (b.y - a.y);
  if (area == 0) return;
  const float per_area = 1 / area;
  constexpr float rounding = 1e-4f;  // neighbours overlap a little, so that no sample falls between them
  // Samples are at half numbers.
  const int x0 = static_cast<int>(std::ceil(std::max(least_x, 0.0f) - 0.5f));
  const int x1 = static_cast<int>(std::ceil(std::min(most_x, static_cast<float>(width_)) - 0.5f));
  const int y0 = static_cast<int>(std::ceil(std::max(least_y, top) - 0.5f));
  const int y1 = static_cast<int>(std::ceil(std::min(most_y, bottom) - 0.5f));
  for (int y = y0; y < y1; ++y) {
    const float py = static_cast<float>(y) + 0.5f;
    for (int x = x0; x < x1; ++x) {
      const float px = static_cast<float>(x) + 0.5f;
      const float u = ((px - a.x) * (c.y - a.y) - (c.x - a.x) * (py - a.y)) * per_area;
      const float v = ((b.x - a.x) * (py - a.y) - (px - a.x) * (b.y - a.y)) * per_area;
      if (u < -rounding || v < -rounding || u + v > 1 + rounding) continue;
      draw(at(x, y), a.nearness + u * (b.nearness - a.nearness) + v * (c.nearness - a.nearness), what);
    }
  }
}

inline void DepthBand::ball(const ScreenBall& ball, std::int32_t what) {
  const float bottom = static_cast<float>(first_row_ + n_rows_), top = static_cast<float>(first_row_);
  const float r = ball.radius;
  if (!(ball.nearness > 0 && ball.y + r > top && ball.y - r < bottom && ball.x + r > 0 &&
        ball.x - r < static_cast<float>(width_)))
    return;
  const int x0 = static_cast<int>(std::ceil(std::max(ball.x - r, 0.0f) - 0.5f));
  const int x1 = static_cast<int>(std::ceil(std::min(ball.x + r, static_cast<float>(width_)) - 0.5f));
  const int y0 = static_cast<int>(std::ceil(std::max(ball.y - r, top) - 0.5f));
  const int y1 = static_cast<int>(std::ceil(std::min(ball.y + r, bottom) - 0.5f));
  for (int y = y0; y < y1; ++y)
    for (int x = x0; x < x1; ++x) {
      const float dx = (static_cast<float>(x) + 0.5f - ball.x) / r, dy = (static_cast<float>(y) + 0.5f - ball.y) / r;
      const float rest = 1 - dx * dx - dy * dy;
      if (rest > 0) draw(at(x, y), ball.nearness + ball.bulge * std::sqrt(rest), what);
    }
}

}  // namespace spindrift
