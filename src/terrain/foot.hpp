#pragma once
/// What a position sees of the ground.

#include <limits>

#include "core/vec.hpp"

namespace spindrift {

/// The nearest point of the ground's surface, as seen from a position.
template <int Dim>
struct Foot {
  double distance = 0;                        ///< signed distance [m], positive in the air
  Vec<Dim> normal = up<Dim>();                ///< unit normal out of the ground
  Vec<Dim - 1> place = Vec<Dim - 1>::Zero();  ///< where on the ground, as its Terrain tells places [m]
};

/// Of a position that sees no ground.
template <int Dim>
inline const Foot<Dim> nowhere{.distance = std::numeric_limits<double>::infinity()};

/// cos of the angle between a normal and the vertical.
template <int Dim>
double cos_slope(const Vec<Dim>& normal) {
  return normal[up_axis<Dim>];
}

}  // namespace spindrift
