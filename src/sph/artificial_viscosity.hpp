#pragma once
/// Monaghan's artificial viscosity: friction along the line between approaching particles, which keeps SPH quiet.

#include <vector>

#include "core/vec.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace spindrift {

/// alpha, of the viscosity alpha c d.
inline constexpr double artificial_viscosity = 0.3;

/// Adds to each pair with (v_i - v_j) . (x_i - x_j) < 0 the impulse, on i,
///   dt alpha rho_ij c_ij d [v_ij . x_ij / (r^2 + 0.01 d^2)] V_i V_j grad_i W_ij,     c_ij = (c_i + c_j) / 2,
/// away from j: the bracket is negative, and grad_i W_ij points to j. Central, equal and opposite: linear and angular
/// momentum are kept. alpha c_ij is at most 0.25 d / dt, for stability.
/// wave_speed  c [m s^-1] of each particle, from the caller; pairs in which both are 0 cost nothing
/// rho_ij      the smaller of the two m / V, which need not be the density in the caller's c
template <int Dim>
class ArtificialViscosity {
 public:
  explicit ArtificialViscosity(double spacing) : d_(spacing) {}

  void apply(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, const std::vector<double>& wave_speed,
             double dt);
  std::size_t bytes() const;

 private:
  double d_;
  std::vector<Vec<Dim>> change_;  ///< of velocity
};

}  // namespace spindrift
