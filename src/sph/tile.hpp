#pragma once
/// Blocks of evenly spread places that repeat themselves: what the resting snow is stamped from.

#include <cstdint>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

template <int Dim>
struct Tile {
  Vec<Dim> size;                 ///< [m]
  std::vector<Vec<Dim>> places;  ///< from 0 to the size [m], in lexicographic order
};

enum class TileKind {
  layer,  ///< between ground and surface, d/2 off both: places (arc length[, y], normal distance); repeats along the
          ///< ground
  volume  ///< repeats along all axes
};

/// Edge of a tile along the axes in which it repeats, in spacings.
template <int Dim>
constexpr double tile_period = Dim == 2 ? 128 : 24;

/// From a tile to the next along an axis. Volumes stand side by side at heights apart by irrational shares of their
/// own, so that level ground does not cut all of them alike: one cut's share of the places is up to 2 % off.
template <int Dim>
Vec<Dim> tile_step(TileKind kind, const Vec<Dim>& size, int axis) {
  constexpr double share[2] = {0.7548776662466927, 0.5698402909980532};  // 1/p, 1/p^2, p^3 = p + 1
  Vec<Dim> step = size[axis] * Vec<Dim>::Unit(axis);
  if (kind == TileKind::volume && axis < Dim - 1) step[Dim - 1] = share[axis] * size[Dim - 1];
  return step;
}

/// Pseudo-random places of number density 1/d^Dim, relaxed by mutual repulsion until the mean distance of nearest
/// neighbours is d, or for `steps` steps. A function of its arguments alone.
template <int Dim>
Tile<Dim> relaxed_tile(TileKind kind, const Vec<Dim>& size, double d, std::uint64_t seed, int steps);

}  // namespace spindrift
