#pragma once
/// Where particles are at the start: the cover, sampled and relaxed (paper Sec. 4.5), and the snow that is released, on
/// lattices.

#include <cstdint>
#include <functional>
#include <limits>
#include <span>

#include "sph/cover.hpp"
#include "sph/ground_filling.hpp"
#include "sph/particles.hpp"
#include "terrain/obstacle.hpp"
#include "terrain/terrain.hpp"

namespace spindrift {

/// An interval across the slope [m]; meaningless in 2D.
struct Breadth {
  double from = 0, to = 0;
};

/// What all particles of one origin have in common.
template <int Dim>
struct SnowKind {
  double spacing = 0.105;                ///< d [m]
  double density = 300;                  ///< [kg m^-3]; each particle has volume d^Dim and mass density d^Dim
  Vec<Dim> velocity = Vec<Dim>::Zero();  ///< [m s^-1]
  std::uint64_t first_id = 0;            ///< ids count up from here
};

struct CoverLayer {
  double from = 0, to = 0;  ///< arc length along the ground, on a height field x [m]
  /// The same, where the ground itself begins and ends [m]; an end of the cover that is not the ground's is a rim.
  double ground_from = -std::numeric_limits<double>::infinity();
  double ground_to = std::numeric_limits<double>::infinity();
  Breadth y{};           ///< in 3D
  double depth = 0.525;  ///< normal to the ground [m]
  std::uint64_t seed = 1;
  int relaxation_steps = 40;  ///< at most
  double support_radius = 0;  ///< h of the flow above [m]; 0: at most 2 d
  /// On a height field, which places (x, y) carry it, and a box around all of these [m]; none: all do.
  std::function<bool(const Vec<2>&)> accepts{};
  Box<2> within{Vec<2>::Constant(-std::numeric_limits<double>::infinity()),
                Vec<2>::Constant(std::numeric_limits<double>::infinity())};
};

/// Adds a particle of a kind at x.
template <int Dim>
void append(Particles<Dim>& particles, const Vec<Dim>& x, const SnowKind<Dim>& kind, std::uint64_t id);

/// Of a layer, without a particle yet.
template <int Dim>
Cover<Dim> bare_cover(const CoverLayer& layer, const SnowKind<Dim>& kind);

/// The cover: pseudo-random places of number density 1/d^Dim in (arc length, y, normal distance), relaxed by mutual
/// repulsion until the mean distance of nearest neighbours is d, and laid on the ground piece by piece from one such
/// tile, so that a stretch of ground gets the same places whatever the cover's extent.
///   - Centres keep d/2 off ground and surface; a layer thinner than 2 d keeps its mass rather than its spacing.
///   - Where the ground is concave, a place belongs to the piece of ground that is nearest; of two particles closer
///     than 0.7 d the later is left out (R22). Ground over 84 degrees (a cliff's face) carries no cover.
///   - Nothing lies within d/2 of `obstacles`.
/// On a height field, where from, to and y are those of places (x, y), the layer is filled from a volume tile instead,
/// as SleepingCover does that is woken as a whole; its mass per area of ground is density times depth, to 1 % on the
/// whole.
/// Returns at-rest particles, entrained_at = -1, ids from kind.first_id up, on a height field those of SleepingCover.
/// Empty for depth 0 or to <= from. Throws Error(bad_input): spacing not positive, a number that is not finite. Source:
/// paper Sec. 4.5.  Departure: R22.
template <int Dim>
Cover<Dim> sample_cover(const Terrain<Dim>& terrain, const CoverLayer& layer, const SnowKind<Dim>& kind,
                        std::span<const Box<Dim>> obstacles = {});

/// A slab on the ground or on the cover.
struct Slab {
  double at = 0;         ///< arc length of its upper end [m]
  double length = 0;     ///< along the ground [m]
  double base = 0;       ///< normal distance of its lower face from the ground [m]: the cover's depth
  double thickness = 0;  ///< [m]
  Breadth y{};           ///< in 3D
};

/// A slab as a lattice in (arc length, y, normal distance): round(length/d) x round(breadth/d) x round(thickness/d).
template <int Dim>
Particles<Dim> sample_slab(const Terrain<Dim>& terrain, const Slab& slab, const SnowKind<Dim>& kind);

/// Snow on the places of a height field that `accepts`, as evenly spread as cover.
Particles<3> sample_area(const HeightField& ground, const GroundLayer& layer, const SnowKind<3>& kind,
                         const std::function<bool(const Vec<2>&)>& accepts);

/// An axis-aligned box as a lattice of round(size/d) particles an axis.
template <int Dim>
Particles<Dim> sample_box(const Box<Dim>& box, const SnowKind<Dim>& kind);

/// Distances of the particles' nearest neighbours [m]. For fewer than two particles: infinite.
struct NearestNeighbours {
  double mean = std::numeric_limits<double>::infinity();
  double least = std::numeric_limits<double>::infinity();
};

template <int Dim>
NearestNeighbours nearest_neighbours(std::span<const Vec<Dim>> positions);

}  // namespace spindrift
