/// Properties of the pressure projection.

#include <catch2/catch.hpp>
#include <limits>

#include "grid/pressure_case.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

template <int Dim>
Index<Dim> cube(int n) {
  Index<Dim> cells;
  cells.fill(n);
  return cells;
}

template <int Dim>
bool same_bits(const FaceField<Dim>& a, const FaceField<Dim>& b) {
  for (int axis = 0; axis < Dim; ++axis) {
    if (!std::equal(a[axis].values().begin(), a[axis].values().end(), b[axis].values().begin())) return false;
  }
  return true;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a uniform stream in a closed column stops", "[projection]", ((int Dim), Dim), 2, 3) {
  Index<Dim> cells = cube<Dim>(1);
  const int axis = GENERATE(range(0, Dim));
  cells[axis] = GENERATE(2, 3, 8, 21);
  PressureCase<Dim> c(cells, 0.25, all_sides<Dim>(Side::closed));
  c.density = Field<Dim>(cells, 2.0);
  c.set_velocity([&](int k, const Vec<Dim>&) { return k == axis ? 3.0 : 0.0; });
  PressureProjection<Dim> projection(c.grid, c.sides);
  CHECK(c.project(projection, {1e-12, 100}).converged);
  CHECK(c.largest_speed() <= 1e-10);
  Index<Dim> i{};
  for (i[axis] = 0; i[axis] + 1 < cells[axis]; ++i[axis]) {
    const double rise = projection.pressure(shifted<Dim>(i, axis, 1)) - projection.pressure(i);
    CHECK(rise == Approx(2.0 * 0.25 * 3.0 / c.dt));
  }
}

TEMPLATE_TEST_CASE_SIG("beyond an open side the pressure is zero on the side's face", "[projection]", ((int Dim), Dim),
                       2, 3) {
  Index<Dim> cells = cube<Dim>(1);
  const int axis = Dim - 1;
  cells[axis] = GENERATE(1, 2, 5);
  PressureCase<Dim> c(cells, 0.5, all_sides<Dim>(Side::closed));
  c.sides[axis][1] = Side::open;
  c.set_velocity([&](int k, const Vec<Dim>&) { return k == axis ? 1.0 : 0.0; });
  PressureProjection<Dim> projection(c.grid, c.sides);
  c.project(projection, {1e-13, 100});
  CHECK(c.largest_speed() <= 1e-11);
  Index<Dim> i{};
  for (; i[axis] < cells[axis]; ++i[axis]) {
    const double depth = c.grid.box().upper[axis] - c.grid.cell_centre(i)[axis];
    CHECK(projection.pressure(i) == Approx(-1.0 * depth / c.dt));
  }
}

TEMPLATE_TEST_CASE_SIG("projecting twice is projecting once", "[projection]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c = slope_case<Dim>(cube<Dim>(Dim == 2 ? 40 : 20), 10);
  PressureProjection<Dim> projection(c.grid, c.sides);
  const double speed = c.largest_speed();
  REQUIRE(c.project(projection, {1e-10, 100}).converged);
  CHECK(c.largest_outflow() <= 1e-9 * speed);
  const FaceField<Dim> once = c.u;
  REQUIRE(c.project(projection, {1e-10, 100}).converged);
  double change = 0;
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    change = std::max(change, std::abs(c.u[axis][face] - once[axis][face]));
  });
  CHECK(change <= 1e-8 * speed);
}

