#include "coupling/ground_surface.hpp"

#include <algorithm>
#include <cmath>

namespace spindrift {
namespace {

/// Normal height of the cover over `place`, linear between the centres of its bins [m].
template <int Dim>
double cover_height(const Cover<Dim>& cover, const Vec<Dim - 1>& place) {
  const Vec<Dim - 1> s = place / cover.bin_size - Vec<Dim - 1>::Constant(0.5);
  const GroundBin<Dim> base = ground_bin<Dim>(s, 1.0);
  double height = 0;
  for (int corner = 0; corner < 1 << (Dim - 1); ++corner) {
    GroundBin<Dim> bin = base;
    double weight = 1;
    for (int k = 0; k < Dim - 1; ++k) {
      const int bit = (corner >> k) & 1;
      const double fraction = s[k] - base[k];
      bin[k] += bit;
      weight *= bit ? fraction : 1 - fraction;
    }
    height += weight * cover.surface(bin);
  }
  return height;
}

}  // namespace

template <int Dim>
double GroundSurface<Dim>::distance_over(const Cover<Dim>& cover, const Near& near) const {
  return std::min(near.terrain_distance - cover_height<Dim>(cover, near.place), near.obstacle_distance);
}

template <int Dim>
GroundSurface<Dim>::GroundSurface(const Walls<Dim>& walls, const MacGrid<Dim>& grid, const Cover<Dim>* cover)
    : grid_(grid), reach_((cover ? cover->thickness : 0) + 3 * grid.dx), distance_(grid.nodes()) {
  for_each_index<Dim>(grid.nodes(), [&](const Index<Dim>& i) {
    const Vec<Dim> x = grid.node(i);
    double obstacle_distance = reach_;
    for (const Box<Dim>& obstacle : walls.obstacles)
      obstacle_distance = std::min(obstacle_distance, surface_of<Dim>(obstacle, x).distance);
    distance_[i] = obstacle_distance;
    if (!walls.terrain) return;
    const Foot<Dim> foot = walls.terrain->foot(x, reach_);
    distance_[i] = std::min(foot.distance, obstacle_distance);
    if (std::abs(foot.distance) < reach_)
      near_.push_back({flat<Dim>(i, grid.nodes()), foot.distance, obstacle_distance, foot.place, i[0]});
  });
  std::sort(near_.begin(), near_.end(),
            [](const Near& a, const Near& b) { return a.column != b.column ? a.column < b.column : a.node < b.node; });
  if (cover) follow(*cover);
}

template <int Dim>
void GroundSurface<Dim>::follow(const Cover<Dim>& cover) {
  for (const Near& near : near_) distance_[near.node] = distance_over(cover, near);
}

template <int Dim>
std::span<const Span> GroundSurface<Dim>::follow(const Cover<Dim>& cover, std::span<const Vec<Dim>> places) {
  // A node's cover is read up to two bins aside of its foot, and the foot lies up to the reach of near_ aside of it.
  const double aside = 2 * cover.bin_size + reach_;
  const auto column = [&](double x) {
    return static_cast<int>(std::clamp(std::floor((x - grid_.origin[0]) / grid_.dx), 0.0, grid_.cells[0] - 1.0));
  };
  moved_.clear();
  for (const Vec<Dim>& x : places) moved_.push_back({column(x[0] - aside), column(x[0] + aside) + 1});
  std::sort(moved_.begin(), moved_.end(), [](Span a, Span b) { return a.begin < b.begin; });
  std::size_t n = 0;
  for (const Span span : moved_) {
    if (n > 0 && span.begin <= moved_[n - 1].end + 2 * Ground<Dim>::reach) {
      moved_[n - 1].end = std::max(moved_[n - 1].end, span.end);
    } else {
      moved_[n++] = span;
    }
  }
  moved_.resize(n);
  for (const Span span : moved_) {
    const auto first = std::lower_bound(near_.begin(), near_.end(), span.begin,
                                        [](const Near& near, int c) { return near.column < c; });
    for (auto near = first; near != near_.end() && near->column <= span.end; ++near)
      distance_[near->node] = distance_over(cover, *near);
  }
  return moved_;
}

template class GroundSurface<2>;
template class GroundSurface<3>;

}  // namespace spindrift
