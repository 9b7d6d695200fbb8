#include <catch2/catch.hpp>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "fluid_fixture.hpp"
#include "sph/dense_flow.hpp"

using namespace spindrift;
using namespace spindrift::test;

TEMPLATE_TEST_CASE_SIG("none, one, two and coincident particles are legal", "[dense_flow]", ((int Dim), Dim), 2, 3) {
  const double d = 0.1;
  DenseFlowOptions options = options_for<Dim>(d);
  options.solver = GENERATE(DenseSolver::dfsph, DenseSolver::wcsph);
  options.sound_speed = 30;
  options.viscosity = GENERATE(0.0, 10.0);
  options.no_slip = true;
  DenseFlow<Dim> flow(options);
  const int n = GENERATE(0, 1, 2, 3, 9);
  const double gap = GENERATE(0.0, 1e-9, 0.5);
  for (int i = 0; i < n; ++i)
    add_particle<Dim>(flow.particles, Vec<Dim>::Constant(0.3) + i * gap * d * Vec<Dim>::Unit(0), Vec<Dim>::Zero(),
                      std::pow(d, Dim), 300);
  const Walls<Dim> walls = box<Dim>(Vec<Dim>::Constant(1));
  Stages stages;
  for (int k = 0; k < 20; ++k) step<Dim>(flow, 0.002, walls, -9.81 * up<Dim>(), stages);
  REQUIRE(flow.particles.size() == static_cast<std::size_t>(n));
  for (std::size_t i = 0; i < flow.particles.size(); ++i) {
    CHECK(flow.particles.position[i].allFinite());
    CHECK(flow.particles.velocity[i].norm() < 60);  // twice the sound speed
  }
  flow.compact(0.01, 0.1);
  CHECK(flow.remove_outside(walls).count == 0);
  CHECK((n == 0) == std::isinf(flow.time_step_limit(0.4, 9.81)));
}

TEMPLATE_TEST_CASE_SIG("a velocity that is not a number is reported", "[dense_flow]", ((int Dim), Dim), 2, 3) {
  DenseFlow<Dim> flow(options_for<Dim>(0.1));
  Index<Dim> n;
  n.fill(4);
  add_block<Dim>(flow.particles, n, 0.1, 300, Vec<Dim>::Zero());
  flow.particles.id[9] = 990099;
  Stages stages;
  flow.sort(no_walls<Dim>(), stages);
  flow.find_neighbours(no_walls<Dim>(), {}, stages);
  const std::size_t bad = static_cast<std::size_t>(
      std::find(flow.particles.id.begin(), flow.particles.id.end(), 990099u) - flow.particles.id.begin());
  flow.particles.velocity[bad][0] =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity());
  CHECK_THROWS_WITH(flow.solve_velocity(0.01, stages), Catch::Contains("990099"));
}

TEST_CASE("options out of range are refused", "[dense_flow]") {
  const auto with = [](auto change) {
    DenseFlowOptions options;
    change(options);
    return options;
  };
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_NOTHROW(DenseFlow<2>(DenseFlowOptions{}));
  CHECK_THROWS_AS(DenseFlow<2>(with([](auto& o) { o.support_radius = 0; })), Error);
  CHECK_THROWS_AS(DenseFlow<2>(with([](auto& o) { o.density = -1; })), Error);
  CHECK_THROWS_AS(DenseFlow<2>(with([&](auto& o) { o.viscosity = nan; })), Error);
  CHECK_THROWS_AS(DenseFlow<2>(with([](auto& o) { o.pressure.max_iterations = 0; })), Error);
  CHECK_THROWS_AS(DenseFlow<2>(with([](auto& o) { o.solver = DenseSolver::wcsph; })), Error);
}

TEMPLATE_TEST_CASE_SIG("a 30 m/s impact does not leak through a floor", "[dense_flow]", ((int Dim), Dim), 2, 3) {
  const double d = 0.1;
  DenseFlow<Dim> flow(options_for<Dim>(d));
  Index<Dim> n;
  n.fill(8);
  Vec<Dim> corner = Vec<Dim>::Constant(1);
  corner[Dim - 1] = 0.3;
  add_block<Dim>(flow.particles, n, d, 300, corner);
  for (auto& v : flow.particles.velocity) v[Dim - 1] = -30;
  Walls<Dim> walls = box<Dim>(Vec<Dim>::Constant(3));
  const Vec<Dim> before = momentum(flow.particles);
  Vec<Dim> impulse = Vec<Dim>::Zero();
  Stages stages;
  for (int k = 0; k < 120; ++k) {
    const double dt = std::min(0.01, flow.time_step_limit(0.4, 9.81));
    impulse += step<Dim>(flow, dt, walls, Vec<Dim>::Zero(), stages);
    for (const auto& x : flow.particles.position) REQUIRE(walls.domain.contains(x));
  }
  const Vec<Dim> after = momentum(flow.particles);
  CHECK((after - before - impulse).norm() < 1e-10 * before.norm());
  double speed = 0;
  for (const auto& v : flow.particles.velocity) speed = std::max(speed, v.norm());
  CHECK(speed < 90);
  CHECK(after[Dim - 1] > before[Dim - 1]);
}