TEMPLATE_TEST_CASE_SIG("stratified fluid at rest stays at rest under gravity", "[projection]", ((int Dim), Dim), 2, 3) {
  const Side top = GENERATE(Side::closed, Side::open);
  const double ratio = GENERATE(1.0, 10.0, 1e4);
  const Index<Dim> cells = cube<Dim>(Dim == 2 ? 33 : 14);
  PressureCase<Dim> c = slope_case<Dim>(cells, 1);
  c.sides = all_sides<Dim>(Side::closed);
  c.sides[Dim - 1][1] = top;
  for_each_index<Dim>(cells, [&](const Index<Dim>& i) {
    c.density[i] = 1.2 * std::pow(ratio, 1 - static_cast<double>(i[Dim - 1]) / (cells[Dim - 1] - 1));
  });
  c.set_velocity([&](int axis, const Vec<Dim>&) { return axis == Dim - 1 ? -9.81 * c.dt : 0.0; });
  PressureProjection<Dim> projection(c.grid, c.sides);
  CHECK(c.project(projection, {1e-12, 200}).converged);
  CHECK(c.largest_speed() <= 1e-8 * 9.81 * c.dt);
}

TEMPLATE_TEST_CASE_SIG("a heavy body released from rest falls against the air that it must push away",
                       "[projection][slow]", ((int Dim), Dim), 2, 3) {
  const double r_s = GENERATE(0.2, 0.9, 0.9999);
  const int n = Dim == 2 ? 240 : 112;
  const double radius = 12;
  PressureCase<Dim> c(cube<Dim>(n), 1.0, all_sides<Dim>(Side::closed));
  const Vec<Dim> centre = Vec<Dim>::Constant(0.5 * n);
  const double excess = r_s / (1 - r_s);
  Field<Dim> share(c.grid.cells, 0.0);  // of the body in each cell; its rim is spread over one cell
  for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
    const double distance = (c.grid.cell_centre(i) - centre).norm();
    share[i] = std::clamp(radius - distance + 0.5, 0.0, 1.0);
    c.density[i] = 1 + excess * share[i];
  });
  c.set_velocity([&](int axis, const Vec<Dim>&) { return axis == Dim - 1 ? -c.dt : 0.0; });
  PressureProjection<Dim> projection(c.grid, c.sides);
  REQUIRE(c.project(projection, {1e-6, 100}).converged);
  double sum = 0;
  int n_inside = 0;
  for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
    if (share[i] < 1) return;
    sum += 0.5 * (c.u[Dim - 1][i] + c.u[Dim - 1][shifted<Dim>(i, Dim - 1, 1)]);
    ++n_inside;
  });
  const double expected = Dim == 2 ? r_s / (2 - r_s) : 2 * r_s / (3 - r_s);
  const double acceleration = -sum / (n_inside * c.dt);  // in g
  INFO("r_s " << r_s << ": " << acceleration << ", expected " << expected);
  CHECK(acceleration == Approx(expected).epsilon(0.02));
}

TEMPLATE_TEST_CASE_SIG("a moving core pushes air out through an open side", "[projection]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c(cube<Dim>(8), 1.0, all_sides<Dim>(Side::closed));
  c.sides[0][1] = Side::open;
  double pushed = 0;
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    if (axis == 0 && face[0] == 2) pushed += c.u[0][face] = 0.5;
  });
  for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
    if (i[0] < 2) c.kind[i] = CellKind::core;
  });
  PressureProjection<Dim> projection(c.grid, c.sides);
  CHECK(c.project(projection, {1e-12, 100}).unmatched_flux == 0);
  CHECK(c.largest_outflow() <= 1e-11);
  double left = 0, kept = 0;
  for_each_index<Dim>(c.grid.faces(0), [&](const Index<Dim>& face) {
    if (face[0] == 8) left += c.u[0][face];
    if (face[0] == 2) kept += c.u[0][face];
  });
  CHECK(left == Approx(pushed));
  CHECK(kept == pushed);
}

