#pragma once
/// Diffusion of velocity and smoke, implicit along one axis after the other: stable for any time step, no iterations.

#include <array>
#include <vector>

#include "grid/ground.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// What closed sides do to the air's viscous stress.
template <int Dim>
struct ViscousSides {
  std::array<std::array<Side, 2>, Dim> sides{};
  bool no_slip = false;             ///< closed sides hold the air; else it slips
  Vec<Dim> lid = Vec<Dim>::Zero();  ///< velocity of the closed top [m s^-1]
};

/// Holds memory only once it has been used.
template <int Dim>
class Diffusion {
 public:
  /// m_f u' - nu dt div(m grad u') = m_f u for each component, m the mass of the faces: momentum only moves. Nothing
  /// passes to closed faces and through sides, but that no-slip sides hold the velocity along them at the side, half a
  /// cell off. Faces with flow_area 0 keep their velocity, and others feel it.
  /// u  in-out: [m/s];   smoke  in: [kg];   viscosity  [m^2/s]
  void diffuse_velocity(FaceField<Dim>& u, const Field<Dim>& smoke, const FaceField<Dim>& flow_area,
                        const MacGrid<Dim>& grid, const Ground<Dim>& ground, const ViscousSides<Dim>& sides,
                        double viscosity, double dt);

  /// V rho' - kappa dt div(A grad rho') = m,  m' = V rho'. Nothing passes through sides. Mass is kept to round-off
  /// along every line of cells.   smoke  in-out: [kg];   diffusivity  [m^2/s]
  void diffuse_smoke(Field<Dim>& smoke, const FaceField<Dim>& flow_area, const MacGrid<Dim>& grid,
                     const Ground<Dim>& ground, double diffusivity, double dt);

  std::size_t bytes() const {
    return spindrift::bytes(x_, weight_, link_, ratio_) + spindrift::bytes(fixed_, hold_, held_);
  }

 private:
  void resize(std::size_t n);
  void hold_at_sides(const ViscousSides<Dim>& sides, const Index<Dim>& shape, int component, int axis, double spread);
  void solve_lines(std::vector<double>& x, const Index<Dim>& shape, int axis);

  std::vector<double> x_, weight_;
  std::vector<double> link_;   ///< to the next point along the axis, 0 at the end
  std::vector<double> ratio_;  ///< of the elimination
  std::vector<double> fixed_;  ///< 1: x stays
  std::vector<double> hold_;   ///< link to a side
  std::vector<double> held_;   ///< what that side draws x to
};

}  // namespace spindrift
