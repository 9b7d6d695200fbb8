#pragma once
/// A geometric multigrid V-cycle in single precision, the preconditioner of the pressure solve.

#include <vector>

#include "grid/multigrid_level.hpp"
#include "grid/poisson_operator.hpp"

namespace spindrift {

/// z = M r with M close to the inverse of the Poisson operator, symmetric and positive: red-black Gauss-Seidel sweeps
/// before, the same in reverse order after the correction from the grid of blocks of 2^Dim cells. There a face conducts
/// half the sum of its fine faces' conductances, which is the same law discretised anew.
template <int Dim>
class Multigrid {
 public:
  explicit Multigrid(Index<Dim> cells);

  /// Sets the coefficients of all levels.
  void build(const PoissonOperator<Dim>& poisson);

  /// Input of the cycle, to be written on the spans of the operator; zero where a cell is not open.
  std::vector<float>& right_side() { return levels_.front().right_side; }
  /// z of the last cycle.
  const std::vector<float>& solution() const { return levels_.front().solution; }

  void cycle() { cycle(0); }

  /// Forgets values that are not finite.
  void clear();
  std::size_t bytes() const;

 private:
  void cycle(std::size_t depth);

  std::vector<MultigridLevel<Dim>> levels_;
};

}  // namespace spindrift
