#pragma once
/// The discrete Poisson operator of the pressure projection, with variable density and open face fractions.

#include <vector>

#include "grid/cell_kind.hpp"
#include "grid/mac_grid.hpp"
#include "grid/parity_layout.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// (A phi)_c = sum_f c_f (phi_c - phi_neighbour),  c_f = open_f / rho_f [m3/kg], zero on faces whose velocity is given.
/// phi = p dt / dx is the potential; beyond an open side phi = 0 at half a cell, c_f = 2 open_f / rho_c.
/// Symmetric; zero rows where a cell is not open. Vectors are in the parity layout.
template <int Dim>
struct PoissonOperator {
  ParityLayout<Dim> layout;
  std::array<std::vector<double>, Dim> conductance;  ///< c_f of the lower faces
  std::vector<RowSpan> spans;                        ///< of the open cells, one a row

  PoissonOperator(const Index<Dim>& cells, const std::array<std::array<Side, 2>, Dim>& sides);

  /// Sets the coefficients for this step's density [kg/m3], open fractions and kinds.
  void build(const Field<Dim>& density, const FaceField<Dim>& open, const Field<Dim, CellKind>& kind);

  /// y = A x; returns x . y.
  double apply(std::vector<double>& y, const std::vector<double>& x) const;

  /// The half columns of a row of faces normal to `axis` that may conduct.
  RowSpan face_span(int axis, const Index<Dim>& start) const;

  std::size_t bytes() const;

 private:
  std::vector<double> resistance_;  ///< rho of open cells, infinite elsewhere; beyond the sides 0 (open) or infinite
};

}  // namespace spindrift
