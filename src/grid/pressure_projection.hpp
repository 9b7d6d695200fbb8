#pragma once
/// The pressure projection with variable density (R9): velocity fields without divergence on the open cells.

#include <array>

#include "grid/components.hpp"
#include "grid/conjugate_gradient.hpp"
#include "grid/mac_grid.hpp"
#include "grid/poisson_operator.hpp"

namespace spindrift {

struct ProjectionOptions {
  double tolerance = 1e-3;  ///< on the relative residual |r|_2 / |b|_2
  int max_iterations = 200;
};

struct ProjectionResult {
  int iterations = 0;
  double residual = 0;        ///< relative
  bool converged = true;      ///< false: also where u was not finite, which leaves u as it was
  double unmatched_flux = 0;  ///< [m/s] largest net inflow a cell (in face areas) of a component without an open side:
                              ///< no velocity field can match it, it stays as uniform divergence
};

/// Makes face velocities divergence-free, by conjugate gradients with a multigrid preconditioner.
template <int Dim>
class PressureProjection {
 public:
  using Sides = std::array<std::array<Side, 2>, Dim>;

  /// sides: [axis][0 lower, 1 upper]. Open: p = 0 on the side's faces (half a cell from the centre). Closed: the
  /// velocity on the side's faces is given.
  PressureProjection(const MacGrid<Dim>& grid, const Sides& sides);

  /// Makes u divergence-free on open cells:
  ///   sum_f open_f A u_f . n = 0,   u_f -= dt / rho_f (grad p)_f
  /// u        in-out: face velocities [m/s]. Faces with a given velocity (closed side, open fraction 0, next to a core,
  ///          solid or pocket cell) are not changed; their flux open_f A u_f counts, so a face between an open and a
  ///          core cell holds the core's normal velocity
  /// density  in: total density at cell centres [kg/m3], > 0; a face takes the mean of its two cells, a face of an open
  ///          side its cell's
  /// open     in: open area fraction of each face, 0..1
  /// kind     in: of each cell; cells other than open get p = 0
  /// dt       in: [s], > 0
  /// heavy    in: core cells, no cell twice. Their faces towards open cells yield to the pressure with the cell's mass,
  ///              u_f += dt p open_f A / m away from the air, so that the impulse p open_f A dt that the core takes and
  ///              the air's motion belong together at any mass ratio (R10). Cores that are not listed do not yield
  /// A component of open cells that reaches no open side gets its right-hand side's mean subtracted, since no velocity
  /// could match a net inflow into it, and a pressure of mean zero. No flux to remove: no iteration, u unchanged.
  /// Source: paper Eqs. (1), (2), boundary of Sec. 4.2.   Departures: R9, R10.
  ProjectionResult project(FaceField<Dim>& u, const Field<Dim>& density, const FaceField<Dim>& open,
                           const Field<Dim, CellKind>& kind, double dt, const ProjectionOptions& options = {},
                           std::span<const HeavyCell<Dim>> heavy = {});

  /// Of the last project() [Pa]; 0 in cells that are not open. The first guess of the next solve where it is better
  /// than none: state, to be stored in checkpoints.
  double pressure(const Index<Dim>& cell) const;
  Field<Dim> pressure() const;
  void set_pressure(const Field<Dim>& pressure);

  /// The same in the solver's own layout, for copies within a run. Setting it forgets all else of the last solve, which
  /// may have gone astray.
  const std::vector<double>& guess() const { return solver_.solution; }
  void set_guess(const std::vector<double>& guess);
  std::size_t bytes() const;

 private:
  void set_right_side(const FaceField<Dim>& u, const FaceField<Dim>& open, const Field<Dim, CellKind>& kind, double dt);
  double subtract_closed_means(std::vector<double>& values);
  void anchor_closed_components();
  void correct(FaceField<Dim>& u, const FaceField<Dim>& open, double dt) const;
  void yield(FaceField<Dim>& u, const FaceField<Dim>& open, const Field<Dim, CellKind>& kind,
             std::span<const HeavyCell<Dim>> heavy, double dt) const;

  Sides sides_;
  double dx_;
  Components<Dim> components_;
  PoissonOperator<Dim> poisson_;
  ConjugateGradient<Dim> solver_;  ///< solves for p [Pa]
  std::vector<double> mean_;       ///< one a component
};

}  // namespace spindrift
