#include "sph/tile.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "sph/kd_tree.hpp"

namespace spindrift {
namespace {

constexpr double repulsion_radius = 1.1;             // of d: just above the spacing wanted, else the places clump
constexpr double first_step = 1.2, last_step = 0.2;  // of d: the push of a neighbour at no distance

double nearest(const Found& found) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& [j, squared] : found) least = std::min(least, squared);
  return std::sqrt(least);
}

/// `place` in the tile that many steps on along `axis`, among a volume's places at the heights of the tile.
template <int Dim>
Vec<Dim> image(Vec<Dim> place, TileKind kind, const Vec<Dim>& size, int axis, double steps) {
  constexpr int normal = Dim - 1;
  place += steps * tile_step<Dim>(kind, size, axis);
  if (kind == TileKind::volume && axis != normal)
    place[normal] -= size[normal] * std::floor(place[normal] / size[normal]);
  return place;
}

/// Appends the periodic images of the first n places that lie within `reach` of the tile, then in a layer, as walls
/// that repel, the mirror images of all in ground and surface. Returns the number of places without mirror images.
template <int Dim>
std::size_t add_images(std::vector<Vec<Dim>>& places, const Vec<Dim>& size, TileKind kind, double reach) {
  constexpr int normal = Dim - 1;
  for (int axis = 0; axis < (kind == TileKind::layer ? normal : Dim); ++axis) {
    const std::size_t n = places.size();
    for (std::size_t i = 0; i < n; ++i) {
      if (places[i][axis] < reach) places.push_back(image<Dim>(places[i], kind, size, axis, 1));
      if (places[i][axis] > size[axis] - reach) places.push_back(image<Dim>(places[i], kind, size, axis, -1));
    }
  }
  const std::size_t n = places.size();
  if (kind == TileKind::volume) return n;
  for (std::size_t i = 0; i < n; ++i) {
    Vec<Dim> mirrored = places[i];
    mirrored[normal] = -places[i][normal];
    if (places[i][normal] < reach) places.push_back(mirrored);
    mirrored[normal] = 2 * size[normal] - places[i][normal];
    if (places[i][normal] > size[normal] - reach) places.push_back(mirrored);
  }
  return n;
}

}  // namespace

template <int Dim>
Tile<Dim> relaxed_tile(TileKind kind, const Vec<Dim>& size, double d, std::uint64_t seed, int steps) {
  constexpr int normal = Dim - 1;
  Tile<Dim> tile{size, {}};
  const auto n = static_cast<std::size_t>(std::llround(size.prod() / std::pow(d, Dim)));
  const bool layer = kind == TileKind::layer;
  const double margin = layer ? std::min(d, size[normal]) / 2 : 0;
  const double reach = repulsion_radius * d;
  for (std::size_t slot = 0; slot < n; ++slot) {
    Vec<Dim> place;
    for (int axis = 0; axis < Dim; ++axis)
      place[axis] = size[axis] * uniform(seed, RandomStream::cover_sampling, slot, static_cast<std::uint32_t>(axis));
    place[normal] = margin + place[normal] / size[normal] * (size[normal] - 2 * margin);
    tile.places.push_back(place);
  }

  std::vector<Vec<Dim>> push(n), all;
  std::vector<double> distance(n);
  for (int step = 0; step < steps; ++step) {
    all = tile.places;
    const std::size_t n_real = add_images<Dim>(all, size, kind, reach);
    for_each_neighbourhood<Dim>(all, n, reach, [&](std::size_t i, Found& found) {
      push[i].setZero();
      for (const auto& [j, squared] : found) {
        const double r = std::sqrt(squared);
        if (r > 0) push[i] += (1 / r - 1 / reach) * (all[i] - all[j]);
      }
      std::erase_if(found, [n_real](const auto& other) { return other.first >= n_real; });
      distance[i] = std::min(nearest(found), reach);
    });
    if (parallel_sum(n, 0.0, [&](std::size_t i) { return distance[i]; }) >= static_cast<double>(n) * d) break;
    const double stride = d * std::lerp(first_step, last_step, static_cast<double>(step) / steps);
    for (std::size_t i = 0; i < n; ++i) {
      Vec<Dim>& place = tile.places[i];
      place += stride * push[i] / std::max(1.0, push[i].norm());
      for (int axis = 0; axis < (layer ? normal : Dim); ++axis)
        place = image<Dim>(place, kind, size, axis, -std::floor(place[axis] / size[axis]));
      if (layer) place[normal] = std::clamp(place[normal], margin, size[normal] - margin);
    }
  }
  std::sort(tile.places.begin(), tile.places.end(), [](const Vec<Dim>& a, const Vec<Dim>& b) {
    return std::lexicographical_compare(a.data(), a.data() + Dim, b.data(), b.data() + Dim);
  });
  return tile;
}

template Tile<2> relaxed_tile<2>(TileKind, const Vec<2>&, double, std::uint64_t, int);
template Tile<3> relaxed_tile<3>(TileKind, const Vec<3>&, double, std::uint64_t, int);

}  // namespace spindrift
