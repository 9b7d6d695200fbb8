#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "suspension_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;
using std::numbers::pi;

namespace {

template <int Dim>
Field<Dim> stratified(const MacGrid<Dim>& grid, bool uniform) {
  Field<Dim> smoke(grid.cells);
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
    smoke[i] = grid.cell_volume() * (uniform ? 30 : 40 * std::exp(-5 * grid.cell_centre(i)[Dim - 1]));
  });
  return smoke;
}

template <int Dim>
bool same(const Suspension<Dim>& a, const Suspension<Dim>& b) {
  for (int axis = 0; axis < Dim; ++axis)
    if (!std::ranges::equal(a.velocity()[axis].values(), b.velocity()[axis].values())) return false;
  return std::ranges::equal(a.smoke_mass().values(), b.smoke_mass().values()) &&
         std::ranges::equal(a.kind().values(), b.kind().values());
}

/// A heap of smoke that falls on sloping ground, with a core that moves through it and vanishes.
template <int Dim>
struct Heap {
  MacGrid<Dim> grid = box_grid<Dim>(Dim == 2 ? 32 : 12, 8.0);
  Stages stages;
  std::vector<CoreCell<Dim>> cores;
  Suspension<Dim> air;

  Heap() : air(grid, sides(), options()) {
    Field<Dim> distance(grid.nodes()), smoke(grid.cells);
    for_each_index<Dim>(grid.nodes(), [&](const Index<Dim>& i) {
      distance[i] = (grid.node(i)[Dim - 1] - 3 + 0.4 * grid.node(i)[0]) / std::sqrt(1.16);
    });
    air.set_ground(distance);
    for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
      if ((grid.cell_centre(i) - Vec<Dim>::Constant(4)).norm() < 1.5) smoke[i] = 5 * air.ground().volume()[i];
    });
    air.set_smoke_mass(smoke);
  }
  static auto sides() {
    auto s = all_sides<Dim>(Side::closed);
    s[0].fill(Side::open);
    s[Dim - 1][1] = Side::open;
    return s;
  }
  static SuspensionOptions<Dim> options() {
    SuspensionOptions<Dim> o;
    o.confinement = 0.1;
    return o;
  }
  Vec<Dim> pull = Vec<Dim>::Zero();  ///< of gravity in the last step

  void step(int n) {
    cores.clear();
    if (n >= 2 && n < 8) {
      for (int k = 0; k < 3; ++k) {
        CoreCell<Dim> core;
        core.cell.fill(grid.cells[0] / 2);
        core.cell[0] += k + n / 3;
        core.velocity = 3 * Vec<Dim>::Unit(0);
        core.mass = 10;
        cores.push_back(core);
      }
    }
    pull = air.add_gravity(0.02);
    air.advance(0.02, cores, stages);
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("air without smoke, movement or core costs nothing and stays", "[suspension]", ((int Dim), Dim),
                       2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(8);
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), {});
  Stages stages;
  for (int step = 0; step < 3; ++step) {
    CHECK(air.add_gravity(0.01).isZero());
    air.advance(0.01, {}, stages);
  }
  CHECK(stages.all().empty());
  CHECK(largest<Dim>(air.velocity()) == 0);
}

TEMPLATE_TEST_CASE_SIG("smoke at rest stays at rest (B2)", "[suspension]", ((int Dim), Dim), 2, 3) {
  const bool uniform = GENERATE(true, false);
  const MacGrid<Dim> grid = box_grid<Dim>(8);
  SuspensionOptions<Dim> options = exact_options<Dim>();
  options.gravity = -9.81 * up<Dim>();
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), options);
  const Field<Dim> smoke = stratified<Dim>(grid, uniform);
  air.set_smoke_mass(smoke);
  Stages stages;
  for (int step = 0; step < 100; ++step) {
    air.add_gravity(0.01);
    air.advance(0.01, {}, stages);
  }
  CHECK(largest<Dim>(air.velocity()) < 1e-12);
  for (std::size_t c = 0; c < smoke.size(); ++c) REQUIRE(air.smoke_mass()[c] == Approx(smoke[c]).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("smoke at rest stays at rest for 1,000 steps (B2)", "[suspension][slow]", ((int Dim), Dim), 2,
                       3) {
  const MacGrid<Dim> grid = box_grid<Dim>(Dim == 2 ? 32 : 12);
  SuspensionOptions<Dim> options = exact_options<Dim>();
  options.gravity = -9.81 * up<Dim>();
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), options);
  air.set_smoke_mass(stratified<Dim>(grid, false));
  Stages stages;
  for (int step = 0; step < 1000; ++step) {
    air.add_gravity(0.01);
    air.advance(0.01, {}, stages);
  }
  CHECK(largest<Dim>(air.velocity()) < 1e-12);
}

