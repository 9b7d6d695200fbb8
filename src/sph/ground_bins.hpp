#pragma once
/// Bins of ground: squares of places, on which columns of snow stand.

#include <cmath>

#include "core/vec.hpp"

namespace spindrift {

template <int Dim>
using GroundBin = Index<Dim - 1>;

/// The bin of edge `size` [m] that holds `place` [m]. Places beyond 1e9 bins, and NaN, fall into the outermost.
template <int Dim>
GroundBin<Dim> ground_bin(const Vec<Dim - 1>& place, double size) {
  GroundBin<Dim> bin;
  for (int k = 0; k < Dim - 1; ++k) {
    const double b = std::floor(place[k] / size);
    bin[k] = static_cast<int>(b > -1e9 ? (b < 1e9 ? b : 1e9) : -1e9);
  }
  return bin;
}

/// Area of a bin's places [m^(Dim-1)]: that of its ground on a profile; on a height field its ground is 1 / n_z as
/// much.
template <int Dim>
double ground_bin_area(double size) {
  return Dim == 2 ? size : size * size;
}

template <int Dim>
Vec<Dim - 1> ground_bin_centre(const GroundBin<Dim>& bin, double size) {
  Vec<Dim - 1> centre;
  for (int k = 0; k < Dim - 1; ++k) centre[k] = (bin[k] + 0.5) * size;
  return centre;
}

/// Calls f(bin) for `bin` and the bins that touch it.
template <int Dim, class F>
void for_each_bin_around(const GroundBin<Dim>& bin, F&& f) {
  GroundBin<Dim> block;
  block.fill(3);
  for_each_index<Dim - 1>(block, [&](const GroundBin<Dim>& step) {
    GroundBin<Dim> near = bin;
    for (int k = 0; k < Dim - 1; ++k) near[k] += step[k] - 1;
    f(near);
  });
}

}  // namespace spindrift
