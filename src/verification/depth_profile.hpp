#pragma once
/// Depth and speed of the dense flow along x, as shallow-water theory sees it.

#include <cmath>
#include <vector>

#include "simulation/simulation.hpp"

namespace spindrift {

/// The flow over one interval of x.
struct DepthBin {
  double x = 0;      ///< its middle [m]
  double depth = 0;  ///< rest volume over width [m]
  double speed = 0;  ///< mean velocity along x, by volume [m s^-1]
};

/// In intervals of `width` [m] from the left side of the domain on.
inline std::vector<DepthBin> depth_profile(const Simulation<2>& simulation, double width) {
  const Particles<2>& p = simulation.dense()->particles;
  const Box<2>& domain = simulation.walls().domain;
  std::vector<DepthBin> bins(static_cast<std::size_t>(std::ceil(domain.size()[0] / width)));
  for (std::size_t b = 0; b < bins.size(); ++b) bins[b].x = domain.lower[0] + (static_cast<double>(b) + 0.5) * width;
  for (std::size_t i = 0; i < p.size(); ++i) {
    DepthBin& bin = bins.at(static_cast<std::size_t>((p.position[i][0] - domain.lower[0]) / width));
    bin.depth += p.volume[i] / width;
    bin.speed += p.volume[i] / width * p.velocity[i][0];
  }
  for (DepthBin& bin : bins)
    if (bin.depth > 0) bin.speed /= bin.depth;
  return bins;
}

}  // namespace spindrift
