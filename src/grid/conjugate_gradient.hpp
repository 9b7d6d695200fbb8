#pragma once
/// Conjugate gradients in double precision for the Poisson operator, preconditioned by a multigrid cycle.

#include <vector>

#include "grid/multigrid.hpp"
#include "grid/poisson_operator.hpp"

namespace spindrift {

/// Vectors in the operator's parity layout; what lies outside its spans is not read and not written.
template <int Dim>
class ConjugateGradient {
 public:
  struct Result {
    int iterations = 0;
    double residual = 0;  ///< |b - A x|_2 / |b|_2
    bool converged = true;
  };

  explicit ConjugateGradient(const ParityLayout<Dim>& layout);

  /// Solves A x = b. `solution` holds the first guess and, after, x, 0 where a cell is not open; `right_side` holds b
  /// and, after, the residual. A guess that is no better than zero is dropped. b must be zero where a cell is not open,
  /// and sum to zero over each component without an open side.
  Result solve(const PoissonOperator<Dim>& poisson, double tolerance, int max_iterations);

  /// Forgets values that are not finite, which a failed solve may have left where the next one reads.
  void clear();

  std::vector<double> solution, right_side;
  std::size_t bytes() const { return spindrift::bytes(solution, right_side, direction_, image_) + multigrid_.bytes(); }

 private:
  double take_guess(const PoissonOperator<Dim>& poisson, double b_norm2);

  std::vector<double> direction_, image_;
  Multigrid<Dim> multigrid_;
};

}  // namespace spindrift
