#pragma once
/// What other layers did to the grid in one step, listed point by point: only the points that took part are named.

#include <array>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

struct PointSource {
  std::size_t point;  ///< flat number of the face or cell
  double amount;
};

/// Equal and opposite to ParticleSources, see coupling. A face whose mass changes through `smoke` is always listed.
template <int Dim>
struct GridSources {
  std::array<std::vector<PointSource>, Dim> momentum;  ///< on the faces of each axis [kg m s^-1], no face twice
  std::vector<PointSource> smoke;                      ///< in cells [kg], no cell twice

  void clear() {
    for (auto& axis : momentum) axis.clear();
    smoke.clear();
  }
};

}  // namespace spindrift
