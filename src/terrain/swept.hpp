#pragma once
/// Where something that moves meets a solid box on its way, however far it goes and however thin the box is.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "core/vec.hpp"

namespace spindrift {

template <int Dim>
struct BoxHit {
  double place = 0;   ///< of the face that is met, along its axis [m]
  Vec<Dim> normal{};  ///< unit normal of that face, out of the box
};

/// The face by which the straight way from `from` to `to` enters the box; none where it does not, or begins inside.
/// Source: Kay and Kajiya 1986, slabs.
template <int Dim>
std::optional<BoxHit<Dim>> entry_into(const Box<Dim>& box, const Vec<Dim>& from, const Vec<Dim>& to) {
  constexpr double rounding = 1e-9;  // of the box: what lies on a face is outside
  double enter = -std::numeric_limits<double>::infinity(), leave = 1;
  int axis = -1;
  for (int k = 0; k < Dim; ++k) {
    const double way = to[k] - from[k];
    if (way == 0) {
      if (from[k] <= box.lower[k] || from[k] >= box.upper[k]) return std::nullopt;
      continue;
    }
    const double near = ((way > 0 ? box.lower[k] : box.upper[k]) - from[k]) / way;
    if (near > enter) enter = near, axis = k;
    leave = std::min(leave, ((way > 0 ? box.upper[k] : box.lower[k]) - from[k]) / way);
  }
  if (axis < 0 || enter >= leave) return std::nullopt;
  const double way = to[axis] - from[axis];
  if (enter * std::abs(way) < -rounding * box.size()[axis]) return std::nullopt;
  return BoxHit<Dim>{way > 0 ? box.lower[axis] : box.upper[axis], (way > 0 ? -1.0 : 1.0) * Vec<Dim>::Unit(axis)};
}

}  // namespace spindrift
