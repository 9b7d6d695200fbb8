#pragma once
/// Smoothing kernels with support radius h, over particles of spacing d.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vec.hpp"

namespace spindrift {

/// Cubic spline, W(r) = 2 sigma [(1 - q)^3 - 4 (1/2 - q)_+^3], q = r / h < 1 (Monaghan 1992), its integral over Dim
/// dimensions 1. On the lattice of h = 2 d the sum of V W is 1.0008 in 2D.
template <int Dim>
struct CubicSpline {
  double h;      ///< support radius [m]
  double sigma;  ///< W(0) [m^-Dim]

  explicit CubicSpline(double support_radius)
      : h(support_radius), sigma((Dim == 2 ? 40.0 / 7.0 : 8.0) / (std::numbers::pi * std::pow(support_radius, Dim))) {}

  /// W / sigma as a function of q.
  template <class T>
  static T shape(T q) {
    const T a = std::max(T(1) - q, T(0)), b = std::max(T(0.5) - q, T(0));
    return T(2) * a * a * a - T(8) * b * b * b;
  }
  /// h^2 (dW/dr) / (sigma r), negative and finite at r = 0.
  template <class T>
  static T slope(T q) {
    const T a = std::max(T(1) - q, T(0));
    return q < T(0.5) ? T(18) * q - T(12) : T(-6) * a * a / std::max(q, T(0.5));
  }

  double value(double r) const { return sigma * shape(r / h); }                   ///< W [m^-Dim]
  double slope_over_r(double r) const { return sigma / (h * h) * slope(r / h); }  ///< (dW/dr) / r [m^-(Dim+2)]
  Vec<Dim> gradient(const Vec<Dim>& x_ij) const { return slope_over_r(x_ij.norm()) * x_ij; }  ///< by x_i [m^-(Dim+1)]
};

/// The paper's kernel of number density, Eq. (6): W_n = h / r - 1 for r < h, else 0. Departure R1: r is at least the
/// particle spacing d. Settled snow bunches up along its surface, and with the pole at 0 a surface row would count
/// as full (median 0.95 of the interior; with the bound 0.69, while the interior stays at 0.97).
inline double number_density_kernel(double r, double h, double d) {
  return r < h ? h / std::max(r, d) - 1 : 0;
}

}  // namespace spindrift
