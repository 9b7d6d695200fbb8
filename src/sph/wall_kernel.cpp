#include "sph/wall_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/memory.hpp"

namespace spindrift {
namespace {

constexpr std::size_t n_intervals = 2048;

/// Integral of f(r) over the plane at distance s, f = 0 beyond r = 1. With rho = rho_max sin(phi) the integrand is
/// smooth at the rim, and the midpoint rule in phi converges fast.
template <int Dim, class F>
double plane_integral(double s, F&& f) {
  constexpr int n = 256;
  const double rho_max = std::sqrt(std::max(0.0, 1 - s * s));
  const double d_phi = 0.5 * std::numbers::pi / n;
  double sum = 0;
  for (int k = 0; k < n; ++k) {
    const double phi = (k + 0.5) * d_phi, rho = rho_max * std::sin(phi);
    const double measure = Dim == 2 ? 2.0 : 2 * std::numbers::pi * rho;
    sum += f(std::sqrt(s * s + rho * rho)) * measure * rho_max * std::cos(phi) * d_phi;
  }
  return sum;
}

/// int_s^1 of a tabulated function of s in [-1, 1], by the trapezoidal rule.
std::vector<double> integral_above(const std::vector<double>& f) {
  std::vector<double> sum(f.size(), 0.0);
  for (std::size_t k = f.size() - 1; k-- > 0;) {
    sum[k] = sum[k + 1] + 0.5 * (f[k] + f[k + 1]) * 2.0 / static_cast<double>(n_intervals);
  }
  return sum;
}

template <int Dim, class F>
std::vector<double> plane_integrals(F&& f) {
  std::vector<double> table(n_intervals + 1);
  for (std::size_t k = 0; k < table.size(); ++k) {
    table[k] = plane_integral<Dim>(2.0 * static_cast<double>(k) / static_cast<double>(n_intervals) - 1, f);
  }
  return table;
}

}  // namespace

template <int Dim>
WallKernel<Dim>::WallKernel(double support_radius, double spacing, KernelShape shape)
    : shape_(shape), h_(support_radius) {
  with_kernel<Dim>(shape, 1.0,
                   [&](const auto& unit) { slope_ = plane_integrals<Dim>([&](double r) { return unit.value(r); }); });
  fraction_ = integral_above(slope_);
  for (double& w : slope_) w = -w / fraction_.front();
  for (double& i : fraction_) i /= fraction_.front();

  with_kernel<Dim>(shape, h_, [&](const auto& kernel) { fit_to_lattice(kernel, spacing); });

  number_density_fraction_ = integral_above(
      plane_integrals<Dim>([&](double r) { return number_density_kernel(r, 1.0, spacing / support_radius); }));
  const double total = number_density_fraction_.front();
  for (double& i : number_density_fraction_) i /= total;
  number_density_integral_ = total * std::pow(h_, Dim);
}

/// The rows of a lattice of spacing d that a wall at d/2 from its first row replaces, as far as they lie inside the
/// first row's support: one where h = 2 d.
template <int Dim>
template <class K>
void WallKernel<Dim>::fit_to_lattice(const K& kernel, double d) {
  full_ = lattice_sum(kernel, d) / lattice_sum(CubicSpline<Dim>(2 * d), d);
  const int reach = static_cast<int>(std::ceil(h_ / d));
  double value = 0, slope_value = 0;
  Index<Dim - 1> row;
  row.fill(2 * reach + 1);
  for (int depth = 1; depth <= reach; ++depth)
    for_each_index<Dim - 1>(row, [&](const Index<Dim - 1>& i) {
      double r_squared = depth * depth * d * d;
      for (const int k : i) r_squared += (k - reach) * (k - reach) * d * d;
      const double r = std::sqrt(r_squared);
      value += std::pow(d, Dim) * kernel.value(r);
      slope_value += std::pow(d, Dim) * kernel.slope_over_r(r) * (depth * d);
    });
  double low = 0, high = h_;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (low + high);
    (fraction(middle) > value ? low : high) = middle;
  }
  stretch_ = 2 * slope_value / slope(low);
  offset_ = low - stretch_ * 0.5 * d;
}

template <int Dim>
double WallKernel<Dim>::interpolate(const std::vector<double>& table, double s) const {
  constexpr double n = static_cast<double>(n_intervals);
  const double t = std::clamp(0.5 * (s / h_ + 1), 0.0, 1.0) * n;
  const double k = std::min(std::floor(t), n - 1);
  const auto at = static_cast<std::size_t>(k);
  return table[at] + (t - k) * (table[at + 1] - table[at]);
}

template <int Dim>
WallShare<Dim> WallKernel<Dim>::share(const Walls<Dim>& walls, const Vec<Dim>& x, const Foot<Dim>& foot) const {
  double free = 1;
  Vec<Dim> free_gradient = Vec<Dim>::Zero();
  walls.for_each_near(x, foot, h_, [&](double distance, const Vec<Dim>& normal) {
    const double s = offset_ + stretch_ * distance;
    const double open = 1 - fraction(s);
    free_gradient = free_gradient * open - (0.5 * stretch_ * free * slope(s)) * normal;
    free *= open;
  });
  return {1 - free, -free_gradient};
}

template <int Dim>
double WallKernel<Dim>::number_density_share(const Walls<Dim>& walls, const Vec<Dim>& x, const Foot<Dim>& foot) const {
  double free = 1;
  walls.for_each_near(x, foot, h_, [&](double s, const Vec<Dim>&) { free *= 1 - number_density_fraction(s); });
  return 1 - free;
}

template <int Dim>
double WallKernel<Dim>::no_slip_coefficient(const Walls<Dim>& walls, const Vec<Dim>& x, const Foot<Dim>& foot) const {
  double c = 0;
  walls.for_each_near(x, foot, h_, [&](double s, const Vec<Dim>&) {
    c -= stretch_ * slope(offset_ + stretch_ * s) / std::max(s, h_ / 16);
  });
  return c;
}

template <int Dim>
std::size_t WallKernel<Dim>::bytes() const {
  return spindrift::bytes(fraction_, slope_, number_density_fraction_);
}

template class WallKernel<2>;
template class WallKernel<3>;

}  // namespace spindrift
