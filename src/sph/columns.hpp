#pragma once
/// Columns of dense flow: the particles over each bin of ground, for the depth-averaged laws of friction and
/// entrainment. Cost and memory follow the dense particles, not the ground.

#include <cstdint>
#include <span>
#include <vector>

#include "sph/cover.hpp"
#include "sph/ground_bins.hpp"
#include "sph/particles.hpp"
#include "terrain/terrain.hpp"

namespace spindrift {

/// Snow that stands on one bin of ground. A particle belongs to the column if no air gap wider than the support radius
/// lies between the bed and it (R18); what flies above such a gap is over the bin but not in the column.
template <int Dim>
struct Column {
  GroundBin<Dim> bin{};
  double area = 0;                       ///< A, of its ground [m^(Dim-1)]
  double bed = 0;                        ///< normal distance of the bed from the ground [m]: the cover's surface, or 0
  double thickness = 0;                  ///< h_flow = sum V / A, at least d/8 [m]; 0: nothing stands on the bed
  double mass_per_area = 0;              ///< sum m / A [kg m^-2]
  Vec<Dim> velocity = Vec<Dim>::Zero();  ///< of the column's centre of mass [m s^-1]
  Vec<Dim> friction =
      Vec<Dim>::Zero();              ///< impulse that the bed took from it in this step [kg m s^-1] (bed_friction.hpp)
  std::uint32_t first = 0, end = 0;  ///< in Columns::members: all particles over the bin
  std::uint32_t end_standing = 0;    ///< [first, end_standing): those of the column
};

template <int Dim>
struct Columns {
  double bin_size = 0;                 ///< 2 d [m]
  std::span<const Foot<Dim>> foot;     ///< of every dense particle: of DenseFlow, or whoever found them
  std::vector<std::uint32_t> column;   ///< of every dense particle: its number in `columns`
  std::vector<Column<Dim>> columns;    ///< only bins that hold dense particles, in order of first appearance
  std::vector<std::uint32_t> members;  ///< dense particles by column, nearest to the ground first, ties by id

  /// The column over `bin`; null where there is no dense flow.
  const Column<Dim>* find(const GroundBin<Dim>& bin) const;
  /// Particles over the bin, and those of them that stand on the bed.
  std::span<const std::uint32_t> over_bin(const Column<Dim>& c) const {
    return {members.data() + c.first, c.end - c.first};
  }
  std::span<const std::uint32_t> standing(const Column<Dim>& c) const {
    return {members.data() + c.first, c.end_standing - c.first};
  }

  std::size_t bytes() const {
    return spindrift::bytes(column, members, table) + spindrift::bytes(columns) + spindrift::bytes(heights);
  }

  struct Height {
    double distance;
    std::uint32_t particle;
  };
  std::vector<std::uint32_t> table;  ///< open-addressed: number of a column + 1, or 0
  std::vector<Height> heights;       ///< scratch: members with what they are sorted by
};

/// Sorts the dense particles into columns over bins of edge 2 d.
/// columns         out; it refers to `feet`
/// feet            in: of the terrain, one a particle
/// dense           in: V > 0
/// cover           in: may be null (bare ground)
/// spacing         d [m]
/// support_radius  h [m], the widest air gap that a column bridges
/// Source: paper Sec. 4.3 has no bed friction.  Departure: R18.
template <int Dim>
void build_columns(Columns<Dim>& columns, const Terrain<Dim>& terrain, std::span<const Foot<Dim>> feet,
                   const Particles<Dim>& dense, const Cover<Dim>* cover, double spacing, double support_radius);

}  // namespace spindrift
