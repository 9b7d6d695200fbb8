#pragma once
/// Snow that lies on a height field between two normal distances from it.

#include <cstdint>
#include <functional>
#include <vector>

#include "terrain/height_field.hpp"

namespace spindrift {

struct GroundLayer {
  Box<2> extent{};       ///< of the places on which it lies [m]
  double base = 0;       ///< normal distance of its lower face [m]
  double thickness = 0;  ///< [m]
  double spacing = 0.1;  ///< d [m]
  std::uint64_t seed = 1;
  int relaxation_steps = 40;  ///< at most
};

struct FilledPlace {
  Vec<3> position;
  Foot<3> foot;
};

/// Ground steeper than this carries no snow: 84 degrees.
constexpr double least_cos_slope = 0.1;

/// The places of a relaxed volume tile (tile.hpp), stamped in space side by side along all axes, that lie inside the
/// layer: one in d^3 of it, evenly spread whatever the slope. (A layer tile stretched over steep ground would have
/// gaps.) A stretch of ground gets the same places whatever the layer's extent.
///   - Normal distances are pressed together from the layer's faces by e = min(d / 4, thickness / 20), so that the
///     farthest place of a few lies d / 2 below the surface in the mean: s -> e + s (1 - 2 e / thickness).
///   - A layer thinner than d has as many places as d^3 go into its volume, too: it is a choice of those of one of 2 d.
///   - A place belongs to the ground that is nearest. Of ground over 84 degrees there is none.
/// accepts  says whether snow lies on a place (x, y) of the extent
/// Cost: one height for every d^2 of the extent and 24 of a tile's rows, one foot for every place that is kept.
std::vector<FilledPlace> fill_ground(const HeightField& ground, const GroundLayer& layer,
                                     const std::function<bool(const Vec<2>&)>& accepts);

}  // namespace spindrift
