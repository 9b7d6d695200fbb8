#pragma once
/// nanoflann's k-d tree over places.

#include <cstdint>
#include <nanoflann.hpp>
#include <span>
#include <utility>
#include <vector>

#include "core/parallel.hpp"
#include "core/vec.hpp"

namespace spindrift {

/// Places as nanoflann asks for them; they must outlive the tree.
template <int Dim>
struct Points {
  std::span<const Vec<Dim>> positions;
  std::size_t kdtree_get_point_count() const { return positions.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return positions[i][static_cast<Eigen::Index>(axis)]; }
  template <class Bounds>
  bool kdtree_get_bbox(Bounds&) const {
    return false;
  }
};

template <int Dim>
using Tree = nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Points<Dim>>, Points<Dim>, Dim,
                                                 std::uint32_t>;
constexpr std::size_t tree_leaf = 16;

/// Neighbours of a place: number and squared distance [m^2].
using Found = std::vector<std::pair<std::uint32_t, double>>;

/// Calls f(i, found) for the first n of `positions`, with all others within `radius` [m].
template <int Dim, class F>
void for_each_neighbourhood(std::span<const Vec<Dim>> positions, std::size_t n, double radius, F&& f) {
  const Points<Dim> points{positions};
  const Tree<Dim> tree(Dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(tree_leaf));
  const nanoflann::SearchParams unsorted(0, 0, false);
  auto body = [&](std::size_t begin, std::size_t end) {
    Found found;
    for (std::size_t i = begin; i < end; ++i) {
      tree.radiusSearch(positions[i].data(), radius * radius, found, unsorted);
      std::erase_if(found, [i](const auto& other) { return other.first == i; });
      f(i, found);
    }
  };
  parallel_blocks(n, 256, body);
}

}  // namespace spindrift
