#pragma once
/// Implicit pressure on volume (R11), after DFSPH (Bender & Koschier 2015).

#include <vector>

#include "core/vec.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"

namespace spindrift {

struct PressureOptions {
  double density_tolerance = 5e-4;    ///< mean compression left, as a fraction of the volume
  double divergence_tolerance = 0.1;  ///< mean rate of compression left, in percent of the volume a step
  /// mean compression left, as a share of what the velocities alone would compress; 0: not asked for
  double relative_tolerance = 0.1;
  int max_iterations = 100;
};

/// How a solve ended.
struct SolveReport {
  int iterations = 0;
  double error = 0;  ///< in the units of the tolerance
};

/// The share of a particle's compression that one step takes back. The solve leaves a rate of compression r a step; the
/// volume then settles at a compression of r / compression_relaxation.
inline constexpr double compression_relaxation = 0.4;

/// Pressure p >= 0 acts by F_i = -V_i [sum_j V_j (p_i + p_j) grad W_ij + 2 p_i b_i], mass enters by a = F / m only.
/// Its adjoint is the rate of compression D_i(v) = sum_j V_j (v_i - v_j) . grad W_ij + 2 v_i . b_i, b of Neighbours.
/// One solve does the work of DFSPH's two: v += dt a(p) such that, with k = compression_relaxation and e = full - delta
/// (full: about 1 but for snow wedged in, see Neighbours),
///   dt D(v) <= max(k e, -0.005, -2.5 s^-1 dt)       where the volume sum delta is over full,
///   dt D(v) <= e [k + (1 - k) min(1, e / 0.1)]      else,
/// with p > 0 only where equality holds. So full snow keeps its volume, compression is taken back over a few steps and
/// not at once (which would fling the snow apart), and spray and free surfaces may approach until they are full. They
/// are never glued, as p >= 0.
///
/// Relaxed Jacobi iteration, sped up by Nesterov's extrapolation with restarts, in single precision; the velocities
/// change by apply_pressure, in double precision.
template <int Dim>
class PressureSolver {
 public:
  PressureSolver(const PressureOptions& options, double support_radius, double spacing);

  /// First guess and result: particles.pressure. boundary_impulse: += what walls and cover gave [kg m s^-1].
  /// Ends when the mean error r of dt D is at most compression_relaxation times density_tolerance and a hundredth of
  /// divergence_tolerance, and no particle's error over 50 times that, or after max_iterations; at least one iteration.
  /// With a relative tolerance r is also at most that share of the mean of max(0, dt D(v) - allowed) before the solve:
  /// snow under its own weight compresses by dt^2 g / H a step, which in fine snow is less than the other tolerances.
  /// Returns r.
  SolveReport solve(Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt,
                    Vec<Dim>& boundary_impulse);

  std::size_t bytes() const;

 private:
  void prepare(const Particles<Dim>& particles, const Neighbours<Dim>& neighbours, double dt);
  double mean_excess() const;
  void find_displacements(const Neighbours<Dim>& neighbours);
  struct Residuals {
    double sum = 0, largest = 0;
  };
  Residuals find_residuals(const Neighbours<Dim>& neighbours);
  void update_pressures(float share, float momentum);

  PressureOptions options_;
  double h_;
  float relaxation_;             ///< of the Jacobi iteration, less over wide supports
  double least_diagonal_;        ///< of m / V dD_i/dp_i, in units of h^-2
  std::vector<float> excess_;    ///< dt D(v) of the velocities given, minus the largest allowed
  std::vector<float> residual_;  ///< the same with the pressure's velocities
  std::vector<float> step_;      ///< relaxation / diagonal of dt^2 dD/dp
  std::vector<float> pressure_, previous_, volume_pressure_;  ///< p, p before the last extrapolation, V p
  std::vector<float> gradient_sum_;                           ///< G, padded to lanes
  std::vector<float> mobility_, volume_;                      ///< dt^2 V / m, V
  std::vector<float> displacement_;                           ///< dt^2 V a(p), padded to lanes
};

/// v += dt F(p) / m, the forces exactly antisymmetric over pairs; v is particles.velocity or another velocity of
/// theirs. Returns the impulse that the boundary gave [kg m s^-1].
template <int Dim>
Vec<Dim> apply_pressure(std::vector<Vec<Dim>>& v, const Particles<Dim>& particles, const Neighbours<Dim>& neighbours,
                        const std::vector<double>& pressure, double dt);

}  // namespace spindrift
