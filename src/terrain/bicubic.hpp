#pragma once
/// Catmull-Rom interpolation of z over one cell of a regular grid, from the 4 x 4 points around it, and what z and its
/// derivatives cannot exceed there.
///   z(s, t) = sum_ij w_i(s) w_j(t) z_ij,    w = (-s + 2 s^2 - s^3, 2 - 5 s^2 + 3 s^3, s + 4 s^2 - 3 s^3, s^3 - s^2) /
///   2
/// It goes through the points, has one tangent plane across cells (C1), keeps planes and parabolas, and errs by O(h^3).
/// (A B-spline would be smoother, but it does not go through the points that somebody measured.)

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>

#include "core/vec.hpp"

namespace spindrift {

/// z and its derivatives at a place.
struct Jet {
  double z = 0;                   ///< [m]
  Vec<2> slope = Vec<2>::Zero();  ///< (z_x, z_y)
  double xx = 0, xy = 0, yy = 0;  ///< second derivatives [m^-1]
};

/// Unit normal out of the ground.
inline Vec<3> normal_of(const Jet& jet) {
  return Vec<3>(-jet.slope[0], -jet.slope[1], 1).normalized();
}

/// What the four points along an axis count for.
struct CubicWeights {
  Eigen::Array4d value, slope, bend;  ///< of z, its first derivative [m^-1], its second [m^-2]

  /// t: in the cell, 0 to 1.   level: beyond the grid, where nothing changes any more.
  CubicWeights(double t, double inverse_cell, bool level)
      : value{t * (-0.5 + t * (1 - 0.5 * t)), 1 + t * t * (1.5 * t - 2.5), t * (0.5 + t * (2 - 1.5 * t)),
              t * t * (0.5 * t - 0.5)},
        slope{-0.5 + t * (2 - 1.5 * t), t * (4.5 * t - 5), 0.5 + t * (4 - 4.5 * t), t * (1.5 * t - 1)},
        bend{2 - 3 * t, 9 * t - 5, 4 - 9 * t, 3 * t - 1} {
    slope *= level ? 0 : inverse_cell;
    bend *= level ? 0 : inverse_cell * inverse_cell;
  }
};

/// points: the lowest of the 4 x 4, rows of x `stride` apart.
inline double cubic_value(const double* points, std::size_t stride, const Eigen::Array4d& x, const Eigen::Array4d& y) {
  using Row = Eigen::Map<const Eigen::Array4d>;
  const Eigen::Array4d z = y[0] * Row(points) + y[1] * Row(points + stride) + y[2] * Row(points + 2 * stride) +
                           y[3] * Row(points + 3 * stride);
  return (x * z).sum();
}

inline Jet cubic_jet(const double* points, std::size_t stride, const CubicWeights& x, const CubicWeights& y) {
  using Row = Eigen::Map<const Eigen::Array4d>;
  const Row a(points), b(points + stride), c(points + 2 * stride), d(points + 3 * stride);
  const auto along_y = [&](const Eigen::Array4d& w) -> Eigen::Array4d {
    return w[0] * a + w[1] * b + w[2] * c + w[3] * d;
  };
  const Eigen::Array4d z = along_y(y.value), z_y = along_y(y.slope), z_yy = along_y(y.bend);
  return {(x.value * z).sum(),
          {(x.slope * z).sum(), (x.value * z_y).sum()},
          (x.bend * z).sum(),
          (x.slope * z_y).sum(),
          (x.value * z_yy).sum()};
}

/// What holds all over a cell, or over several.
struct CellBounds {
  float low = 0, high = 0;  ///< of z [m]
  float slope = 0;          ///< of |(z_x, z_y)|
  float hollow = 0;         ///< of the second derivative of z along any direction [m^-1]
  float crest = 0;          ///< of its negative

  double curvature() const { return static_cast<double>(std::max(hollow, crest)); }

  void include(const CellBounds& other) {
    low = std::min(low, other.low);
    high = std::max(high, other.high);
    slope = std::max(slope, other.slope);
    hollow = std::max(hollow, other.hollow);
    crest = std::max(crest, other.crest);
  }
};

/// From the Bezier net of the patch, whose convex hull holds it, and from those of its derivatives.
inline CellBounds cubic_bounds(const double* points, std::size_t stride, double cell) {
  using Net = Eigen::Array44d;
  // Rows: Bezier coefficients of the segment between the middle two of four points.
  const Eigen::Matrix4d to_bezier =
      (Eigen::Matrix4d() << 0, 1, 0, 0, -1. / 6, 1, 1. / 6, 0, 0, 1. / 6, 1, -1. / 6, 0, 0, 1, 0).finished();
  Eigen::Matrix4d z;
  for (int j = 0; j < 4; ++j)
    for (int i = 0; i < 4; ++i) z(i, j) = points[static_cast<std::size_t>(j) * stride + static_cast<std::size_t>(i)];
  const Net net = (to_bezier * z * to_bezier.transpose()).array();
  const auto dx = (3 / cell * (net.bottomRows<3>() - net.topRows<3>())).eval();
  const auto dy = (3 / cell * (net.rightCols<3>() - net.leftCols<3>())).eval();
  const auto xx = (2 / cell * (dx.bottomRows<2>() - dx.topRows<2>())).eval();
  const auto yy = (2 / cell * (dy.rightCols<2>() - dy.leftCols<2>())).eval();
  const double xy = (3 / cell * (dx.rightCols<3>() - dx.leftCols<3>())).abs().maxCoeff();
  const auto outward = [](double value, double to) {
    return std::nextafterf(static_cast<float>(value), static_cast<float>(to));
  };
  return {outward(net.minCoeff(), -INFINITY), outward(net.maxCoeff(), INFINITY),
          outward(std::hypot(dx.abs().maxCoeff(), dy.abs().maxCoeff()), INFINITY),
          outward(std::max({0.0, xx.maxCoeff(), yy.maxCoeff()}) + xy, INFINITY),
          outward(std::max({0.0, -xx.minCoeff(), -yy.minCoeff()}) + xy, INFINITY)};
}

}  // namespace spindrift
