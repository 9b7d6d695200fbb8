#pragma once
/// The discrete Poisson operator of the pressure projection, with variable density and open face fractions.

#include <span>
#include <vector>

#include "grid/cell_kind.hpp"
#include "grid/mac_grid.hpp"
#include "grid/parity_layout.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// A core cell and the mass that its faces move with when air pushes them.
template <int Dim>
struct HeavyCell {
  Index<Dim> cell{};
  double mass = 0;  ///< [kg]
};

/// How far the core's faces around an open cell yield to its pressure: a term of the operator's diagonal.
template <int Dim>
struct YieldTerm {
  Index<Dim> cell{};
  std::ptrdiff_t place = 0;  ///< in the parity layout
  double value = 0;          ///< sum over the faces of open_f^2 V / m [m3/kg]
};

/// Sorts the terms by place, adding up those of one cell in their order.
template <int Dim>
void merge_yields(std::vector<YieldTerm<Dim>>& yields);

/// (A p)_c = sum_f c_f (p_c - p_neighbour) + y_c p_c,  c_f = open_f / rho_f [m3/kg], zero on faces whose velocity is
/// given, y_c the yield of the core's faces; beyond an open side, and in still air, p = 0 at half a cell, c_f = 2
/// open_f / rho_c. Symmetric; zero rows where a cell is not open. Vectors are in the parity layout.
template <int Dim>
struct PoissonOperator {
  ParityLayout<Dim> layout;
  std::array<std::vector<double>, Dim> conductance;  ///< c_f of the lower faces
  std::vector<RowSpan> spans;                        ///< of the open cells, one a row
  std::vector<YieldTerm<Dim>> yields;                ///< of open cells beside the core, no cell twice, in memory order

  PoissonOperator(const Index<Dim>& cells, const std::array<std::array<Side, 2>, Dim>& sides);

  /// Sets the coefficients for this step's density [kg/m3], open fractions and kinds.
  /// heavy: core cells whose faces yield; cell_volume [m^Dim].
  void build(const Field<Dim>& density, const FaceField<Dim>& open, const Field<Dim, CellKind>& kind,
             std::span<const HeavyCell<Dim>> heavy = {}, double cell_volume = 1);

  /// y = A x; returns x . y.
  double apply(std::vector<double>& y, const std::vector<double>& x) const;

  /// y = b - A x; returns y . y.
  double residual(std::vector<double>& y, const std::vector<double>& x, const std::vector<double>& b) const;
  /// Whether the cell at a place of the layout was open at the last build().
  bool is_open(std::ptrdiff_t place) const;
  /// x = 0 where a cell is not open.
  void clear_closed(std::vector<double>& x) const;

  /// The half columns of a row of faces normal to `axis` that may conduct.
  RowSpan face_span(int axis, const Index<Dim>& start) const;

  /// Whether there was still air at the last build(): cells that conduct to open ones, but are not unknowns.
  bool has_still() const { return has_still_; }

  std::size_t bytes() const;

 private:
  template <class F>
  double sum_over_products(const std::vector<double>& x, F&& f) const;
  template <class F>
  double sum_over_cells_in_spans(const std::vector<double>& x, F&& f) const;
  void find_yields(const FaceField<Dim>& open, const Field<Dim, CellKind>& kind, std::span<const HeavyCell<Dim>> heavy,
                   double cell_volume);

  /// rho of open cells, 0 of still ones, infinite elsewhere; beyond the sides 0 (open) or infinite
  std::vector<double> resistance_;
  bool has_still_ = false;
};

/// Calls f(axis, face, open neighbour, sign) for the faces of a core cell towards open cells; sign +1: the neighbour
/// lies above.
template <int Dim, class F>
void for_each_open_neighbour(const Index<Dim>& core, const FaceField<Dim>& open, const Field<Dim, CellKind>& kind,
                             F&& f) {
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Index<Dim> other = shifted<Dim>(core, axis, 2 * side - 1), face = shifted<Dim>(core, axis, side);
      if (!inside<Dim>(other, kind.shape()) || kind[other] != CellKind::open || open[axis][face] <= 0) continue;
      f(axis, face, other, 2 * side - 1);
    }
  }
}

}  // namespace spindrift
