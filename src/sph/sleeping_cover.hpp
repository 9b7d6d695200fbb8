#pragma once
/// Cover on a height field that nothing has come near yet: where it lies, in place of particles.

#include <span>
#include <vector>

#include "sph/ground_filling.hpp"
#include "sph/sampling.hpp"

namespace spindrift {

/// Where a cover on a height field lies, asleep, awake or taken.
struct CoverArea {
  Box<2> extent;  ///< of its places (x, y) [m]
  std::function<bool(const Vec<2>&)> accepts;
  double depth = 0;  ///< [m]
  Plots plots;

  CoverArea(const CoverLayer& layer, double spacing);
  bool contains(const Vec<2>& place) const { return extent.contains(place) && accepts(place); }

  /// Particle n of plot p has the id (p + 1) 2^32 + n; released snow, of which there is less, has none as high.
  static std::uint64_t id(std::size_t plot, std::size_t n) { return (std::uint64_t{plot} + 1 << 32) + n; }
  /// The plot from which a particle came; -1 for released snow.
  static std::int64_t plot_of(std::uint64_t id) { return static_cast<std::int64_t>(id >> 32) - 1; }
};

/// A cover in plots, of which each is laid when something comes near: its particles are made from the seed and the
/// plot's place alone, sorted and numbered by plot, so that what is laid is the same whenever that was.
/// Memory: one byte a plot of 24 d x 24 d, and one tile of particles.
class SleepingCover {
 public:
  /// Nothing lies within d/2 of `obstacles`.
  SleepingCover(const CoverLayer& layer, const SnowKind<3>& kind, std::span<const Box<3>> obstacles = {});

  /// How far from a particle of the flow cover may count in a step [m]: up to the bins whose surface makes up the
  /// normals of cover within the support radius of it.
  static double reach(double spacing, double support_radius) {
    return 2 * (surface_reach + 1) * spacing + support_radius + spacing;
  }

  /// Whether a plot that may have places inside `box` is not laid in `cover` yet.
  bool asleep(const Cover<3>& cover, const Box<2>& box) const;
  /// Sets to 1 what in `called`, which has an entry a plot, may have places inside `box`.
  void call(const Box<2>& box, std::vector<std::uint8_t>& called) const;
  /// Lays all plots that are called and not laid yet, and indexes the cover anew. Returns the number of particles.
  /// Cost: one look at every plot, and where something is laid, that of index_cover.
  std::size_t wake(Cover<3>& cover, const HeightField& ground, const std::vector<std::uint8_t>& called) const;
  std::size_t wake_all(Cover<3>& cover, const HeightField& ground) const;

  const Plots& plots() const { return filling_.plots(); }
  std::size_t bytes() const;

 private:
  CoverArea area_;
  SnowKind<3> kind_;
  std::vector<Box<3>> obstacles_;
  GroundFilling filling_;
};

}  // namespace spindrift
