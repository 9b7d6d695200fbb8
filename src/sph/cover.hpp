#pragma once
/// The cover: resting snow on the ground that the avalanche may take up. Made by sample_cover.

#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "sph/cell_list.hpp"
#include "sph/ground_bins.hpp"
#include "sph/particles.hpp"
#include "terrain/terrain.hpp"

namespace spindrift {

/// Slots of resting particles. An entrained particle leaves a dead slot behind, of mass and volume 0.
/// State are particles, foot, hazard and laid; the rest is derived by index_cover and settle_surface.
template <int Dim>
struct Cover {
  double spacing = 0;         ///< d [m]
  double density = 0;         ///< rho_a [kg m^-3]
  double thickness = 0;       ///< initial depth, normal to the ground [m]
  double support_radius = 0;  ///< h of the flow above [m]; 0: at most 2 d
  bool in_plan = false;       ///< places are (x, y) of a height field

  Particles<Dim> particles;
  std::vector<Foot<Dim>> foot;  ///< of every slot, as sampled
  std::vector<double> hazard;   ///< integral of the rate of entrainment so far (R15) [-]
  std::size_t n_dead = 0;
  std::vector<std::uint8_t> laid;  ///< 1: the plots that SleepingCover has laid, one a plot; else empty
  /// Where ground goes on, in places [m]: beyond, the surface is taken to go on level.
  Vec<Dim - 1> ground_lower = Vec<Dim - 1>::Constant(-std::numeric_limits<double>::infinity());
  Vec<Dim - 1> ground_upper = Vec<Dim - 1>::Constant(std::numeric_limits<double>::infinity());

  CellList<Dim> cells{1};              ///< of the particles, of size h or 2 d, the larger; dead slots included
  double bin_size = 0;                 ///< 2 d [m]
  GroundBin<Dim> lower{}, shape{};     ///< the block of bins that holds all live slots
  std::vector<std::uint32_t> first;    ///< of each bin of the block in `members`, and the end
  std::vector<std::uint32_t> members;  ///< slots by bin, farthest from the ground first
  /// Unit normal of the smoothed surface at each slot's bin: of the plane through the surface of the bins around, by
  /// least squares. Relief finer than that plane's breadth is the friction law's affair.
  std::vector<Vec<Dim>> surface_normal;

  bool alive(std::size_t slot) const { return particles.volume[slot] > 0; }
  /// Depth below the initial surface [m].
  double initial_depth(std::size_t slot) const { return thickness - foot[slot].distance; }

  /// Slots that were live in `bin` at the last index_cover, farthest from the ground first.
  std::span<const std::uint32_t> slots_in(GroundBin<Dim> bin) const;
  /// Normal distance of the cover's surface from the ground [m]: of the farthest live particle in `bin`, plus d/2.
  /// 0 where no cover is left.
  double surface(const GroundBin<Dim>& bin) const;

  /// Area of the ground of `bin`, as its slots see it [m^(Dim-1)].
  double ground_area(const GroundBin<Dim>& bin) const;

  std::size_t bytes() const {
    return particles.bytes() + cells.bytes() + spindrift::bytes(foot) + spindrift::bytes(hazard) +
           spindrift::bytes(first, members) + spindrift::bytes(laid) + spindrift::bytes(surface_normal);
  }
};

/// Sorts the slots by cell and builds the bins from the live ones.
/// Throws Error(unstable): a position that is not finite or over 10^6 cells away.
template <int Dim>
void index_cover(Cover<Dim>& cover);

/// Bins on either side of a bin whose surface makes up its smoothed normal: 18 d in all.
constexpr int surface_reach = 4;

/// Finds the surface normals anew around `bins`, from which snow was taken. Cost: the bins within the reach.
template <int Dim>
void settle_surface(Cover<Dim>& cover, std::span<const GroundBin<Dim>> bins);

/// Makes the slot dead: mass and volume 0.
template <int Dim>
void remove_from_cover(Cover<Dim>& cover, std::size_t slot);

/// Once more than 1/8 of the slots are dead, drops them, keeps the order of the others, and indexes them anew.
/// Returns whether slots have new numbers.
template <int Dim>
bool compact_cover(Cover<Dim>& cover);

}  // namespace spindrift
