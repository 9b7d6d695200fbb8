#pragma once
/// One grid of the multigrid hierarchy, and how a coarser one is made of it.

#include <array>
#include <vector>

#include "grid/poisson_operator.hpp"

namespace spindrift {

/// One grid of the hierarchy. Vectors in the parity layout of its cells.
template <int Dim>
struct MultigridLevel {
  ParityLayout<Dim> layout;
  std::array<std::vector<float>, Dim> conductance;  ///< of the lower faces
  std::vector<float> inverse_diagonal;              ///< 0: the cell takes no part
  std::vector<float> solution, right_side;
  std::vector<RowSpan> spans;
  std::vector<YieldTerm<Dim>> yields;  ///< in no conductance, but in the diagonal

  explicit MultigridLevel(const Index<Dim>& cells);
};

/// Sets the reciprocal diagonal from the conductances and yields.
template <int Dim>
void set_diagonal(MultigridLevel<Dim>& level);

/// Half the sum of the fine conductances that make up each coarse face. An odd number of fine cells leaves the last
/// block half outside: its upper faces are those of its only layer, at the layer's own distance. A coarse cell yields
/// as much as its fine cells together.
template <int Dim>
void coarsen(MultigridLevel<Dim>& coarse, const MultigridLevel<Dim>& fine);

/// Takes the diagonal from coarse cells all of whose fine cells have none: still air, whose pressure stays 0.
template <int Dim>
void keep_unknowns(MultigridLevel<Dim>& coarse, const MultigridLevel<Dim>& fine);

/// The rows of cells that a coarse row covers: f(fine first cell).
template <int Dim, class F>
void for_each_fine_row(const Index<Dim>& coarse, const Index<Dim>& fine_cells, F&& f) {
  for (int corner = 0; corner < 1 << (Dim - 1); ++corner) {
    Index<Dim> i{};
    bool exists = true;
    for (int k = 1; k < Dim; ++k) {
      i[k] = 2 * coarse[k] + ((corner >> (k - 1)) & 1);
      exists = exists && i[k] < fine_cells[k];
    }
    if (exists) f(i);
  }
}

}  // namespace spindrift