TEMPLATE_TEST_CASE_SIG("F13: snow stops at a wall a thousandth as thick as its way in a step", "[dense_flow]",
                       ((int Dim), Dim), 2, 3) {
  const double d = 0.1, dx = 0.25, dt = 0.01, way = 10 * dx;
  DenseFlow<Dim> flow(options_for<Dim>(d));
  Walls<Dim> walls = box<Dim>(Vec<Dim>::Constant(100), Side::open);
  Box<Dim> wall{Vec<Dim>(Vec<Dim>::Zero()), Vec<Dim>(Vec<Dim>::Constant(100))};
  wall.lower[0] = 50, wall.upper[0] = 50 + way / 1000;
  walls.obstacles.push_back(wall);
  Vec<Dim> v = Vec<Dim>::Constant(3);
  v[0] = way / dt;
  for (const double gap : {0.0, 0.3, 0.999, 1.001}) {
    Vec<Dim> x = Vec<Dim>::Constant(20);
    x[0] = 50 - gap * way;
    add_particle<Dim>(flow.particles, x, v, std::pow(d, Dim), 300);
  }
  Stages stages;
  const Vec<Dim> impulse = flow.move(dt, walls, stages);
  const double m = flow.particles.mass[0];
  for (std::size_t i = 0; i < 3; ++i) {
    CHECK(flow.particles.position[i][0] == Approx(50).epsilon(1e-14));
    CHECK(flow.particles.velocity[i][0] == 0);
    CHECK(flow.particles.position[i][Dim - 1] == Approx(20.03));
    CHECK(flow.particles.velocity[i][Dim - 1] == 3);
  }
  CHECK(flow.particles.position[3][0] == Approx(50 - 0.001 * way));
  CHECK(flow.particles.velocity[3] == v);
  CHECK(impulse[0] == Approx(-3 * m * way / dt));
  for (int step = 0; step < 3; ++step) {  // pressed against it, it stays
    flow.particles.velocity[0][0] = way / dt;
    flow.move(dt, walls, stages);
    CHECK(flow.particles.position[0][0] == Approx(50).epsilon(1e-14));
  }
}

// Case A15 of the validation catalogue.
TEMPLATE_TEST_CASE_SIG("a rotating patch in free fall keeps its momenta", "[dense_flow]", ((int Dim), Dim), 2, 3) {
  const double d = 0.05, omega = 2, dt = 0.005;
  DenseFlow<Dim> flow(options_for<Dim>(d));
  auto& p = flow.particles;
  Index<Dim> n;
  n.fill(Dim == 2 ? 20 : 10);
  add_block<Dim>(p, n, d, 300, Vec<Dim>::Constant(-0.5 * n[0] * d));
  for (std::size_t i = 0; i < p.size(); ++i) {
    p.velocity[i][0] = -omega * p.position[i][1] + 1.5;
    p.velocity[i][1] = omega * p.position[i][0] - 0.3 * std::sin(9 * p.position[i][1]);
  }
  const auto angular = [&] {
    double sum = 0;
    Vec<Dim> centre = Vec<Dim>::Zero(), drift = Vec<Dim>::Zero();
    double mass = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      centre += p.mass[i] * p.position[i];
      drift += p.mass[i] * p.velocity[i];
      mass += p.mass[i];
    }
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec<Dim> x = p.position[i] - centre / mass, v = p.velocity[i] - drift / mass;
      sum += p.mass[i] * (x[0] * v[1] - x[1] * v[0]);
    }
    return sum;
  };
  double mass = 0;
  for (const double m : p.mass) mass += m;
  const double spin = angular();
  const Vec<Dim> start = momentum(p);
  Stages stages;
  const int steps = 100;
  for (int k = 0; k < steps; ++k) step<Dim>(flow, dt, no_walls<Dim>(), -9.81 * up<Dim>(), stages);
  const Vec<Dim> expected = start - mass * steps * dt * 9.81 * up<Dim>();
  CHECK((momentum(p) - expected).norm() < 1e-12 * expected.norm());
  CHECK(angular() == Approx(spin).epsilon(1e-3));
}

