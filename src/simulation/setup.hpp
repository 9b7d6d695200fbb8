#pragma once
/// From a scene's numbers to the things that the step works on. Absent sections give empty optionals.

#include <optional>

#include "coupling/drag_lift.hpp"
#include "coupling/smoke_exchange.hpp"
#include "entrainment/entrainment.hpp"
#include "grid/active_tiles.hpp"
#include "grid/suspension.hpp"
#include "simulation/scene.hpp"
#include "sph/bed_friction.hpp"
#include "sph/cover.hpp"
#include "sph/dense_flow.hpp"
#include "sph/sleeping_cover.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

template <int Dim>
Vec<Dim> make_gravity(const Scene& scene);

/// Terrain and closed sides.   Throws Error(bad_input): numbers that describe no ground.
template <int Dim>
Walls<Dim> make_walls(const Scene& scene);

/// The cover at rest, ids from `first_id`, on a height field without particles yet; empty without [cover].
template <int Dim>
std::optional<Cover<Dim>> make_cover(const Scene& scene, const Walls<Dim>& walls, std::uint64_t first_id);

/// Where the cover of a height field lies; empty without [cover] and on a profile.
std::optional<CoverArea> make_cover_area(const Scene& scene, const Walls<3>& walls);

/// Whether cover of a height field is laid only where flow or air come near: nothing looks at all of it.
bool cover_sleeps(const Scene& scene);

/// What lays the cover of a height field; empty without [cover] and on a profile.
std::optional<SleepingCover> make_sleeping_cover(const Scene& scene, const Walls<3>& walls);

/// The dense flow with the released snow in it, ids from 0; empty without [dense_flow].
template <int Dim>
std::optional<DenseFlow<Dim>> make_dense_flow(const Scene& scene, const Walls<Dim>& walls);

/// The grid of the whole domain.   Pre: the scene has a suspension.
template <int Dim>
MacGrid<Dim> make_grid(const Scene& scene, const Walls<Dim>& walls);

/// What chooses the part of the grid that is computed; empty without [suspension.tiles].
template <int Dim>
std::optional<ActiveTiles<Dim>> make_tiles(const Scene& scene, const Walls<Dim>& walls);

/// The air as it begins, without smoke.   Pre: the scene has a suspension.
/// grid, sides: the domain's, or those of a window in it
template <int Dim>
Suspension<Dim> make_suspension(const Scene& scene, const Walls<Dim>& walls, const MacGrid<Dim>& grid,
                                const typename Suspension<Dim>::Sides& sides);

/// Friction of the bed; empty where it acts on nothing.
std::optional<BedFriction> make_bed_friction(const Scene& scene);

/// What the coupling needs, each term only where its section is there.
struct CouplingOptions {
  double overlap_fraction = 0.8;
  double air_density = 1.2;  ///< [kg m^-3]
  std::optional<ForceOptions> drag, lift;
  SmokeOptions smoke;
};

/// Empty where no term of [coupling] is there.
std::optional<CouplingOptions> make_coupling(const Scene& scene);

std::optional<EntrainmentOptions> make_entrainment(const Scene& scene);

}  // namespace spindrift
