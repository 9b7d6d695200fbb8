#pragma once
/// Snow that lies on a height field between two normal distances from it.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <vector>

#include "core/memory.hpp"
#include "sph/tile.hpp"
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

/// Squares of places (x, y), side by side, plot by plot of which a layer is filled.
struct Plots {
  double edge = 0;   ///< [m]
  double aside = 0;  ///< how far out of its plot a filled place may have its foot [m]
  Index<2> first{};  ///< edge * first is the lower corner of all
  Index<2> shape{};  ///< how many; none for a layer of no extent or thickness

  explicit Plots(const GroundLayer& layer);

  std::size_t size() const { return count<2>(shape); }
  bool contains(const Vec<2>& place) const {
    for (int k = 0; k < 2; ++k)
      if (const int i = along(place[k], k); i < 0 || i >= shape[k]) return false;
    return true;
  }
  /// The number of the plot that contains `place`.
  std::size_t at(const Vec<2>& place) const { return flat<2>({along(place[0], 0), along(place[1], 1)}, shape); }
  /// Calls f(plot's number) for the plots that may have feet inside `box`, ascending.
  template <class F>
  void for_each_in(const Box<2>& box, F&& f) const {
    Index<2> lower, upper;
    for (int k = 0; k < 2; ++k) {
      lower[k] = along(box.lower[k] - aside, k);
      upper[k] = along(box.upper[k] + aside, k);
    }
    for (int j = std::max(lower[1], 0); j <= std::min(upper[1], shape[1] - 1); ++j)
      for (int i = std::max(lower[0], 0); i <= std::min(upper[0], shape[0] - 1); ++i) f(flat<2>({i, j}, shape));
  }

 private:
  int along(double place, int k) const {
    return static_cast<int>(std::clamp(std::floor(place / edge) - first[k], -1.0, static_cast<double>(shape[k])));
  }
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
/// A plot's places depend on nothing outside of it: they may be made at any time.
class GroundFilling {
 public:
  explicit GroundFilling(const GroundLayer& layer);

  const Plots& plots() const { return plots_; }
  std::size_t bytes() const { return spindrift::bytes(tile_.places); }
  /// accepts  says whether snow lies on a place (x, y) of the extent
  /// Cost: one height for every d^2 of the plot and 24 of a tile's rows, one foot for every place that is kept.
  std::vector<FilledPlace> fill(const HeightField& ground, std::size_t plot,
                                const std::function<bool(const Vec<2>&)>& accepts) const;

 private:
  GroundLayer layer_;
  Plots plots_;
  Tile<3> tile_;
};

/// All of a layer, plot by plot.
std::vector<FilledPlace> fill_ground(const HeightField& ground, const GroundLayer& layer,
                                     const std::function<bool(const Vec<2>&)>& accepts);

}  // namespace spindrift
