#pragma once
/// Small suspensions for the tests.

#include "grid/suspension.hpp"

namespace spindrift::test {

template <int Dim>
MacGrid<Dim> box_grid(int n, double length = 1) {
  MacGrid<Dim> grid;
  grid.dx = length / n;
  grid.cells.fill(n);
  return grid;
}

template <int Dim>
std::array<std::array<Side, 2>, Dim> all_sides(Side side) {
  std::array<std::array<Side, 2>, Dim> sides;
  for (auto& pair : sides) pair.fill(side);
  return sides;
}

/// Options without gravity and with a pressure solve near round-off (below it conjugate gradients break down).
template <int Dim>
SuspensionOptions<Dim> exact_options() {
  SuspensionOptions<Dim> options;
  options.gravity.setZero();
  options.pressure.tolerance = 1e-12;
  options.pressure.max_iterations = 1000;
  return options;
}

/// Face velocities from f(position) -> Vec<Dim>.
template <int Dim, class F>
FaceField<Dim> face_velocity(const MacGrid<Dim>& grid, F&& f) {
  FaceField<Dim> u = make_face_field<Dim>(grid);
  for (int axis = 0; axis < Dim; ++axis)
    for_each_index<Dim>(grid.faces(axis),
                        [&](const Index<Dim>& i) { u[axis][i] = f(grid.face_centre(axis, i))[axis]; });
  return u;
}

/// 2D: face velocities that are divergence-free on the grid, from a stream function at the nodes, constant along the
/// third axis in 3D: u_0 = d psi / d x_up, u_up = -d psi / d x_0.
template <int Dim, class F>
FaceField<Dim> swirl(const MacGrid<Dim>& grid, F&& psi) {
  constexpr int z = up_axis<Dim>;
  FaceField<Dim> u = make_face_field<Dim>(grid);
  const auto at = [&](const Index<Dim>& i) {
    const Vec<Dim> x = grid.node(i);
    return psi(x[0], x[z]);
  };
  for_each_index<Dim>(grid.faces(0),
                      [&](const Index<Dim>& i) { u[0][i] = (at(shifted<Dim>(i, z, 1)) - at(i)) / grid.dx; });
  for_each_index<Dim>(grid.faces(z),
                      [&](const Index<Dim>& i) { u[z][i] = (at(i) - at(shifted<Dim>(i, 0, 1))) / grid.dx; });
  return u;
}

template <int Dim>
double largest(const FaceField<Dim>& u) {
  double m = 0;
  for (const auto& component : u)
    for (std::size_t f = 0; f < component.size(); ++f) m = std::max(m, std::abs(component[f]));
  return m;
}

}  // namespace spindrift::test
