#pragma once
/// Kernels integrated over the space behind plane walls, as functions of the signed distance to the wall.

#include <vector>

#include "core/vec.hpp"
#include "sph/kernels.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// What the walls near one particle add to its volume sum.
template <int Dim>
struct WallShare {
  double fraction = 0;                   ///< of the kernel's support
  Vec<Dim> gradient = Vec<Dim>::Zero();  ///< half the gradient of the fraction [m^-1]; points into the walls
};

/// Half-space integrals, tabulated once by quadrature and interpolated linearly (error below 1e-5).
///   I(s) = int W dV over the half space at distance s,   dI/ds = -W integrated over the wall's plane.
/// What a wall adds to a particle's volume sum is J(s) = I(s_0 + a (s - d/2)). A wall that mirrors the fluid pushes
/// twice as hard as grad I times the pressure; with a force of -2 p grad I next to a volume sum with I the forces would
/// have no potential, and a resting column would boil for ever. J has the mirror's slope instead of I's: s_0 and a are
/// such that a lattice whose first row lies d/2 off the wall is full, and at rest under uniform pressure (a is about
/// 2). Only the first row is fitted, and where h = 2 d no other reaches the wall: with h = 3 d the second row lacks 3 %
/// of its volume sum. Several walls: the free fractions multiply, 1 - prod_k (1 - J(s_k)), which is right at box
/// corners.
template <int Dim>
class WallKernel {
 public:
  WallKernel(double support_radius, double spacing, KernelShape shape = KernelShape::cubic_spline);

  KernelShape shape() const { return shape_; }
  /// The volume sum at which snow is full: that of the lattice, in units of the cubic spline's with h = 2 d (1.0008 in
  /// 2D). Kernels that sum up to more would otherwise make the snow swell, by 4 % Wendland's with h = 2 d.
  double full() const { return full_; }
  double support_radius() const { return h_; }                           ///< [m]
  double fraction(double s) const { return interpolate(fraction_, s); }  ///< I: 0 at s >= h, 1/2 at 0, 1 at s <= -h
  double slope(double s) const { return interpolate(slope_, s) / h_; }   ///< dI/ds [m^-1], never positive
  /// The share of the number-density kernel W_n (paper Eq. 6) behind the wall.
  double number_density_fraction(double s) const { return interpolate(number_density_fraction_, s); }
  /// int W_n dV over all space [m^Dim].
  double number_density_integral() const { return number_density_integral_; }

  /// J of all walls near x, and half its gradient.   foot: the terrain's, of x; of no terrain it is nowhere.
  WallShare<Dim> share(const Walls<Dim>& walls, const Vec<Dim>& x, const Foot<Dim>& foot) const;
  /// The number-density fraction of all walls near x.
  double number_density_share(const Walls<Dim>& walls, const Vec<Dim>& x, const Foot<Dim>& foot) const;

  /// Viscous coefficient of no-slip walls [m^-2]: the wall's drag on a particle is -mu V c v, c = -(dJ/ds) / s. With
  /// the wall's velocity extrapolated as the mirror image -v s'/s the integral of the Laplacian's kernel is 2 |dI/ds| /
  /// s exactly; J makes it the lattice's sum, so that a linear shear flow over a wall feels no force. s is at least h /
  /// 16, so that c stays finite.
  double no_slip_coefficient(const Walls<Dim>& walls, const Vec<Dim>& x, const Foot<Dim>& foot) const;

  std::size_t bytes() const;

 private:
  template <class K>
  void fit_to_lattice(const K& kernel, double d);
  double interpolate(const std::vector<double>& table, double s) const;

  KernelShape shape_;
  double full_;
  double h_;
  std::vector<double> fraction_, slope_, number_density_fraction_;  ///< over s / h in [-1, 1]; the slope times h
  double number_density_integral_;
  double offset_, stretch_;  ///< s_0 - a d/2 [m] and a
};

}  // namespace spindrift
