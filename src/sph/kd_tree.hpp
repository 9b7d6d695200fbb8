#pragma once
/// nanoflann's k-d tree over places.

#include <cstdint>
#include <nanoflann.hpp>
#include <span>

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

}  // namespace spindrift
