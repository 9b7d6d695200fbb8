#include <catch2/catch.hpp>
#include <numbers>

#include "fluid_fixture.hpp"
#include "sph/viscosity.hpp"

using namespace spindrift;
using namespace spindrift::test;

TEMPLATE_TEST_CASE_SIG("viscosity keeps momentum, damps, and stops at rigid motion", "[viscosity]", ((int Dim), Dim), 2,
                       3) {
  const double d = 0.05, mu = GENERATE(1e-3, 1.0, 1e4);
  DenseFlow<Dim> flow(options_for<Dim>(d));
  auto& p = flow.particles;
  Index<Dim> n;
  n.fill(Dim == 2 ? 15 : 7);
  add_block<Dim>(p, n, d, 300, Vec<Dim>::Zero());
  shake(p, 0.2 * d, 2);
  for (std::size_t i = 0; i < p.size(); ++i) p.mass[i] *= i % 3 == 0 ? 0.1 : 1;
  Stages stages;
  flow.sort(no_walls<Dim>(), stages);
  flow.find_neighbours(no_walls<Dim>(), {}, stages);
  const auto energy = [&] {
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i].squaredNorm();
    return sum;
  };
  const Vec<Dim> before = momentum(p);
  const double energy_before = energy();
  ViscositySolver<Dim> solver(d);
  Vec<Dim> impulse = Vec<Dim>::Zero();
  solver.solve(p, flow.neighbours(), mu, 0.01, impulse);
  const double scale = std::sqrt(energy_before * 300);
  CHECK((momentum(p) - before).norm() < 1e-12 * scale);
  CHECK(impulse.norm() < 1e-12 * scale);
  CHECK(energy() < energy_before);
  for (auto& v : p.velocity) v = Vec<Dim>::Constant(3);
  CHECK(solver.solve(p, flow.neighbours(), mu, 0.01, impulse).iterations == 0);
}

TEMPLATE_TEST_CASE_SIG("a shear wave decays at the viscous rate", "[viscosity]", ((int Dim), Dim), 2, 3) {
  const double d = 0.05, mu = 3, rho = 300, dt = 1e-4;
  DenseFlow<Dim> flow(options_for<Dim>(d));
  auto& p = flow.particles;
  Index<Dim> n;
  n.fill(7);
  n[Dim - 1] = 41;
  add_block<Dim>(p, n, d, rho, Vec<Dim>::Zero());
  const double k = 2 * std::numbers::pi / (20 * d);
  Stages stages;
  flow.sort(no_walls<Dim>(), stages);
  flow.find_neighbours(no_walls<Dim>(), {}, stages);
  for (std::size_t i = 0; i < p.size(); ++i) p.velocity[i] = std::sin(k * p.position[i][Dim - 1]) * Vec<Dim>::Unit(0);
  const auto before = p.velocity;
  ViscositySolver<Dim> solver(d);
  Vec<Dim> impulse = Vec<Dim>::Zero();
  solver.solve(p, flow.neighbours(), mu, dt, impulse);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<Dim> x = p.position[i] / d;
    bool inside = std::abs(before[i][0]) > 0.3;
    for (int a = 0; a < Dim; ++a) inside = inside && x[a] > 2.1 && x[a] < n[a] - 2.1;
    if (inside) CHECK((1 - p.velocity[i][0] / before[i][0]) / (mu / rho * k * k * dt) == Approx(1).margin(0.03));
  }
}

// Case A8 of the validation catalogue: the middle of a long film on a slope, started from rest. The solve must be
// tight, for the default tolerance is of the order of this film's slow shear.
TEST_CASE("a viscous film on a slope has the parabola", "[viscosity][slow]") {
  const int rows = 20;
  const double depth = 0.1, d = depth / rows, mu = 100, rho = 1000, g = 9.81, angle = 20 * std::numbers::pi / 180;
  DenseFlowOptions options = options_for<2>(d);
  options.density = rho;
  options.viscosity = mu;
  options.no_slip = true;
  options.pressure.density_tolerance = 1e-5;
  options.pressure.max_iterations = 400;
  DenseFlow<2> flow(options);
  auto& p = flow.particles;
  add_block<2>(p, {12 * rows, rows}, d, rho, {-6 * depth, 0});
  Walls<2> walls = no_walls<2>();
  walls.domain.lower[1] = 0;
  walls.sides[1][0] = Side::closed;
  Stages stages;
  std::vector<double> sum(rows, 0.0), height(rows, 0.0), n(rows, 0.0);
  for (int k = 0; k < 350; ++k) {
    step<2>(flow, 0.001, walls, g * Vec<2>(std::sin(angle), -std::cos(angle)), stages);
    if (k < 250 || k % 10 != 0) continue;  // rows that slide over rows modulate the speed: a mean over their passing
    for (std::size_t i = 0; i < p.size(); ++i) {
      const auto row = static_cast<std::size_t>(p.position[i][1] / d);
      if (std::abs(p.position[i][0]) > 0.5 * depth || row >= static_cast<std::size_t>(rows)) continue;
      sum[row] += p.velocity[i][0];
      height[row] += p.position[i][1];
      n[row] += 1;
    }
  }
  double error = 0, norm = 0;
  for (std::size_t row = 0; row < static_cast<std::size_t>(rows); ++row) {
    REQUIRE(n[row] > 0);
    const double z = height[row] / n[row], exact = rho * g * std::sin(angle) * (2 * depth * z - z * z) / (2 * mu);
    error += std::pow(sum[row] / n[row] - exact, 2);
    norm += exact * exact;
  }
  CHECK(std::sqrt(error / norm) <= 0.02);
}

TEST_CASE("cover holds viscous snow where it does not slip", "[viscosity]") {
  const double d = 0.05;
  Particles<2> cover;
  add_block<2>(cover, {20, 3}, d, 100, {0, -3 * d});
  CellList<2> cells(2 * d);
  cells.build(cover);
  const std::vector<Vec<2>> normals(cover.size(), up<2>());
  DenseFlowOptions options = options_for<2>(d);
  options.viscosity = 50;
  options.no_slip = GENERATE(true, false);
  DenseFlow<2> flow(options);
  add_block<2>(flow.particles, {10, 3}, d, 300, {5 * d, 0});
  for (auto& v : flow.particles.velocity) v = {1, 0};
  Stages stages;
  flow.sort(no_walls<2>(), stages);
  flow.find_neighbours(no_walls<2>(), {&cover, &cells, &normals}, stages);
  const double before = momentum(flow.particles)[0];
  const auto done = flow.solve_velocity(0.01, stages);
  CHECK(momentum(flow.particles)[0] - before == Approx(done.boundary_impulse[0]).margin(1e-9));
  if (options.no_slip) CHECK(momentum(flow.particles)[0] < 0.9 * before);
  if (!options.no_slip) CHECK(momentum(flow.particles)[0] == Approx(before).epsilon(0.02));
}
