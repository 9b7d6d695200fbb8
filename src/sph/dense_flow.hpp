#pragma once
/// The dense-flow layer (paper Sec. 4.3): particles, their neighbours and the solvers, in the order of the step.

#include <limits>

#include "core/stages.hpp"
#include "sph/artificial_viscosity.hpp"
#include "sph/cell_list.hpp"
#include "sph/neighbours.hpp"
#include "sph/particles.hpp"
#include "sph/pressure_solver.hpp"
#include "sph/viscosity.hpp"
#include "sph/wall_kernel.hpp"
#include "sph/wcsph.hpp"

namespace spindrift {

enum class DenseSolver { dfsph, wcsph };

struct DenseFlowOptions {
  double support_radius = 0.21;  ///< h [m]
  double spacing = 0.105;        ///< d [m], less than h
  KernelShape kernel = KernelShape::cubic_spline;
  double density = 300;  ///< rest density [kg m^-3]
  DenseSolver solver = DenseSolver::dfsph;
  double viscosity = 0;      ///< mu [Pa s]; 0: the viscous solve does not exist
  bool no_slip = false;      ///< walls and cover hold the snow by viscosity
  PressureOptions pressure;  ///< of dfsph
  double sound_speed = 0;    ///< of wcsph [m s^-1]; positive there
  NeighbourSearch neighbour_search = NeighbourSearch::cell_list;
};

/// What left a set of particles.
template <int Dim>
struct Removed {
  std::size_t count = 0;
  double mass = 0;                       ///< [kg]
  Vec<Dim> momentum = Vec<Dim>::Zero();  ///< [kg m s^-1]
};

/// Removes the particles for which gone(i), keeping the order of the others.
template <int Dim, class F>
Removed<Dim> remove_if(Particles<Dim>& particles, F&& gone) {
  Removed<Dim> removed;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (gone(i)) {
      ++removed.count;
      removed.mass += particles.mass[i];
      removed.momentum += particles.mass[i] * particles.velocity[i];
    } else {
      if (kept != i) particles.for_each_array([&](auto& array) { array[kept] = array[i]; });
      ++kept;
    }
  }
  if (removed.count > 0) particles.resize(kept);
  return removed;
}

/// What one velocity solve did.
template <int Dim>
struct VelocitySolve {
  SolveReport viscosity;
  SolveReport divergence;  ///< error: mean rate of compression left [percent of the volume a step]
  SolveReport density;     ///< error: the mean compression at which that rate lets the volume settle; the same solve
  Vec<Dim> boundary_impulse = Vec<Dim>::Zero();  ///< given by walls and cover to the particles [kg m s^-1]
};

template <int Dim>
class DenseFlow {
 public:
  /// Throws Error(bad_input): an option out of range.
  explicit DenseFlow(const DenseFlowOptions& options);

  Particles<Dim> particles;

  /// The step, in this order; before the third the caller may change velocities and masses. Any number of
  /// particles is legal, none too.
  /// 1: sorts the particles and finds the ground below each. ground_reach: how far the ground is looked for [m], at
  /// least the support radius, beyond which no wall acts. Throws Error(unstable): a position that is not finite.
  void sort(const Walls<Dim>& walls, Stages& stages, double ground_reach = std::numeric_limits<double>::infinity());
  /// 2: finds all neighbours.
  void find_neighbours(const Walls<Dim>& walls, const CoverView<Dim>& cover, Stages& stages);
  /// 3: viscosity and pressure. Gravity is in the velocities already. dfsph is kept quiet by ArtificialViscosity with
  /// the wave speed sqrt(p / rho) of the last step's pressure, rho the rest density of the options: none in free fall,
  /// and less the finer the particles. wcsph with its sound speed.
  /// Throws Error(unstable): a velocity not finite.
  VelocitySolve<Dim> solve_velocity(double dt, Stages& stages);
  /// 4: x += dt v. What ended in a wall is put back on its surface, its velocity into the wall removed.
  /// Returns the impulse that the walls gave [kg m s^-1].
  Vec<Dim> move(double dt, const Walls<Dim>& walls, Stages& stages);
  /// 5: removes what left through an open side (R23).
  Removed<Dim> remove_outside(const Walls<Dim>& walls);

  /// Volume relaxes to mass / density: V += (m / rho - V) (1 - exp(-dt / time)). time 0: off (R20).
  void compact(double dt, double time);

  /// The smallest of [s]
  ///   cfl d / |v|max
  ///   cfl sqrt(d / |gravity|), for a start from rest
  ///   dfsph: 0.6 d / sqrt(p / rho) of the largest p / rho, with the last pressure and rho the particle's own m / V
  ///   wcsph: 0.4 d / (c sqrt(rho_0 V / m)) of the lightest snow, at most 0.4 d / c; rho_0 the rest density
  /// Infinite without particles.
  double time_step_limit(double cfl, double gravity) const;

  const DenseFlowOptions& options() const { return options_; }
  const CellList<Dim>& cells() const { return cells_; }
  const Neighbours<Dim>& neighbours() const { return neighbours_; }
  /// What each particle saw of the terrain when it was sorted; empty without terrain.
  const std::vector<Foot<Dim>>& feet() const { return feet_; }
  const Foot<Dim>& foot(std::size_t i) const { return feet_.empty() ? nowhere<Dim> : feet_[i]; }
  const WallKernel<Dim>& wall_kernel() const { return wall_kernel_; }
  /// Of particles and scratch.
  std::size_t bytes() const;

 private:
  DenseFlowOptions options_;
  WallKernel<Dim> wall_kernel_;
  CellList<Dim> cells_;
  std::vector<Foot<Dim>> feet_;
  Neighbours<Dim> neighbours_;
  PressureSolver<Dim> pressure_solver_;
  ViscositySolver<Dim> viscosity_solver_;
  ArtificialViscosity<Dim> artificial_viscosity_;
  std::vector<double> wave_speed_;  ///< sqrt(p / rho_0), or the sound speed of wcsph [m s^-1]
};

}  // namespace spindrift
