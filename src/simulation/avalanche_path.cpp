#include "simulation/avalanche_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spindrift {
namespace {

/// Where a ray from a point of the box leaves it.
Vec<2> leaving(const Box<2>& box, const Vec<2>& from, const Vec<2>& direction) {
  double way = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 2; ++k)
    if (direction[k] != 0)
      way = std::min(way, ((direction[k] > 0 ? box.upper[k] : box.lower[k]) - from[k]) / direction[k]);
  return from + std::max(way, 0.0) * direction;
}

}  // namespace

AvalanchePath::AvalanchePath(const std::vector<std::array<double, 2>>& points, const HeightField& ground,
                             const Box<2>& domain) {
  std::vector<Vec<2>> vertices;
  for (const auto& [x, y] : points) vertices.emplace_back(x, y);
  const std::size_t last = vertices.size();  // of the given points, once there is one before them
  vertices.insert(vertices.begin(), leaving(domain, vertices[0], vertices[0] - vertices[1]));
  vertices.push_back(leaving(domain, vertices[last], vertices[last] - vertices[last - 1]));

  double way = 0, first = 0;
  for (std::size_t i = 0; i + 1 < vertices.size(); ++i) {
    if (i == 1) first = way;
    if (i == last) length_ = way - first;
    const Vec<2> step = vertices[i + 1] - vertices[i];
    if (step.norm() == 0) continue;  // an end on the domain's edge
    Piece piece{vertices[i], step.normalized(), step.norm(), {way}};
    const int n = static_cast<int>(std::ceil(piece.length / ground.cell()));
    double height = ground.height(piece.start);
    for (int k = 1; k <= n; ++k) {
      const double next = ground.height(piece.start + static_cast<double>(k) / n * step);
      way += std::hypot(piece.length / n, next - height);
      piece.way.push_back(way);
      height = next;
    }
    pieces_.push_back(std::move(piece));
  }
  for (Piece& piece : pieces_)
    for (double& at : piece.way) at -= first;
}

double AvalanchePath::along(const Vec<2>& place) const {
  double nearest = std::numeric_limits<double>::infinity(), at = 0;
  const Piece* chosen = nullptr;
  for (const Piece& piece : pieces_) {
    const Vec<2> from_start = place - piece.start;
    const double level = std::clamp(from_start.dot(piece.direction), 0.0, piece.length);
    const double squared = (from_start - level * piece.direction).squaredNorm();
    if (squared < nearest) nearest = squared, at = level, chosen = &piece;
  }
  const auto n = static_cast<double>(chosen->way.size() - 1);
  const double steps = at / chosen->length * n;
  const auto k = static_cast<std::size_t>(std::min(std::floor(steps), n - 1));
  return std::lerp(chosen->way[k], chosen->way[k + 1], steps - static_cast<double>(k));
}

}  // namespace spindrift
