#include "io/solids.hpp"

#include <array>
#include <limits>

#include "core/parallel.hpp"

namespace spindrift {
namespace {

constexpr int stripe = 16;  // rows of the picture

/// Corners of a box: bit k of the number is set where it is the upper one along axis k.
constexpr std::array<std::array<int, 4>, 6> face_corners{
    {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 3, 7, 6}, {0, 1, 3, 2}, {4, 5, 7, 6}}};

}  // namespace

Solids::Solids(const Landscape& landscape, const ReliefSurface* surface, const Projection& projection, int height)
    : landscape_(landscape) {
  if (surface) {
    shape_ = landscape.ground.shape;
    points_.resize(count<2>(shape_));
    const auto project_row = [&](std::size_t j) {
      for (int i = 0; i < shape_[0]; ++i) {
        const Vec<3> x = surface->position({i, static_cast<int>(j)});
        points_[flat<2>({i, static_cast<int>(j)}, shape_)] = x.allFinite() ? projection.point(x) : ScreenPoint{0, 0, 0};
      }
    };
    parallel_for(static_cast<std::size_t>(shape_[1]), project_row, 16);
    rows_.resize(static_cast<std::size_t>(shape_[1]) - 1);
    const auto extent = [&](std::size_t j) {
      Rows reach{std::numeric_limits<float>::max(), std::numeric_limits<float>::lowest()};
      const std::size_t n = static_cast<std::size_t>(shape_[0]);
      for (std::size_t k = j * n; k < (j + 2) * n; ++k) {
        if (!(points_[k].nearness > 0)) continue;
        reach.first = std::min(reach.first, points_[k].y);
        reach.last = std::max(reach.last, points_[k].y);
      }
      rows_[j] = reach;
    };
    parallel_for(rows_.size(), extent, 16);
  }
  for (const Box<3>& box : landscape.boxes)
    for (int corner = 0; corner < 8; ++corner) {
      Vec<3> x = box.lower;
      for (int k = 0; k < 3; ++k)
        if (corner >> k & 1) x[k] = box.upper[k];
      corners_.push_back(projection.point(x));
    }

  balls_.resize(landscape.snow.size());
  const auto project = [&](std::size_t i) {
    const Vec<3>& x = landscape.snow[i];
    balls_[i] = x.allFinite() ? projection.ball(x) : ScreenBall{0, 0, 0, 0, 0};
  };
  parallel_for(balls_.size(), project);
  // By stripe, in the order of their numbers.
  const std::size_t n_stripes = static_cast<std::size_t>((height + stripe - 1) / stripe);
  const auto stripe_of = [&](const ScreenBall& ball) {
    const float s = std::floor((ball.y - ball.radius) / stripe);
    return static_cast<std::size_t>(std::clamp(s, 0.0f, static_cast<float>(n_stripes - 1)));
  };
  first_.assign(n_stripes + 1, 0);
  for (const ScreenBall& ball : balls_) {
    if (!(ball.nearness > 0)) continue;
    ++first_[stripe_of(ball) + 1];
    most_radius_ = std::max(most_radius_, ball.radius);
  }
  for (std::size_t s = 0; s < n_stripes; ++s) first_[s + 1] += first_[s];
  sorted_.resize(first_[n_stripes]);
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t i = 0; i < balls_.size(); ++i)
    if (balls_[i].nearness > 0) sorted_[next[stripe_of(balls_[i])]++] = i;
}

void Solids::draw(DepthBand& band) const {
  if (!points_.empty()) draw_ground(band);
  draw_boxes(band);
  const float reach = 2 * most_radius_;
  const auto stripe_at = [&](float y) {
    return static_cast<std::size_t>(std::clamp(std::floor(y / stripe), 0.0f, static_cast<float>(first_.size() - 2)));
  };
  const std::size_t begin = first_[stripe_at(static_cast<float>(band.first_row()) - reach)];
  const std::size_t end = first_[stripe_at(static_cast<float>(band.first_row() + band.n_rows())) + 1];
  for (std::size_t k = begin; k < end; ++k)
    band.ball(balls_[sorted_[k]], first_ball() + static_cast<std::int32_t>(sorted_[k]));
}

void Solids::draw_ground(DepthBand& band) const {
  const float top = static_cast<float>(band.first_row()), bottom = static_cast<float>(band.first_row() + band.n_rows());
  const std::size_t n = static_cast<std::size_t>(shape_[0]);
  for (std::size_t j = 0; j < rows_.size(); ++j) {
    if (rows_[j].last <= top || rows_[j].first >= bottom) continue;
    const ScreenPoint* const p = points_.data() + j * n;
    for (std::size_t i = 0; i + 1 < n; ++i) {
      band.triangle(p[i], p[i + 1], p[i + n], ground);
      band.triangle(p[i + 1], p[i + n + 1], p[i + n], ground);
    }
  }
}

void Solids::draw_boxes(DepthBand& band) const {
  for (std::size_t b = 0; b < landscape_.boxes.size(); ++b) {
    const ScreenPoint* const p = corners_.data() + 8 * b;
    for (std::size_t f = 0; f < 6; ++f) {
      const auto& [i, j, k, l] = face_corners[f];
      const std::int32_t what = first_face + static_cast<std::int32_t>(6 * b + f);
      band.triangle(p[i], p[j], p[k], what);
      band.triangle(p[i], p[k], p[l], what);
    }
  }
}

}  // namespace spindrift