TEMPLATE_TEST_CASE_SIG("gravity pulls on the smoke alone: momentum dt g m", "[suspension]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(6);
  SuspensionOptions<Dim> options;
  options.gravity = 2 * Vec<Dim>::Unit(0) - 9 * up<Dim>();
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), options);
  Field<Dim> smoke(grid.cells);
  Index<Dim> cell;
  cell.fill(3);
  smoke[cell] = 0.7;
  air.set_smoke_mass(smoke);
  const Vec<Dim> before = air.momentum(), change = air.add_gravity(0.1);
  CHECK((change - 0.1 * 0.7 * options.gravity).norm() < 1e-14);
  CHECK((air.momentum() - before - change).norm() < 1e-14);
  const double r = air.smoke_density(flat<Dim>(cell, grid.cells)) / 2;
  CHECK(air.velocity()[0][cell] == Approx(0.1 * 2 * r / (1.2 + r)));
}

TEMPLATE_TEST_CASE_SIG("sources change momentum by what they say", "[suspension]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(5);
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), {});
  air.set_velocity(make_face_field<Dim>(grid, 0.5));
  GridSources<Dim> sources;
  Index<Dim> cell;
  cell.fill(2);
  sources.smoke.push_back({flat<Dim>(cell, grid.cells), 0.3});
  Vec<Dim> total = Vec<Dim>::Zero();
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      sources.momentum[axis].push_back(
          {flat<Dim>(shifted<Dim>(cell, axis, side), grid.faces(axis)), 0.1 * (axis + 1) + side});
      total[axis] += 0.1 * (axis + 1) + side;
    }
  }
  const Vec<Dim> before = air.momentum(), change = air.apply(sources);
  CHECK((change - total).norm() < 1e-14);
  CHECK((air.momentum() - before - total).norm() < 1e-13);
  CHECK(air.total_smoke() == Approx(0.3));
}

TEMPLATE_TEST_CASE_SIG("a closed box keeps its smoke to 1e-12, never negative", "[suspension]", ((int Dim), Dim), 2,
                       3) {
  const double cfl = GENERATE(0.5, 5.0);
  const MacGrid<Dim> grid = box_grid<Dim>(Dim == 2 ? 24 : 10);
  SuspensionOptions<Dim> options;
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), options);
  air.set_smoke_mass(stratified<Dim>(grid, false));
  air.set_velocity(swirl<Dim>(grid, [](double x, double z) { return std::sin(pi * x) * std::sin(pi * z); }));
  const double start = air.total_smoke();
  Stages stages;
  for (int step = 0; step < 40; ++step) {
    const double dt = cfl * grid.dx / air.max_speed();
    air.add_gravity(dt);
    air.advance(dt, {}, stages);
    REQUIRE(air.total_smoke() == Approx(start).epsilon(1e-12));
    REQUIRE(std::ranges::none_of(air.smoke_mass().values(), [](double m) { return !(m >= 0); }));
  }
  CHECK(air.max_speed() < 1e3);
}

