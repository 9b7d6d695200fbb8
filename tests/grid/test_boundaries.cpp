#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "suspension_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;
using std::numbers::pi;

TEMPLATE_TEST_CASE_SIG("a moving core pushes air, and air, core and walls exchange momentum without loss",
                       "[suspension]", ((int Dim), Dim), 2, 3) {
  const bool moving = GENERATE(true, false);
  const int n = 12;
  const MacGrid<Dim> grid = box_grid<Dim>(n, 6.0);
  SuspensionOptions<Dim> options = exact_options<Dim>();
  options.moving_core = moving;
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), options);
  air.set_velocity(
      swirl<Dim>(grid, [](double x, double z) { return 0.3 * std::sin(pi * x / 6) * std::sin(pi * z / 6); }));
  std::vector<CoreCell<Dim>> cores(2);
  for (int k = 0; k < 2; ++k) {
    cores[static_cast<std::size_t>(k)].cell.fill(5);
    cores[static_cast<std::size_t>(k)].cell[0] += k;
    cores[static_cast<std::size_t>(k)].mass = 1e9;  // nothing stops it
    cores[static_cast<std::size_t>(k)].velocity = 4 * Vec<Dim>::Unit(0);
  }
  const Vec<Dim> before = air.momentum();
  const double dt = 0.01;
  Stages stages;
  air.advance(dt, cores, stages);
  const auto& b = air.budget();
  Vec<Dim> core = Vec<Dim>::Zero(), walls = Vec<Dim>::Zero();
  for (const auto& c : cores) core += c.impulse;
  const Field<Dim> pressure = air.pressure();
  for (int axis = 0; axis < Dim; ++axis) {
    for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
      const double push = pressure[i] * grid.face_area() * dt;
      if (i[axis] == 0) walls[axis] += push;
      if (i[axis] == n - 1) walls[axis] -= push;
    });
  }
  CHECK((air.momentum() - before - b.advection + core - walls).norm() < 1e-9);
  CHECK((core - (b.core_pressure - b.core)).norm() < 1e-12);
  CHECK(core[0] * (moving ? -1 : 1) > 0);
  Index<Dim> ahead;
  ahead.fill(5);
  ahead[0] = 7;
  CHECK(air.velocity()[0][ahead] == Approx(moving ? 4 : 0));
  if (moving) CHECK(air.velocity()[0][shifted<Dim>(ahead, 0, 1)] > 0.1);
  for (int axis = 0; axis < Dim; ++axis) CHECK(air.active_faces()[axis][cores[0].cell] == 0);
  CHECK(air.active_faces()[0][shifted<Dim>(ahead, 0, 1)] == 1);

  air.advance(dt, {}, stages);  // uncovered cells start with the core's velocity
  CHECK(air.active_faces()[0][cores[0].cell] == 1);
  CHECK(air.max_speed() > 0);
}

TEMPLATE_TEST_CASE_SIG("smoke leaves a cell that becomes core, or adheres", "[suspension]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(5);
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), exact_options<Dim>());
  Field<Dim> smoke(grid.cells);
  Index<Dim> middle;
  middle.fill(2);
  smoke[middle] = 1.2;
  Stages stages;
  std::vector<CoreCell<Dim>> one(1);
  one[0].cell = middle;
  one[0].mass = 50;
  air.set_smoke_mass(smoke);
  air.advance(0.01, one, stages);
  CHECK(one[0].adhered == 0);
  CHECK(air.smoke_mass()[middle] == 0);
  CHECK(air.smoke_mass()[shifted<Dim>(middle, 0, 1)] == Approx(1.2 / (2 * Dim)));
  CHECK(air.total_smoke() == Approx(1.2).epsilon(1e-14));

  std::vector<CoreCell<Dim>> block;
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
    if ((i[0] - 2) * (i[0] - 2) <= 1) {
      CoreCell<Dim> core;
      core.cell = i;
      core.mass = 50;
      block.push_back(core);
    }
  });
  air.set_smoke_mass(smoke);
  air.set_velocity(make_face_field<Dim>(grid, 2.0));
  air.advance(0.01, block, stages);
  double adhered = 0;
  for (const auto& core : block) {
    adhered += core.adhered;
    if (core.cell == middle) CHECK(core.adhered_momentum[0] == Approx(1.2 * 2));
  }
  CHECK(adhered == Approx(1.2));
  CHECK(air.total_smoke() == 0);
}

TEMPLATE_TEST_CASE_SIG("slivers between core and ground make no jets", "[suspension]", ((int Dim), Dim), 2, 3) {
  const int n = 12;
  const MacGrid<Dim> grid = box_grid<Dim>(n, 6.0);
  auto sides = all_sides<Dim>(Side::closed);
  sides[Dim - 1][1] = Side::open;
  Suspension<Dim> air(grid, sides, exact_options<Dim>());
  Field<Dim> distance(grid.nodes());
  for_each_index<Dim>(grid.nodes(),
                      [&](const Index<Dim>& i) { distance[i] = grid.node(i)[Dim - 1] - 2.73 + 0.3 * grid.node(i)[0]; });
  air.set_ground(distance);
  std::vector<CoreCell<Dim>> cores;
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
    const double volume = air.ground().volume()[i];
    if (i[0] < 3 || i[0] > 8 || volume <= 0 || air.ground().is_small(volume)) return;
    if (!air.ground().is_small(air.ground().volume()[shifted<Dim>(i, Dim - 1, -1)])) return;
    CoreCell<Dim> core;
    core.cell = i;
    core.mass = 1e6;
    core.velocity = 2 * Vec<Dim>::Unit(0);
    cores.push_back(core);
  });
  REQUIRE(cores.size() >= 6);
  Stages stages;
  air.advance(0.01, cores, stages);
  std::size_t n_pockets = 0;
  for (const std::uint32_t cell : air.ground().small_cells()) n_pockets += air.kind()[cell] == CellKind::pocket;
  CHECK(n_pockets >= 3);
  double jet = 0;
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < air.velocity()[axis].size(); ++f)
      if (air.ground().open()[axis][f] > 0) jet = std::max(jet, std::abs(air.velocity()[axis][f]));
  CHECK(jet < 5 * 2);
}

