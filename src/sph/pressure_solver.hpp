#pragma once
/// Implicit pressure on volume (R11), after the divergence-free and constant-density solves of DFSPH (Bender & Koschier
/// 2015), both as one relaxed Jacobi iteration with two sources.

#include <vector>

#include "core/vec.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace spindrift {

struct PressureOptions {
  double density_tolerance = 5e-4;    ///< mean compression left, as a fraction of the volume
  double divergence_tolerance = 0.1;  ///< mean rate of compression left, in percent of the volume a step
  int max_iterations = 100;
};

/// How a solve ended.
struct SolveReport {
  int iterations = 0;
  double error = 0;  ///< in the units of the tolerance
};

/// Pressure p >= 0 acts by F_i = -V_i [sum_j V_j (p_i + p_j) grad W_ij + 2 p_i b_i], mass enters by a = F / m only.
/// Its adjoint is the rate of compression D_i(v) = sum_j V_j (v_i - v_j) . grad W_ij + 2 v_i . b_i, b of Neighbours.
/// The iterations run in single precision; the velocities change by apply_pressure, in double precision.
template <int Dim>
class PressureSolver {
 public:
  PressureSolver(const PressureOptions& options, double support_radius) : options_(options), h_(support_radius) {}

  /// Divergence-free solve: v += dt a(p) such that  delta + dt D(v) <= max(delta, 0.95):  what is full must not be
  /// compressed further, what is not may approach until it is. So spray and free surfaces are never held apart, and
  /// never glued, as p >= 0. First guess and result: particles.divergence_pressure, the pressure of the flow.
  /// boundary_impulse: += what walls and cover gave [kg m s^-1].
  SolveReport solve_divergence(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt,
                               Vec<Dim>& boundary_impulse);

  /// Constant-density solve: correction = dt a(p), a velocity that moves the particles in this step and is then
  /// forgotten, such that  delta + dt D(v + correction) <= max(1, delta - 0.003). First guess and result: particles.pressure.
  /// Kept in v, the corrections would feed a boiling motion.
  /// Goes on with the D(v) that solve_divergence left: call it right after, with the same particles and dt.
  SolveReport solve_density(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt,
                            std::vector<Vec<Dim>>& correction);

  std::size_t bytes() const;

 private:
  void prepare(const Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt);
  SolveReport solve(std::vector<double>& pressure, const Neighbours<Dim>& neighbours, double tolerance);
  void find_accelerations(const Neighbours<Dim>& neighbours);
  double find_residuals(const Neighbours<Dim>& neighbours);
  void update_pressures();

  PressureOptions options_;
  double h_;
  std::vector<float> compression_;   ///< dt D(v), v before the solve; after it, with the solve's velocities
  std::vector<float> target_;        ///< the largest dt D allowed
  std::vector<float> residual_;      ///< dt D(v + dt a(p)) - target
  std::vector<float> step_;          ///< relaxation / diagonal of dt^2 dD/dp
  std::vector<float> pressure_, volume_pressure_;   ///< p, V p
  std::vector<float> gradient_sum_;  ///< G, padded to lanes
  std::vector<float> mobility_, volume_;  ///< dt^2 V / m, V
  std::vector<float> displacement_;  ///< dt^2 V a(p), padded to lanes
};

/// v += dt F(p) / m, the forces exactly antisymmetric over pairs; v is particles.velocity or another velocity of theirs.
/// Returns the impulse that the boundary gave [kg m s^-1].
template <int Dim>
Vec<Dim> apply_pressure(std::vector<Vec<Dim>>& v, const Particles<Dim>& particles, const Neighbours<Dim>& neighbours,
                        const std::vector<double>& pressure, double dt);

}  // namespace spindrift