TEMPLATE_TEST_CASE_SIG("the same bits with any number of threads", "[dense_flow]", ((int Dim), Dim), 2, 3) {
  const double d = 0.05;
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    DenseFlowOptions options = options_for<Dim>(d);
    options.viscosity = 1;
    options.no_slip = true;
    DenseFlow<Dim> flow(options);
    Index<Dim> n;
    n.fill(Dim == 2 ? 70 : 18);
    add_block<Dim>(flow.particles, n, d, 300, Vec<Dim>::Zero());
    shake(flow.particles, 0.1 * d, 1);
    Walls<Dim> walls = box<Dim>(Vec<Dim>::Constant(4));
    Stages stages;
    for (int k = 0; k < 5; ++k) step<Dim>(flow, 0.003, walls, -9.81 * up<Dim>(), stages);
    return flow.particles;
  };
  const Particles<Dim> one = run(1);
  for (const int threads : {2, 4}) {
    const Particles<Dim> many = run(threads);
    CHECK(one.id == many.id);
    CHECK(one.position == many.position);
    CHECK(one.velocity == many.velocity);
    CHECK(one.pressure == many.pressure);
  }
}

TEMPLATE_TEST_CASE_SIG("particles beyond open sides are counted out", "[dense_flow]", ((int Dim), Dim), 2, 3) {
  DenseFlow<Dim> flow(options_for<Dim>(0.1));
  for (const double x : {-0.5, 0.5, 1.5, 0.7, 2.5})
    add_particle<Dim>(flow.particles, Vec<Dim>::Constant(x), x * Vec<Dim>::Unit(0), 0.01, 300);
  const Removed<Dim> removed = flow.remove_outside(box<Dim>(Vec<Dim>::Constant(1), Side::open));
  CHECK(removed.count == 3);
  CHECK(removed.mass == Approx(9));
  CHECK(removed.momentum[0] == Approx(3 * 3.5));
  CHECK(flow.particles.id == std::vector<std::uint64_t>{1, 3});
  CHECK(flow.particles.velocity[1][0] == 0.7);
  CHECK(flow.remove_outside(box<Dim>(Vec<Dim>::Constant(0.1), Side::closed)).count == 0);
}

TEST_CASE("volume relaxes to mass over density at any step", "[dense_flow]") {
  DenseFlow<2> flow(options_for<2>(0.1));
  add_particle<2>(flow.particles, {0, 0}, {0, 0}, 0.01, 100);
  SECTION("off") {
    flow.compact(1, 0);
    CHECK(flow.particles.volume[0] == 0.01);
  }
  SECTION("one step or many") {
    const int n = GENERATE(1, 10, 1000);
    for (int k = 0; k < n; ++k) flow.compact(0.2 / n, 0.1);
    CHECK(flow.particles.volume[0] == Approx(0.01 / 3 + (0.01 - 0.01 / 3) * std::exp(-2.0)));
  }
}

TEST_CASE("absent physics has no pass", "[dense_flow]") {
  DenseFlow<2> flow(options_for<2>(0.1));
  add_block<2>(flow.particles, {5, 5}, 0.1, 300, {0, 0});
  Stages stages;
  step<2>(flow, 0.01, no_walls<2>(), {0, -9.81}, stages);
  CHECK(stages.passes("dense_flow.viscosity") == 0);
  CHECK(stages.passes("dense_flow.wcsph") == 0);
  CHECK(stages.passes("dense_flow.pressure") == 1);
  CHECK(flow.neighbours().no_slip_coefficient().empty());
}

TEST_CASE("the equation of state's step follows the lightest snow", "[dense_flow]") {
  DenseFlowOptions options = options_for<2>(0.1);
  options.solver = DenseSolver::wcsph;
  options.sound_speed = 100;
  DenseFlow<2> flow(options);
  add_block<2>(flow.particles, {2, 2}, 0.1, options.density, {0, 0});
  CHECK(flow.time_step_limit(0.4, 9.81) == Approx(0.4 * 0.1 / 100));
  flow.particles.mass[2] /= 9;  // a wave three times as fast
  CHECK(flow.time_step_limit(0.4, 9.81) == Approx(0.4 * 0.1 / 300));
}
