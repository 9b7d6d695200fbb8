#pragma once
/// Depth and speed of the dense flow along x or outwards, as shallow-water theory sees it.

#include <cmath>
#include <numbers>
#include <vector>

#include "simulation/simulation.hpp"

namespace spindrift {

/// The flow over one interval of x, or over a ring of radii.
struct DepthBin {
  double x = 0;      ///< its middle [m]
  double depth = 0;  ///< rest volume over width or area [m]
  double speed = 0;  ///< mean velocity along x or outwards, by volume [m s^-1]
};

/// In 2D in intervals of `width` [m] from the left side of the domain on, in 3D in quarters of rings around the
/// domain's lower left corner, which is the axis of what stands between two walls.
template <int Dim>
std::vector<DepthBin> depth_profile(const Simulation<Dim>& simulation, double width) {
  const Particles<Dim>& p = simulation.dense()->particles;
  const Box<Dim>& domain = simulation.walls().domain;
  std::vector<DepthBin> bins(static_cast<std::size_t>(std::ceil((Dim - 1) * domain.size()[0] / width)));
  for (std::size_t b = 0; b < bins.size(); ++b)
    bins[b].x = (Dim == 2 ? domain.lower[0] : 0) + (static_cast<double>(b) + 0.5) * width;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<Dim - 1> place = (p.position[i] - domain.lower).template head<Dim - 1>();
    const double distance = place.norm();
    const double outwards = p.velocity[i].template head<Dim - 1>().dot(place.normalized());
    DepthBin& bin = bins.at(static_cast<std::size_t>(distance / width));
    const double area = Dim == 2 ? width : width * bin.x * std::numbers::pi / 2;
    bin.depth += p.volume[i] / area;
    bin.speed += p.volume[i] / area * outwards;
  }
  for (DepthBin& bin : bins)
    if (bin.depth > 0) bin.speed /= bin.depth;
  return bins;
}

}  // namespace spindrift
