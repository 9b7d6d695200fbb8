#include "coupling/ground_surface.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"

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

/// The box as nodes can see it: one that stands between two planes of nodes reaches to the nearer, so that it closes
/// the faces there.
template <int Dim>
Box<Dim> seen_by_nodes(Box<Dim> box, const MacGrid<Dim>& grid) {
  constexpr double beyond = 1e-6;  // of a cell: the plane lies inside, however the distances round
  for (int k = 0; k < Dim; ++k) {
    const double lower = (box.lower[k] - grid.origin[k]) / grid.dx, upper = (box.upper[k] - grid.origin[k]) / grid.dx;
    if (std::ceil(lower + beyond) <= upper - beyond) continue;
    const double plane = std::round((lower + upper) / 2);
    box.lower[k] = grid.origin[k] + grid.dx * std::min(lower, plane - beyond);
    box.upper[k] = grid.origin[k] + grid.dx * std::max(upper, plane + beyond);
  }
  return box;
}

}  // namespace

template <int Dim>
double GroundSurface<Dim>::distance_over(const Cover<Dim>& cover, const Near& near) const {
  return std::min(near.terrain_distance - cover_height<Dim>(cover, near.place), near.obstacle_distance);
}

template <int Dim>
GroundSurface<Dim>::GroundSurface(const Walls<Dim>& walls, const MacGrid<Dim>& grid, const Cover<Dim>* cover)
    : grid_(grid), reach_(reach(cover, grid.dx)), distance_(grid.nodes()) {
  look_at(walls, [](const Index<Dim>&) { return true; });
  if (cover) follow(*cover);
}

template <int Dim>
void GroundSurface<Dim>::move_window(const Walls<Dim>& walls, const MacGrid<Dim>& window, const Cover<Dim>* cover) {
  const Index<Dim> shape = window.nodes(), old_shape = grid_.nodes();
  Index<Dim> shift;
  for (int k = 0; k < Dim; ++k) shift[k] = window.lower[k] - grid_.lower[k];
  const auto moved = [&](Index<Dim> node, int sign) {
    for (int k = 0; k < Dim; ++k) node[k] += sign * shift[k];
    return node;
  };
  const Field<Dim> old_distance = std::exchange(distance_, Field<Dim>(shape));
  const std::vector<Near> old_near = std::exchange(near_, {});
  grid_ = window;
  for (Near near : old_near) {
    const Index<Dim> node = moved(unflat<Dim>(near.node, old_shape), -1);
    if (!inside<Dim>(node, shape)) continue;
    near.node = flat<Dim>(node, shape), near.column = node[0];
    near_.push_back(near);
  }
  for_each_index<Dim>(shape, [&](const Index<Dim>& node) {
    const Index<Dim> old = moved(node, 1);
    if (inside<Dim>(old, old_shape)) distance_[node] = old_distance[old];
  });
  look_at(walls, [&](const Index<Dim>& node) { return !inside<Dim>(moved(node, 1), old_shape); });
  if (cover) follow(*cover);
}

/// Sets distances and near_ at the nodes that are new.
template <int Dim>
template <class F>
void GroundSurface<Dim>::look_at(const Walls<Dim>& walls, F&& is_new) {
  const Index<Dim> shape = grid_.nodes();
  Index<Dim> layer = shape;
  layer[Dim - 1] = 1;
  std::vector<Box<Dim>> obstacles;
  for (const Box<Dim>& obstacle : walls.obstacles) obstacles.push_back(seen_by_nodes<Dim>(obstacle, grid_));
  std::vector<std::vector<Near>> found(static_cast<std::size_t>(shape[Dim - 1]));
  const auto look = [&](std::size_t height) {
    for_each_index<Dim>(layer, [&](Index<Dim> i) {
      i[Dim - 1] = static_cast<int>(height);
      if (!is_new(i)) return;
      const Vec<Dim> x = grid_.node(i);
      double obstacle_distance = reach_;
      for (const Box<Dim>& obstacle : obstacles)
        obstacle_distance = std::min(obstacle_distance, surface_of<Dim>(obstacle, x).distance);
      distance_[i] = obstacle_distance;
      if (!walls.terrain) return;
      const Foot<Dim> foot = walls.terrain->foot(x, reach_);
      distance_[i] = std::min(foot.distance, obstacle_distance);
      if (std::abs(foot.distance) < reach_)
        found[height].push_back({flat<Dim>(i, shape), foot.distance, obstacle_distance, foot.place, i[0]});
    });
  };
  parallel_for(found.size(), look, 1);
  for (const std::vector<Near>& of_layer : found) near_.insert(near_.end(), of_layer.begin(), of_layer.end());
  near_.shrink_to_fit();
  std::sort(near_.begin(), near_.end(),
            [](const Near& a, const Near& b) { return a.column != b.column ? a.column < b.column : a.node < b.node; });
}

template <int Dim>
void GroundSurface<Dim>::follow(const Cover<Dim>& cover) {
  for (const Near& near : near_) distance_[near.node] = distance_over(cover, near);
}

template <int Dim>
std::span<const Span> GroundSurface<Dim>::follow(const Cover<Dim>& cover, std::span<const Vec<Dim>> places) {
  const double aside = sees_aside(cover, grid_.dx);
  const auto column = [&](double x) {
    return static_cast<int>(
        std::clamp(std::floor((x - grid_.origin[0]) / grid_.dx) - grid_.lower[0], 0.0, grid_.cells[0] - 1.0));
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
