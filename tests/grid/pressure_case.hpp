#pragma once
/// Set-ups that the tests of the pressure projection share.

#include <array>
#include <cmath>

#include "core/random.hpp"
#include "grid/pressure_projection.hpp"

namespace spindrift::test {

template <int Dim>
using Sides = std::array<std::array<Side, 2>, Dim>;

template <int Dim>
Sides<Dim> all_sides(Side side) {
  Sides<Dim> sides;
  for (auto& pair : sides) pair = {side, side};
  return sides;
}

/// A box of air at rest of density 1; each test changes what it is about.
template <int Dim>
struct PressureCase {
  MacGrid<Dim> grid;
  Sides<Dim> sides;
  FaceField<Dim> u, open;
  Field<Dim> density;
  Field<Dim, CellKind> kind;
  double dt = 0.01;

  PressureCase(const Index<Dim>& cells, double dx, const Sides<Dim>& sides_)
      : grid{Vec<Dim>::Zero(), dx, cells},
        sides(sides_),
        u(make_face_field<Dim>(grid, 0.0)),
        open(make_face_field<Dim>(grid, 1.0)),
        density(cells, 1.0),
        kind(cells, CellKind::open) {}

  CellKind kind_beside(int axis, const Index<Dim>& face, int upper) const {
    const Index<Dim> cell = shifted<Dim>(face, axis, upper - 1);
    if (inside<Dim>(cell, grid.cells)) return kind[cell];
    return sides[axis][upper] == Side::open ? CellKind::open : CellKind::solid;
  }
  /// Whether the projection may change the velocity on a face.
  bool is_free(int axis, const Index<Dim>& face) const {
    return open[axis][face] > 0 && kind_beside(axis, face, 0) == CellKind::open &&
           kind_beside(axis, face, 1) == CellKind::open;
  }
  /// f(axis, face) over all faces.
  template <class F>
  void for_each_face(F&& f) const {
    for (int axis = 0; axis < Dim; ++axis) {
      for_each_index<Dim>(grid.faces(axis), [&](const Index<Dim>& face) { f(axis, face); });
    }
  }
  /// f(axis, face centre) on the faces that are free, 0 on the others.
  template <class F>
  void set_velocity(F&& f) {
    for_each_face([&](int axis, const Index<Dim>& face) {
      u[axis][face] = is_free(axis, face) ? f(axis, grid.face_centre(axis, face)) : 0.0;
    });
  }
  /// Net outflow of a cell in face areas [m/s].
  double outflow(const Index<Dim>& cell) const {
    double sum = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const Index<Dim> upper = shifted<Dim>(cell, axis, 1);
      sum += open[axis][upper] * u[axis][upper] - open[axis][cell] * u[axis][cell];
    }
    return sum;
  }
  double largest_outflow() const {
    double largest = 0;
    for_each_index<Dim>(grid.cells, [&](const Index<Dim>& cell) {
      if (kind[cell] == CellKind::open) largest = std::max(largest, std::abs(outflow(cell)));
    });
    return largest;
  }
  double largest_speed() const {
    double largest = 0;
    for_each_face([&](int axis, const Index<Dim>& face) { largest = std::max(largest, std::abs(u[axis][face])); });
    return largest;
  }
  ProjectionResult project(PressureProjection<Dim>& projection, const ProjectionOptions& options = {}) {
    return projection.project(u, density, open, kind, dt, options);
  }
};

/// Reproducible numbers in (0, 1), one after the other.
struct Sequence {
  std::uint64_t seed;
  std::uint64_t n = 0;
  double operator()() { return uniform(seed, RandomStream{}, n++); }
};

/// Open fractions with closed faces among them, densities 1 to 10^4, solid and core cells, velocities everywhere.
template <int Dim>
PressureCase<Dim> random_case(const Index<Dim>& cells, const Sides<Dim>& sides, std::uint64_t seed) {
  PressureCase<Dim> c(cells, 0.5, sides);
  Sequence random{seed};
  for (std::size_t n = 0; n < c.kind.size(); ++n) {
    const double r = random();
    c.kind[n] = r < 0.1 ? CellKind::solid : r < 0.2 ? CellKind::core : CellKind::open;
    c.density[n] = std::pow(10, 4 * random());
  }
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    const double r = random();
    c.open[axis][face] = r < 0.2 ? 0 : r;
    c.u[axis][face] = random() - 0.5;
  });
  return c;
}

/// A slope that fills the lower left half of the box, with cut faces, under a cloud of `ratio` times the air's density.
template <int Dim>
PressureCase<Dim> slope_case(const Index<Dim>& cells, double ratio) {
  Sides<Dim> sides = all_sides<Dim>(Side::open);
  sides[Dim - 1][0] = Side::closed;
  PressureCase<Dim> c(cells, 0.33, sides);
  const Vec<Dim> size = c.grid.box().size();
  const auto height = [&](const Vec<Dim>& x) {  // above the ground, in cells
    return (x[Dim - 1] / size[Dim - 1] - 0.95 + 0.9 * x[0] / size[0]) * size[Dim - 1] / c.grid.dx;
  };
  for_each_index<Dim>(cells, [&](const Index<Dim>& i) {
    const Vec<Dim> x = c.grid.cell_centre(i);
    if (height(x) < -0.5) c.kind[i] = CellKind::solid;
    const Vec<Dim> from_centre = x - 0.6 * size;
    c.density[i] = from_centre.norm() < 0.15 * size[Dim - 1] ? 1.2 * ratio : 1.2;
  });
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    const double fraction = std::clamp(height(c.grid.face_centre(axis, face)) + 0.5, 0.0, 1.0);
    c.open[axis][face] = fraction < 1e-3 ? 0 : fraction;
  });
  c.set_velocity(
      [&](int axis, const Vec<Dim>& x) { return 0.5 * std::sin(0.7 * x[0] + axis) * std::cos(0.3 * x[Dim - 1]); });
  return c;
}

}  // namespace spindrift::test
