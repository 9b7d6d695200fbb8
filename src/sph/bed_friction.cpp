#include "sph/bed_friction.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

/// Slows particle i along its bed; returns the impulse given to the bed.
template <int Dim>
Vec<Dim> slow(Particles<Dim>& dense, std::size_t i, const Vec<Dim>& normal, double coulomb, double turbulent) {
  Vec<Dim>& v = dense.velocity[i];
  const Vec<Dim> across = v.dot(normal) * normal;
  const Vec<Dim> along = v - across;
  const double speed = along.norm();
  if (!(speed > 0)) return Vec<Dim>::Zero();
  const Vec<Dim> slower = across + slowed_by_bed(speed, coulomb, turbulent) / speed * along;
  const Vec<Dim> impulse = dense.mass[i] * (v - slower);
  v = slower;
  return impulse;
}

/// The part of gravity that presses snow onto ground of this normal [m s^-2]; 0 on faces of 90 degrees, whose normals
/// round, and under overhangs.
template <int Dim>
double pressing(const Vec<Dim>& gravity, const Vec<Dim>& normal) {
  constexpr double rounding = 1e-6;
  const double g_normal = -gravity.dot(normal);
  return g_normal > rounding * gravity.norm() ? g_normal : 0;
}

/// b = g dt / (xi h) [s m^-1].
double turbulent_rate(const BedFriction& friction, double g, double thickness, double dt) {
  return friction.xi > 0 ? g * dt / (friction.xi * thickness) : 0;
}

/// Books slow_column(column), the impulse given to the bed, with each column; returns the sum, in a fixed order.
template <int Dim, class F>
Vec<Dim> book_columns(Columns<Dim>& columns, F&& slow_column) {
  return parallel_reduce(
      columns.columns.size(), Vec<Dim>(Vec<Dim>::Zero()),
      [&](std::size_t begin, std::size_t end) {
        Vec<Dim> impulse = Vec<Dim>::Zero();
        for (std::size_t c = begin; c < end; ++c) {
          columns.columns[c].friction = slow_column(columns.columns[c]);
          impulse += columns.columns[c].friction;
        }
        return impulse;
      },
      [](const Vec<Dim>& a, const Vec<Dim>& b) -> Vec<Dim> { return a + b; }, 256);
}

}  // namespace

double slowed_by_bed(double speed, double coulomb, double turbulent) {
  const double slower = std::max(0.0, speed - coulomb);
  return 2 * slower / (1 + std::sqrt(1 + 4 * turbulent * slower));
}

template <int Dim>
Vec<Dim> apply_column_friction(Particles<Dim>& dense, Columns<Dim>& columns, const BedFriction& friction,
                               const Vec<Dim>& gravity, double dt) {
  SPINDRIFT_CHECK(columns.foot.size() == dense.size());
  const double g = gravity.norm();
  return book_columns(columns, [&](const Column<Dim>& column) {
    Vec<Dim> impulse = Vec<Dim>::Zero();
    const double turbulent = turbulent_rate(friction, g, column.thickness, dt);
    for (const std::uint32_t i : columns.standing(column)) {
      const Vec<Dim>& normal = columns.foot[i].normal;
      const double g_normal = pressing<Dim>(gravity, normal);
      if (g_normal > 0) impulse += slow(dense, i, normal, friction.mu * g_normal * dt, turbulent);
    }
    return impulse;
  });
}

template <int Dim>
Vec<Dim> apply_base_friction(Particles<Dim>& dense, Columns<Dim>& columns, const BedFriction& friction,
                             const Vec<Dim>& gravity, std::span<const double> normal_impulse, double dt) {
  SPINDRIFT_CHECK(columns.foot.size() == dense.size() && normal_impulse.size() == dense.size());
  const double spacing = columns.bin_size / 2;
  const double turbulent = turbulent_rate(friction, gravity.norm(), spacing, dt);
  return book_columns(columns, [&](const Column<Dim>& column) {
    Vec<Dim> impulse = Vec<Dim>::Zero();
    for (const std::uint32_t i : columns.standing(column)) {
      const Foot<Dim>& foot = columns.foot[i];
      const bool basal = foot.distance - column.bed < spacing || normal_impulse[i] > 0;
      if (!basal || !(pressing<Dim>(gravity, foot.normal) > 0) || !(dense.mass[i] > 0)) continue;
      impulse += slow(dense, i, foot.normal, friction.mu * normal_impulse[i] / dense.mass[i], turbulent);
    }
    return impulse;
  });
}

#define INSTANTIATE(Dim)                                                                                            \
  template Vec<Dim> apply_column_friction<Dim>(Particles<Dim>&, Columns<Dim>&, const BedFriction&, const Vec<Dim>&, \
                                               double);                                                             \
  template Vec<Dim> apply_base_friction<Dim>(Particles<Dim>&, Columns<Dim>&, const BedFriction&, const Vec<Dim>&,   \
                                             std::span<const double>, double);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
