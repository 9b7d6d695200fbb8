#pragma once
/// Conservative transport of smoke mass (R7): what leaves a cell enters its neighbour, and no cell becomes negative.

#include <array>
#include <vector>

#include "grid/small_cells.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

struct SmokeFlow {
  double outflow = 0;    ///< through open sides [kg]
  double deposited = 0;  ///< settled on the ground and on closed sides [kg]
  int substeps = 0;
};

template <int Dim>
class SmokeTransport {
 public:
  SmokeTransport(const MacGrid<Dim>& grid, const std::array<std::array<Side, 2>, Dim>& sides);

  /// Flux form, one axis after the other, with the volume that each sweep takes from and gives to a cell tracked beside
  /// its mass, so that uniform smoke in a divergence-free flow stays uniform. Face values are third order in space and
  /// time, limited by the neighbours and by what the donor holds (ULTIMATE QUICKEST, Leonard 1991): no new extrema
  /// along an axis, and m >= 0. Air that enters through open sides is clean.
  ///   m_i' = m_i - dt sum_f rho_f (u_f + w) . A_f,   w = settling velocity
  /// Sub-cycled until no cell's outflow exceeds its open volume. Small cells and their roots
  /// (SmallCells) lend each other volume within the step and share their smoke after it.
  /// With a settling velocity, smoke above ground or a closed side is deposited:
  ///   m' = m / (1 + dt w . A_ground / V),   A_ground = difference of the cell's open areas
  /// smoke      in-out: [kg]
  /// u          in: face velocities [m/s]
  /// flow_area  in: area that lets smoke through [m^(Dim-1)], 0 on closed and fixed faces
  /// settling   in: velocity of smoke relative to the air [m/s]
  SmokeFlow advance(Field<Dim>& smoke, const FaceField<Dim>& u, const FaceField<Dim>& flow_area,
                    const Ground<Dim>& ground, const Vec<Dim>& settling, double dt);

  std::size_t bytes() const;

 private:
  /// The volumes that cross a face of `axis` in the sweep.
  struct Flow {
    const FaceField<Dim>& u;
    const FaceField<Dim>& flow_area;
    Vec<Dim> settling;
    double dt;
    template <class T>
    T through(int axis, std::size_t face) const;
  };

  bool find_spans(const Field<Dim>& smoke);
  void widen_spans(int axis);
  void find_surroundings();
  double largest_outflow(const Flow& flow, const Ground<Dim>& ground);
  void start_substep(const Field<Dim>& smoke);
  void set_flux(int axis, const Flow& flow);
  void update(int axis, Field<Dim>& smoke, const Flow& flow);
  double outflow(int axis) const;
  double deposit(Field<Dim>& smoke, const Ground<Dim>& ground, const Vec<Dim>& settling, double dt) const;

  MacGrid<Dim> grid_;
  std::array<std::array<Side, 2>, Dim> sides_;
  SmallCells<Dim> small_cells_;
  std::vector<Span> spans_, before_;  ///< cells of each row that may hold smoke; before the last widening
  std::vector<Span> around_;          ///< all that a substep reads
  Field<Dim> volume_;                 ///< of a cell in this step, with what is lent [m^Dim]
  Field<Dim> swept_volume_;           ///< after the sweeps so far
  Field<Dim> density_;                ///< smoke / swept volume
  FaceField<Dim> flux_;               ///< mass through a face
};

}  // namespace spindrift