TEMPLATE_TEST_CASE_SIG("a uniform stream along a slope through the grid stays (B13)", "[suspension]", ((int Dim), Dim),
                       2, 3) {
  const double angle = GENERATE(0.0, 15.0, 30.0, 45.0) * pi / 180;
  const int n = Dim == 2 ? 40 : 16;
  const MacGrid<Dim> grid = box_grid<Dim>(n, 10.0);
  SuspensionOptions<Dim> options = exact_options<Dim>();
  options.pressure.tolerance = 1e-8;
  auto sides = all_sides<Dim>(Side::open);
  if (Dim == 3) sides[1].fill(Side::closed);
  const Vec<Dim> along = std::cos(angle) * Vec<Dim>::Unit(0) - std::sin(angle) * up<Dim>();
  options.wind = along;
  Suspension<Dim> air(grid, sides, options);
  const Vec<Dim> normal = std::sin(angle) * Vec<Dim>::Unit(0) + std::cos(angle) * up<Dim>();
  Field<Dim> distance(grid.nodes());
  for_each_index<Dim>(grid.nodes(),
                      [&](const Index<Dim>& i) { distance[i] = normal.dot(grid.node(i) - Vec<Dim>::Constant(4.93)); });
  air.set_ground(distance);
  air.set_velocity(face_velocity<Dim>(grid, [&](const Vec<Dim>&) { return along; }));
  const double before = air.momentum().dot(along);
  Stages stages;
  const int steps = n;  // one length of the box
  for (int step = 0; step < steps; ++step) air.advance(grid.dx, {}, stages);
  CHECK(air.momentum().dot(along) == Approx(before).epsilon(0.01));
  double worst = 0;
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < air.velocity()[axis].size(); ++f)
      if (air.ground().open()[axis][f] > 0.3 && air.active_faces()[axis][f])
        worst = std::max(worst, std::abs(air.velocity()[axis][f] - along[axis]));
  CHECK(worst < 0.05);
}

TEMPLATE_TEST_CASE_SIG("Open sides let in ambient air: hand-computed shares", "[suspension]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(4, 2.0);  // dx 0.5
  const auto uniform = [&](double along, double across) {
    return face_velocity<Dim>(grid, [&](const Vec<Dim>&) {
      Vec<Dim> u = Vec<Dim>::Constant(across);
      u[0] = along;
      return u;
    });
  };
  const FaceField<Dim> area = face_velocity<Dim>(grid, [](const Vec<Dim>&) { return Vec<Dim>::Ones(); });
  auto sides = all_sides<Dim>(Side::closed);
  sides[0].fill(Side::open);
  Vec<Dim> wind = Vec<Dim>::Zero();
  wind[0] = 1;
  const FaceField<Dim> carrier = uniform(2, 0);  // 2 m/s for 0.1 s: 0.4 of a cell, in through the lower side
  FaceField<Dim> u = uniform(3, 5);
  let_in_ambient_air<Dim>(u, carrier, area, grid, sides, wind, 0.1);
  Index<Dim> first;
  first.fill(2);
  first[0] = 0;
  CHECK(u[0][first] == Approx(3 - 0.4 * (3 - 1)));
  CHECK(u[Dim - 1][first] == Approx(5 - 0.4 * 5));
  CHECK(u[0][shifted<Dim>(first, 0, 1)] == 3);
  CHECK(u[Dim - 1][shifted<Dim>(first, 0, 1)] == 5);
  CHECK(u[0][shifted<Dim>(first, 0, 4)] == 3);  // outflow
  CHECK(u[Dim - 1][shifted<Dim>(first, 0, 3)] == 5);
  let_in_ambient_air<Dim>(u, carrier, area, grid, sides, wind, 100);
  CHECK(u[0][first] == 1);
}

TEMPLATE_TEST_CASE_SIG("An inflow through an open side does not feed itself", "[suspension]", ((int Dim), Dim), 2, 3) {
  // Air sucked out at the top of a channel whose lower end is open, then left alone: its energy may only fall.
  const int n = Dim == 2 ? 24 : 12;
  const MacGrid<Dim> grid = box_grid<Dim>(n, 8.0);
  auto sides = all_sides<Dim>(Side::closed);
  sides[0].fill(Side::open);
  Suspension<Dim> air(grid, sides, exact_options<Dim>());
  air.set_velocity(swirl<Dim>(grid, [&](double x, double z) { return 4 * z + std::sin(0.7 * z) * std::cos(0.9 * x); }));
  const auto energy = [&] {
    double sum = 0;
    for (int axis = 0; axis < Dim; ++axis)
      for (const double u : air.velocity()[axis].values()) sum += u * u;
    return sum;
  };
  Stages stages;
  double last = energy(), first = last;
  for (int step = 0; step < 60; ++step) {
    air.advance(0.5 * grid.dx / air.max_speed(), {}, stages);
    CHECK(energy() <= last * (1 + 1e-3));
    last = energy();
  }
  CHECK(last < 0.7 * first);
}
