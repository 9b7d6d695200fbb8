#include "sph/ground_filling.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"
#include "sph/tile.hpp"

namespace spindrift {
namespace {

/// What of one stack of tiles, those over and under the one at `corner`, lies inside the layer.
std::vector<FilledPlace> fill_stack(const HeightField& ground, const GroundLayer& layer, const Tile<3>& tile,
                                    const Vec<3>& corner, const std::function<bool(const Vec<2>&)>& accepts) {
  const double top = layer.base + layer.thickness, period = tile.size[2];
  const double pressed = std::min(layer.spacing / 4, layer.thickness / 20);
  const double share = 1 - 2 * pressed / layer.thickness;
  std::vector<FilledPlace> filled;
  for (const Vec<3>& place : tile.places) {
    Vec<3> x = corner + place;
    const double lowest = x[2], below = ground.height(x.head<2>());
    // A normal distance s lies between heights s and s / cos of the steepest slope over the ground.
    const double highest = below + top * ground.lipschitz();
    for (double n = std::ceil((below + layer.base - lowest) / period); lowest + n * period < highest; ++n) {
      x[2] = lowest + n * period;
      Foot<3> foot = ground.foot(x, top);
      if (!(foot.distance > layer.base) || !(foot.distance < top)) continue;
      if (foot.normal[2] < least_cos_slope || !layer.extent.contains(foot.place) || !accepts(foot.place)) continue;
      foot.distance = layer.base + pressed + share * (foot.distance - layer.base);
      filled.push_back({ground.position(foot.place, foot.distance), foot});
    }
  }
  return filled;
}

}  // namespace

std::vector<FilledPlace> fill_ground(const HeightField& ground, const GroundLayer& layer,
                                     const std::function<bool(const Vec<2>&)>& accepts) {
  std::vector<FilledPlace> filled;
  if (!(layer.thickness > 0) || !(layer.extent.size().minCoeff() > 0)) return filled;
  const Vec<3> size = Vec<3>::Constant(tile_period<3> * layer.spacing);
  const Tile<3> tile = relaxed_tile<3>(TileKind::volume, size, layer.spacing, layer.seed, layer.relaxation_steps);
  // A place may lie as far aside of its foot as over it.
  const double aside = layer.base + layer.thickness;
  Index<2> first, stacks;
  for (int k = 0; k < 2; ++k) {
    first[k] = static_cast<int>(std::floor((layer.extent.lower[k] - aside) / size[k]));
    stacks[k] = static_cast<int>(std::floor((layer.extent.upper[k] + aside) / size[k])) - first[k] + 1;
  }
  std::vector<std::vector<FilledPlace>> parts(count<2>(stacks));
  parallel_for(
      parts.size(),
      [&](std::size_t n) {
        const Index<2> i = unflat<2>(n, stacks);
        Vec<3> corner = Vec<3>::Zero();
        for (int k = 0; k < 2; ++k) corner += (first[k] + i[k]) * tile_step<3>(TileKind::volume, size, k);
        parts[n] = fill_stack(ground, layer, tile, corner, accepts);
      },
      1);
  for (const auto& part : parts) filled.insert(filled.end(), part.begin(), part.end());
  return filled;
}

}  // namespace spindrift
