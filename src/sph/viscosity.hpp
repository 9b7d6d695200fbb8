#pragma once
/// Implicit viscosity of the dense flow.

#include <vector>

#include "core/vec.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"
#include "sph/pressure_solver.hpp"

namespace spindrift {

/// Solves (M + dt L) v = M v*,  (L v)_i = mu V_i [sum_j V_j k_ij (v_i - v_j) + c_i v_i],
///   k_ij = -2 x_ij . grad W_ij / (r^2 + 0.01 d^2),
/// c_i the no-slip coefficient of walls and cover (0: slip), component by component, by conjugate gradients with the
/// masses as preconditioner: every iterate then conserves linear momentum to round-off. The form keeps linear momentum
/// exactly and angular momentum to the order of the lattice; the form projected on x_ij, which keeps both, is 25 % too
/// weak with so few neighbours.
template <int Dim>
class ViscositySolver {
 public:
  explicit ViscositySolver(double spacing) : d_(spacing) {}

  /// viscosity: mu > 0 [Pa s]. boundary_impulse: += what no-slip walls and cover gave [kg m s^-1].
  /// Ends when the residual is 1e-6 of its start, or after 200 iterations.
  SolveReport solve(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double viscosity, double dt,
                    Vec<Dim>& boundary_impulse);

  std::size_t bytes() const;

 private:
  void find_coefficients(const Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double viscosity,
                         double dt);
  void apply(const Neighbours<Dim>& neighbours, const std::vector<Vec<Dim>>& v, std::vector<Vec<Dim>>& out) const;

  double d_;
  std::vector<std::vector<float>> pairs_;  ///< dt mu V_i V_j k_ij [kg] of each pair, by block of rows
  std::vector<double> boundary_;           ///< dt mu V_i c_i [kg]
  std::vector<Vec<Dim>> residual_, direction_, product_;
};

}  // namespace spindrift