TEMPLATE_TEST_CASE_SIG("flux that a sealed box cannot match stays as uniform divergence and is reported",
                       "[projection]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c(cube<Dim>(8), 1.0, all_sides<Dim>(Side::closed));
  for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
    if (i[0] < 2) c.kind[i] = CellKind::core;
  });
  for_each_index<Dim>(c.grid.faces(0), [&](const Index<Dim>& face) {
    if (face[0] == 2) c.u[0][face] = 0.6;
  });
  PressureProjection<Dim> projection(c.grid, c.sides);
  const ProjectionResult result = c.project(projection, {1e-12, 100});
  CHECK(result.converged);
  CHECK(result.unmatched_flux == Approx(0.1));
  double pressure = 0;
  for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
    if (c.kind[i] != CellKind::open) return;
    CHECK(c.outflow(i) == Approx(-0.1));
    pressure += projection.pressure(i);
  });
  CHECK(std::abs(pressure) <= 1e-9 * std::abs(projection.pressure(Index<Dim>{2})));
}

TEMPLATE_TEST_CASE_SIG("fixed faces keep their bits", "[projection]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c = random_case<Dim>(cube<Dim>(9), all_sides<Dim>(Side::open), 5);
  c.sides[0][0] = Side::closed;
  const FaceField<Dim> before = c.u;
  PressureProjection<Dim> projection(c.grid, c.sides);
  c.project(projection);
  std::size_t n_free_changed = 0;
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    if (!c.is_free(axis, face)) {
      CHECK(c.u[axis][face] == before[axis][face]);
    } else {
      n_free_changed += c.u[axis][face] != before[axis][face];
    }
  });
  CHECK(n_free_changed > 0);
}

TEMPLATE_TEST_CASE_SIG("grids of one cell, all solid, all core, at rest", "[projection]", ((int Dim), Dim), 2, 3) {
  const Side side = GENERATE(Side::open, Side::closed);
  const CellKind kind = GENERATE(CellKind::open, CellKind::solid, CellKind::core, CellKind::pocket);
  Index<Dim> cells = cube<Dim>(1);
  cells[GENERATE(range(0, Dim))] = GENERATE(1, 2, 5);
  PressureCase<Dim> c(cells, 1.0, all_sides<Dim>(side));
  c.kind = Field<Dim, CellKind>(cells, kind);
  PressureProjection<Dim> projection(c.grid, c.sides);
  const ProjectionResult at_rest = c.project(projection);
  CHECK((at_rest.iterations == 0 && at_rest.residual == 0 && at_rest.converged));
  CHECK(c.largest_speed() == 0);

  Sequence random{7};
  c.for_each_face([&](int axis, const Index<Dim>& face) { c.u[axis][face] = random() - 0.5; });
  const FaceField<Dim> before = c.u;
  const ProjectionResult result = c.project(projection, {1e-12, 100});
  CHECK(result.converged);
  if (kind != CellKind::open) CHECK(same_bits<Dim>(c.u, before));
  if (kind == CellKind::open && side == Side::open) CHECK(c.largest_outflow() <= 1e-10);
}

TEMPLATE_TEST_CASE_SIG("values that are not finite are refused and leave no trace", "[projection]", ((int Dim), Dim), 2,
                       3) {
  const double bad = GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  const PressureCase<Dim> good = slope_case<Dim>(cube<Dim>(12), 3);
  PressureCase<Dim> c = good;
  PressureProjection<Dim> projection(c.grid, c.sides);
  c.u[0][cube<Dim>(11)] = bad;
  const FaceField<Dim> before = c.u;
  CHECK_FALSE(c.project(projection).converged);
  c.u[0][cube<Dim>(11)] = good.u[0][cube<Dim>(11)];
  CHECK(same_bits<Dim>(c.u, good.u));
  CHECK(c.project(projection, {1e-10, 100}).converged);
  CHECK(c.largest_outflow() <= 1e-9);
}

TEMPLATE_TEST_CASE_SIG("a solve cut short says so", "[projection]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c = slope_case<Dim>(cube<Dim>(12), 3);
  PressureProjection<Dim> projection(c.grid, c.sides);
  const ProjectionResult result = c.project(projection, {1e-10, 2});
  CHECK(result.iterations == 2);
  CHECK_FALSE(result.converged);
  CHECK(result.residual > 1e-10);
}

