#pragma once
/// Where an elevation model has heights: what lies in one of its holes counts as outside.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

class KnownGround {
 public:
  /// All of it.
  KnownGround() = default;

  /// first  (x, y) of the first point of a regular grid [m];  cell  between its points [m]
  /// known  of every point, x running fastest: whether it has a height
  KnownGround(const Vec<2>& first, double cell, const Index<2>& points, std::vector<std::uint8_t> known)
      : first_(first), cell_(cell), points_(points), known_(std::move(known)) {}

  /// Whether the point that is nearest to the place has a height.
  bool at(const Vec<2>& place) const {
    if (known_.empty()) return true;
    Index<2> point;
    for (int k = 0; k < 2; ++k)
      point[k] = static_cast<int>(std::clamp(std::round((place[k] - first_[k]) / cell_), 0.0, points_[k] - 1.0));
    return known_[flat<2>(point, points_)] != 0;
  }

 private:
  Vec<2> first_ = Vec<2>::Zero();
  double cell_ = 1;
  Index<2> points_{};
  std::vector<std::uint8_t> known_;  ///< empty: all
};

}  // namespace spindrift
