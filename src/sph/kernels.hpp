#pragma once
/// Smoothing kernels with support radius h, over particles of spacing d.

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/vec.hpp"

namespace spindrift {

enum class KernelShape { cubic_spline, wendland };

/// A kernel W(r) = sigma Shape::shape(q), q = r / h, its integral over Dim dimensions 1.
///   Shape::norm      pi h^Dim sigma
///   Shape::shape(q)  W / sigma, 0 from q = 1 on
///   Shape::slope(q)  h^2 (dW/dr) / (sigma r), negative and finite at q = 0
template <int Dim, class Shape>
struct Kernel : Shape {
  double h;      ///< support radius [m]
  double sigma;  ///< W(0) [m^-Dim]

  explicit Kernel(double support_radius)
      : h(support_radius), sigma(Shape::template norm<Dim> / (std::numbers::pi * std::pow(support_radius, Dim))) {}

  double value(double r) const { return sigma * Shape::shape(r / h); }                   ///< W [m^-Dim]
  double slope_over_r(double r) const { return sigma / (h * h) * Shape::slope(r / h); }  ///< (dW/dr) / r [m^-(Dim+2)]
  Vec<Dim> gradient(const Vec<Dim>& x_ij) const { return slope_over_r(x_ij.norm()) * x_ij; }  ///< by x_i [m^-(Dim+1)]
};

/// W = 2 sigma [(1 - q)^3 - 4 (1/2 - q)_+^3] (Monaghan 1992). On the lattice of h = 2 d the sum of V W is 1.0008 in 2D.
struct CubicSplineShape {
  template <int Dim>
  static constexpr double norm = Dim == 2 ? 40.0 / 7.0 : 8.0;

  template <class T>
  static T shape(T q) {
    const T a = std::max(T(1) - q, T(0)), b = std::max(T(0.5) - q, T(0));
    return T(2) * a * a * a - T(8) * b * b * b;
  }
  template <class T>
  static T slope(T q) {
    const T a = std::max(T(1) - q, T(0));
    return q < T(0.5) ? T(18) * q - T(12) : T(-6) * a * a / std::max(q, T(0.5));
  }
};
template <int Dim>
using CubicSpline = Kernel<Dim, CubicSplineShape>;

/// W = sigma (1 - q)^4 (1 + 4 q), C2 in up to three dimensions (Wendland 1995). Its Fourier transform is positive, so
/// that particles do not pair up (Dehnen and Aly 2012). On the lattice the sum of V W in 2D is 1.038 with h = 2 d and
/// 1.005 with 3 d.
struct WendlandShape {
  template <int Dim>
  static constexpr double norm = Dim == 2 ? 7.0 : 10.5;

  template <class T>
  static T shape(T q) {
    const T a = std::max(T(1) - q, T(0));
    return a * a * a * a * (T(1) + T(4) * q);
  }
  template <class T>
  static T slope(T q) {
    const T a = std::max(T(1) - q, T(0));
    return T(-20) * a * a * a;
  }
};
template <int Dim>
using Wendland = Kernel<Dim, WendlandShape>;

/// f(kernel) with the kernel of that shape.
template <int Dim, class F>
void with_kernel(KernelShape shape, double support_radius, F&& f) {
  shape == KernelShape::wendland ? f(Wendland<Dim>(support_radius)) : f(CubicSpline<Dim>(support_radius));
}

/// The sum of V W over a lattice of spacing d, its middle included.
template <int Dim, class Shape>
double lattice_sum(const Kernel<Dim, Shape>& kernel, double d) {
  const int reach = static_cast<int>(std::ceil(kernel.h / d));
  Index<Dim> block;
  block.fill(2 * reach + 1);
  double sum = 0;
  for_each_index<Dim>(block, [&](const Index<Dim>& i) {
    double square = 0;
    for (int k = 0; k < Dim; ++k) square += (i[k] - reach) * (i[k] - reach);
    sum += std::pow(d, Dim) * kernel.value(d * std::sqrt(square));
  });
  return sum;
}

/// The paper's kernel of number density, Eq. (6): W_n = h / r - 1 for r < h, else 0. Departure R1: r is at least the
/// particle spacing d. Settled snow bunches up along its surface, and with the pole at 0 a surface row would count
/// as full (median 0.95 of the interior; with the bound 0.69, while the interior stays at 0.97).
inline double number_density_kernel(double r, double h, double d) {
  return r < h ? h / std::max(r, d) - 1 : 0;
}

}  // namespace spindrift