TEMPLATE_TEST_CASE_SIG("the budget's entries add up to the change of momentum", "[suspension]", ((int Dim), Dim), 2,
                       3) {
  Heap<Dim> heap;
  double outflow = 0, adhered = 0;
  const double start = heap.air.total_smoke();
  for (int n = 0; n < 12; ++n) {
    const Vec<Dim> before = heap.air.momentum();
    heap.step(n);
    const auto& b = heap.air.budget();
    outflow += b.outflow;
    for (const auto& core : heap.cores) adhered += core.adhered;
    const Vec<Dim> sum = b.core + b.advection + b.smoke + b.diffusion + b.confinement + b.projection;
    const Vec<Dim> now = heap.air.momentum();
    CHECK((now - before - heap.pull - sum).norm() < 1e-11 * (1 + now.norm()));
    CHECK(b.pressure.converged);
  }
  CHECK(heap.air.total_smoke() + outflow + adhered == Approx(start).epsilon(1e-12));
  CHECK(heap.air.max_speed() > 0.1);
}

TEMPLATE_TEST_CASE_SIG("the number of threads changes no bit", "[suspension]", ((int Dim), Dim), 2, 3) {
  const auto run = [](int n_threads) {
    const ThreadLimit limit(n_threads);
    Heap<Dim> heap;
    for (int n = 0; n < 6; ++n) heap.step(n);
    return heap;
  };
  const Heap<Dim> one = run(1), two = run(2), four = run(4);
  CHECK(same(one.air, two.air));
  CHECK(same(one.air, four.air));
  CHECK(one.air.budget().projection == four.air.budget().projection);
}

TEMPLATE_TEST_CASE_SIG("a stored state goes on to the bit", "[suspension]", ((int Dim), Dim), 2, 3) {
  Heap<Dim> heap, restarted;
  for (int n = 0; n < 5; ++n) heap.step(n);
  restarted.air.set_velocity(heap.air.velocity());
  restarted.air.set_smoke_mass(heap.air.smoke_mass());
  restarted.air.set_kind(heap.air.kind());
  restarted.air.set_pressure(heap.air.pressure());
  for (int n = 5; n < 12; ++n) heap.step(n), restarted.step(n);
  CHECK(same(heap.air, restarted.air));
}

TEMPLATE_TEST_CASE_SIG("a warm step allocates nothing", "[suspension]", ((int Dim), Dim), 2, 3) {
  Heap<Dim> heap;
  for (int n = 0; n < 10; ++n) heap.step(n);
  const std::size_t warm = heap.air.bytes();
  for (int n = 0; n < 10; ++n) heap.step(n);
  CHECK(heap.air.bytes() == warm);
}

TEMPLATE_TEST_CASE_SIG("velocities that are not finite show in max_speed and stop the smoke", "[suspension]",
                       ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(9);
  Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), {});
  air.set_smoke_mass(stratified<Dim>(grid, true));
  FaceField<Dim> u = make_face_field<Dim>(grid, 0.1);
  Index<Dim> middle;
  middle.fill(4);
  u[Dim - 1][middle] = GENERATE(std::numeric_limits<double>::quiet_NaN(), HUGE_VAL);
  air.set_velocity(u);
  CHECK(std::isnan(air.max_speed()));
  Stages stages;
  CHECK_THROWS_AS(air.advance(0.01, {}, stages), Error);
}

TEST_CASE("grids of a cell, a row and a column, and one full of ground", "[suspension]") {
  const Index<2> cells = GENERATE(Index<2>{1, 1}, Index<2>{1, 7}, Index<2>{7, 1}, Index<2>{2, 3});
  const bool buried = GENERATE(true, false);
  const Side side = GENERATE(Side::open, Side::closed);
  MacGrid<2> grid;
  grid.cells = cells;
  Suspension<2> air(grid, all_sides<2>(side), {});
  air.set_ground(Field<2>(grid.nodes(), buried ? -1.0 : 1.0));
  Field<2> smoke(grid.cells, 0.5);
  air.set_smoke_mass(smoke);
  std::vector<CoreCell<2>> cores(1);
  cores[0].mass = 50;
  Stages stages;
  double outflow = 0;
  for (int step = 0; step < 5; ++step) {
    air.add_gravity(0.1);
    air.advance(0.1, step < 3 ? std::span(cores) : std::span<CoreCell<2>>{}, stages);
    outflow += air.budget().outflow + (step < 3 ? cores[0].adhered : 0);
    CHECK(std::isfinite(air.max_speed()));
  }
  CHECK(air.total_smoke() + outflow == Approx(0.5 * static_cast<double>(smoke.size())).epsilon(1e-12));
}
