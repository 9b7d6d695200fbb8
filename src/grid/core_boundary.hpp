#pragma once
/// The dense core as a moving boundary of the air (R10).

#include <span>

#include "grid/cell_kind.hpp"
#include "grid/ground.hpp"
#include "grid/pressure_projection.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// A cell filled by the dense core.
template <int Dim>
struct CoreCell {
  Index<Dim> cell{};
  Vec<Dim> velocity = Vec<Dim>::Zero();  ///< in: mass-weighted velocity of the core's particles [m/s]
  double mass = 0;                       ///< in: their mass [kg]
  Vec<Dim> impulse = Vec<Dim>::Zero();   ///< out: of the air on the core in this step [kg m/s], for its particles
  double adhered = 0;                    ///< out: smoke [kg] that found no open neighbour to go to
  Vec<Dim> adhered_momentum = Vec<Dim>::Zero();  ///< out: what the grid lost with it [kg m/s]
};

template <int Dim>
class CoreBoundary {
 public:
  using Sides = std::array<std::array<Side, 2>, Dim>;

  explicit CoreBoundary(const Sides& sides) : sides_(sides) {}

  /// Smoke in core cells goes to open neighbours in proportion to the open area between, else it adheres: sets
  /// CoreCell::adhered and adhered_momentum. Returns the grid's gain of momentum [kg m/s].
  Vec<Dim> push_out_smoke(Field<Dim>& smoke, std::span<CoreCell<Dim>> cores, const FaceField<Dim>& u,
                          const Field<Dim, CellKind>& kind, const Ground<Dim>& ground) const;

  /// Faces of core cells take the common velocity of the core's snow and the air on its faces, between two core cells
  /// the mean; 0 unless `moving`. Closed faces stay, and so do faces between two pocket cells, whose air waits. Sets
  /// CoreCell::impulse to the momentum that the air loses by it, and returns the sum, the air's gain [kg m/s].
  Vec<Dim> set_velocity(FaceField<Dim>& u, std::span<CoreCell<Dim>> cores, const Field<Dim, CellKind>& kind,
                        const Field<Dim>& smoke, const Ground<Dim>& ground, bool moving);

  /// The core cells that yield to the air's pressure in the projection, with their mass.
  std::span<const HeavyCell<Dim>> heavy_cells(std::span<const CoreCell<Dim>> cores, const Field<Dim, CellKind>& kind);

  /// CoreCell::impulse += p A dt of the open cells next to it, into the core, less what the air on its yielding faces
  /// takes of it. Returns the sum [kg m/s].
  Vec<Dim> add_pressure(std::span<CoreCell<Dim>> cores, const PressureProjection<Dim>& projection,
                        const Field<Dim, CellKind>& kind, const Field<Dim>& smoke, const Ground<Dim>& ground,
                        double face_area, double dt, bool moving) const;

  std::size_t bytes() const { return core_number_.bytes() + spindrift::bytes(common_) + spindrift::bytes(heavy_); }

 private:
  Sides sides_;
  // Scratch:
  Field<Dim, std::uint32_t> core_number_;  ///< of core cells, elsewhere meaningless
  std::vector<Vec<Dim>> common_;           ///< velocity of a core cell's snow and air together [m/s]
  std::vector<HeavyCell<Dim>> heavy_;
};

}  // namespace spindrift
