/// Core faces that yield to the air's pressure (R10).

#include <catch2/catch.hpp>

#include "pressure_case.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

/// A slope with a layer of core cells on it, of masses between a hundredth and a hundred times their air.
template <int Dim>
PressureCase<Dim> core_on_slope(std::vector<HeavyCell<Dim>>& heavy) {
  Index<Dim> cells;
  cells.fill(Dim == 2 ? 48 : 16);
  PressureCase<Dim> c = slope_case<Dim>(cells, 10);
  Sequence random{5};
  for_each_index<Dim>(cells, [&](const Index<Dim>& i) {
    const Index<Dim> below = shifted<Dim>(i, Dim - 1, -1);
    if (c.kind[i] != CellKind::open || i[Dim - 1] == 0 || c.kind[below] == CellKind::open) return;
    if (random() < 0.3) return;
    c.kind[i] = CellKind::core;
    heavy.push_back({i, c.density[i] * c.grid.cell_volume() * std::pow(10, 4 * random() - 2)});
  });
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    if (c.open[axis][face] > 0 && !c.is_free(axis, face)) c.u[axis][face] = random() - 0.5;
  });
  return c;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("yielding faces: divergence-free, moved by the pressure beside them, few iterations", "[yield]",
                       ((int Dim), Dim), 2, 3) {
  std::vector<HeavyCell<Dim>> heavy;
  PressureCase<Dim> c = core_on_slope<Dim>(heavy);
  REQUIRE(heavy.size() > 10);
  const FaceField<Dim> before = c.u;
  PressureProjection<Dim> projection(c.grid, c.sides);
  const ProjectionResult result = projection.project(c.u, c.density, c.open, c.kind, c.dt, {1e-10, 100}, heavy);
  CHECK(result.converged);
  CHECK(result.iterations <= 25);
  CHECK(c.largest_outflow() < 1e-7);
  double worst = 0;
  for (const HeavyCell<Dim>& core : heavy)
    for_each_open_neighbour<Dim>(
        core.cell, c.open, c.kind, [&](int axis, const Index<Dim>& face, const auto& cell, int sign) {
          const double impulse = projection.pressure(cell) * c.open[axis][face] * c.grid.face_area() * c.dt;
          worst = std::max(worst, std::abs(c.u[axis][face] - before[axis][face] + sign * impulse / core.mass));
        });
  CHECK(worst < 1e-9);
}

TEMPLATE_TEST_CASE_SIG("an infinitely heavy core is a moving wall", "[yield]", ((int Dim), Dim), 2, 3) {
  std::vector<HeavyCell<Dim>> heavy;
  PressureCase<Dim> c = core_on_slope<Dim>(heavy);
  for (HeavyCell<Dim>& core : heavy) core.mass = 1e18;
  PressureCase<Dim> wall = c;
  PressureProjection<Dim> projection(c.grid, c.sides), reference(c.grid, c.sides);
  projection.project(c.u, c.density, c.open, c.kind, c.dt, {1e-10, 100}, heavy);
  wall.project(reference, {1e-10, 100});
  double difference = 0;
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    difference = std::max(difference, std::abs(c.u[axis][face] - wall.u[axis][face]));
  });
  CHECK(difference < 1e-8);
}

TEMPLATE_TEST_CASE_SIG("a weightless core lets the air have its way", "[yield]", ((int Dim), Dim), 2, 3) {
  // A core cell of almost no mass cannot hold pressure: it goes with the air that it was set against.
  Index<Dim> cells;
  cells.fill(8);
  PressureCase<Dim> c(cells, 1, all_sides<Dim>(Side::closed));
  Index<Dim> core;
  core.fill(4);
  c.kind[core] = CellKind::core;
  for (int axis = 0; axis < Dim; ++axis)
    for (int side = 0; side < 2; ++side) c.u[axis][shifted<Dim>(core, axis, side)] = axis == 0 && side == 0 ? 1 : 0;
  PressureProjection<Dim> projection(c.grid, c.sides);
  const std::vector<HeavyCell<Dim>> heavy{{core, 1e-6}};
  const ProjectionResult result = projection.project(c.u, c.density, c.open, c.kind, c.dt, {1e-10, 100}, heavy);
  CHECK(result.unmatched_flux == 0);  // the closed box has an outlet: the core
  CHECK(c.largest_outflow() < 1e-7);
  double largest = 0;
  const Field<Dim> pressure = projection.pressure();
  for (const double p : pressure.values()) largest = std::max(largest, std::abs(p));
  CHECK(largest * c.dt < 1.5);  // of the order of the impulse that turns the air, rho u dx
}
