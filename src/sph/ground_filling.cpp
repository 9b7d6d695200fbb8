#include "sph/ground_filling.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/parallel.hpp"

namespace spindrift {
namespace {

/// A layer thinner than a particle is made from one of 2 d, of whose places every so manieth stays: a cut of a tile as
/// thin as that holds some per cent more or less of them than its volume.
double filled_thickness(const GroundLayer& layer) {
  return layer.thickness < layer.spacing ? 2 * layer.spacing : layer.thickness;
}

/// In strips as broad as places that stay are apart, up one and down the next, so that they stay evenly spread.
void sort_in_strips(std::vector<Vec<3>>& places, double breadth) {
  const auto key = [&](const Vec<3>& place) {
    const double strip = std::floor(place[0] / breadth);
    return std::pair{strip, std::fmod(strip, 2) == 0 ? place[1] : -place[1]};
  };
  std::stable_sort(places.begin(), places.end(), [&](const Vec<3>& a, const Vec<3>& b) { return key(a) < key(b); });
}

/// What of one stack of tiles, those over and under the one at `corner`, lies inside the layer.
/// phase  from 0 to 1, of the choice of places that stay
std::vector<FilledPlace> fill_stack(const HeightField& ground, const GroundLayer& layer, const Tile<3>& tile,
                                    const Vec<3>& corner, double phase,
                                    const std::function<bool(const Vec<2>&)>& accepts) {
  const double filled_by = filled_thickness(layer), top = layer.base + filled_by, period = tile.size[2];
  const double kept_share = layer.thickness / filled_by;
  const double pressed = std::min(layer.spacing / 4, layer.thickness / 20);
  const double share = (layer.thickness - 2 * pressed) / filled_by;
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
      const double before = std::floor(phase);
      phase += kept_share;
      if (kept_share < 1 && std::floor(phase) == before) continue;
      if (foot.normal[2] < least_cos_slope || !layer.extent.contains(foot.place) || !accepts(foot.place)) continue;
      foot.distance = layer.base + pressed + share * (foot.distance - layer.base);
      filled.push_back({ground.position(foot.place, foot.distance), foot});
    }
  }
  return filled;
}

}  // namespace

Plots::Plots(const GroundLayer& layer)
    : edge(tile_period<3> * layer.spacing),
      aside(layer.base + filled_thickness(layer)) {  // a place may lie as far aside of its foot as over it
  if (!(layer.thickness > 0) || !(layer.extent.size().minCoeff() > 0)) return;
  for (int k = 0; k < 2; ++k) {
    first[k] = static_cast<int>(std::floor((layer.extent.lower[k] - aside) / edge));
    shape[k] = static_cast<int>(std::floor((layer.extent.upper[k] + aside) / edge)) - first[k] + 1;
  }
}

GroundFilling::GroundFilling(const GroundLayer& layer) : layer_(layer), plots_(layer) {
  if (plots_.size() == 0) return;
  tile_ = relaxed_tile<3>(TileKind::volume, Vec<3>::Constant(plots_.edge), layer.spacing, layer.seed,
                          layer.relaxation_steps);
  if (filled_thickness(layer) > layer.thickness)
    sort_in_strips(tile_.places, std::sqrt(std::pow(layer.spacing, 3) / layer.thickness));
}

std::vector<FilledPlace> GroundFilling::fill(const HeightField& ground, std::size_t plot,
                                             const std::function<bool(const Vec<2>&)>& accepts) const {
  const Index<2> i = unflat<2>(plot, plots_.shape);
  const Vec<3>& size = tile_.size;
  Vec<3> corner = Vec<3>::Zero();
  for (int k = 0; k < 2; ++k) corner += (plots_.first[k] + i[k]) * tile_step<3>(TileKind::volume, size, k);
  const double steps = tile_step<3>(TileKind::volume, size, 0)[2] / size[2] * (plots_.first[0] + i[0]) +
                       tile_step<3>(TileKind::volume, size, 1)[2] / size[2] * (plots_.first[1] + i[1]);
  return fill_stack(ground, layer_, tile_, corner, steps - std::floor(steps), accepts);
}

std::vector<FilledPlace> fill_ground(const HeightField& ground, const GroundLayer& layer,
                                     const std::function<bool(const Vec<2>&)>& accepts) {
  const GroundFilling filling(layer);
  std::vector<std::vector<FilledPlace>> parts(filling.plots().size());
  parallel_for(
      parts.size(), [&](std::size_t plot) { parts[plot] = filling.fill(ground, plot, accepts); }, 1);
  std::vector<FilledPlace> filled;
  for (const auto& part : parts) filled.insert(filled.end(), part.begin(), part.end());
  return filled;
}

}  // namespace spindrift