TEMPLATE_TEST_CASE_SIG("the last pressure saves iterations", "[projection]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c = slope_case<Dim>(cube<Dim>(24), 3);
  const FaceField<Dim> u = c.u;
  PressureProjection<Dim> projection(c.grid, c.sides);
  const ProjectionResult cold = c.project(projection, {1e-6, 100});
  c.u = u;
  c.for_each_face([&](int axis, const Index<Dim>& face) { c.u[axis][face] *= 1.001; });
  CHECK(c.project(projection, {1e-6, 100}).iterations < cold.iterations);
  c.u = u;
  CHECK(c.project(projection, {1e-2, 100}).iterations == 0);
  CHECK(c.largest_outflow() < 0.1 * c.largest_speed());
}

TEMPLATE_TEST_CASE_SIG("a step leaves nothing behind but the pressure", "[projection]", ((int Dim), Dim), 2, 3) {
  const Index<Dim> cells = cube<Dim>(15);
  PressureCase<Dim> first = random_case<Dim>(cells, all_sides<Dim>(Side::open), 1);
  PressureCase<Dim> warm = slope_case<Dim>(cells, 3);
  warm.sides = first.sides;
  PressureCase<Dim> fresh = warm;
  PressureProjection<Dim> used(first.grid, first.sides), unused(first.grid, first.sides);
  first.project(used);
  unused.set_pressure(used.pressure());
  warm.project(used);
  fresh.project(unused);
  CHECK(same_bits<Dim>(warm.u, fresh.u));
  const Field<Dim> p = used.pressure(), q = unused.pressure();
  CHECK(std::equal(p.values().begin(), p.values().end(), q.values().begin()));
}

TEMPLATE_TEST_CASE_SIG("a guess that is set is all that is left of a solve that went astray", "[projection]",
                       ((int Dim), Dim), 2, 3) {
  const PressureCase<Dim> good = slope_case<Dim>(cube<Dim>(12), 3);
  PressureProjection<Dim> used(good.grid, good.sides), unused(good.grid, good.sides);
  PressureCase<Dim> c = good;
  c.project(used);
  const std::vector<double> guess = used.guess();
  c.density[cube<Dim>(11)] = std::numeric_limits<double>::quiet_NaN();
  CHECK_FALSE(c.project(used).converged);
  used.set_guess(guess);
  unused.set_guess(guess);
  PressureCase<Dim> again = good, fresh = good;
  again.for_each_face([&](int axis, const Index<Dim>& face) { fresh.u[axis][face] = again.u[axis][face] *= 1.5; });
  CHECK(again.project(used, {1e-10, 100}).converged);
  fresh.project(unused, {1e-10, 100});
  CHECK(same_bits<Dim>(again.u, fresh.u));
}

TEMPLATE_TEST_CASE_SIG("the same bits with any number of threads", "[projection]", ((int Dim), Dim), 2, 3) {
  const auto run = [](int threads) {
    const ThreadLimit limit(threads);
    PressureCase<Dim> c = slope_case<Dim>(cube<Dim>(Dim == 2 ? 250 : 50), 10);
    PressureProjection<Dim> projection(c.grid, c.sides);
    c.project(projection, {1e-8, 100});
    return c.u;
  };
  const FaceField<Dim> one = run(1);
  CHECK(same_bits<Dim>(one, run(2)));
  CHECK(same_bits<Dim>(one, run(4)));
}

TEMPLATE_TEST_CASE_SIG("a warm projection allocates nothing", "[projection]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c = slope_case<Dim>(cube<Dim>(30), 10);
  PressureProjection<Dim> projection(c.grid, c.sides);
  const FaceField<Dim> u = c.u;
  c.project(projection);
  const std::size_t bytes = projection.bytes();
  for (int step = 0; step < 3; ++step) {
    c.u = u;
    c.project(projection);
    CHECK(projection.bytes() == bytes);
  }
}
