// Case A2 of the validation catalogue: a column at rest in a closed box.
#include <catch2/catch.hpp>

#include "fluid_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

struct Rest {
  double density_error = 0;   ///< mean compression
  double height = 0;          ///< twice the mean height of the particles [m]
  double top = 0;             ///< of the highest particle, plus d / 2 [m]
  double speed = 0;           ///< root mean square [m/s]
  double floor_pressure = 0;  ///< mean over the run's last quarter [Pa]
  double pressure_error = 0;  ///< root mean square of p - rho g (H - z) at the end [Pa]
};

Rest column(int rows, double end_time, DenseFlowOptions options) {
  const double depth = 1, d = depth / rows, g = 9.81;
  options.support_radius = 2 * d;
  options.spacing = d;
  DenseFlow<2> flow(options);
  auto& p = flow.particles;
  add_block<2>(p, {20, rows}, d, options.density, {0, 0});
  const Walls<2> walls = box<2>({20 * d, 3 * depth});
  Stages stages;
  Rest rest;
  double time = 0, impulse = 0, window = 0;
  while (time < end_time) {
    const double dt = std::min(0.01, flow.time_step_limit(0.4, g));
    const double push = step<2>(flow, dt, walls, {0, -g}, stages)[1];
    time += dt;
    if (time < 0.75 * end_time) continue;
    impulse += push;
    window += dt;
  }
  flow.sort(walls, stages);
  flow.find_neighbours(walls, {}, stages);
  const double n = static_cast<double>(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    rest.density_error += std::max(0.0, flow.neighbours().volume_sum()[i] - 1) / n;
    rest.height += 2 * p.position[i][1] / n;
    rest.top = std::max(rest.top, p.position[i][1] + 0.5 * d);
    rest.speed += p.velocity[i].squaredNorm() / n;
    rest.pressure_error += std::pow(p.pressure[i] - options.density * g * (depth - p.position[i][1]), 2) / n;
  }
  rest.pressure_error = std::sqrt(rest.pressure_error);
  rest.speed = std::sqrt(rest.speed);
  rest.floor_pressure = impulse / window / (20 * d);
  return rest;
}

void check(const Rest& rest, int rows, double density, double density_gate, double speed_gate) {
  const double d = 1.0 / rows, weight = density * 9.81;
  CHECK(rest.density_error <= density_gate);
  CHECK(rest.height == Approx(1).margin(0.5 * d));
  CHECK(rest.top == Approx(1).margin(d));
  CHECK(rest.floor_pressure == Approx(weight).margin(weight * 0.2 * d));
  CHECK(rest.speed <= speed_gate * std::sqrt(9.81));
}

}  // namespace

TEST_CASE("a short column rests", "[column]") {
  check(column(20, 1.5, {}), 20, 300, 1e-3, 0.05);
}

TEST_CASE("a short column rests on cover", "[column]") {
  const double d = 0.1, g = 9.81;
  Particles<2> cover;
  add_block<2>(cover, {10, 3}, d, 100, {0, 0});
  CellList<2> cells(2 * d);
  cells.build(cover);
  cells.release_scratch();
  const std::vector<Vec<2>> normals(cover.size(), up<2>());
  DenseFlow<2> flow(options_for<2>(d));
  add_block<2>(flow.particles, {10, 10}, d, 300, {0, 3 * d});
  const Walls<2> walls = box<2>({10 * d, 30 * d});
  Stages stages;
  double impulse = 0, time = 0;
  for (int k = 0; k < 200; ++k) {
    const double dt = std::min(0.01, flow.time_step_limit(0.4, g));
    impulse += step<2>(flow, dt, walls, {0, -g}, stages, {&cover, &cells, &normals})[1];
    time += dt;
  }
  CHECK(impulse / time == Approx(300 * g).epsilon(0.02));
  double mean = 0, lowest = 1e9;
  for (const auto& x : flow.particles.position) {
    mean += x[1] / 100;
    lowest = std::min(lowest, x[1]);
  }
  CHECK(mean == Approx(8 * d).margin(0.5 * d));
  CHECK(lowest > 3 * d);
}

TEST_CASE("a short column rests with the equation of state", "[column]") {
  DenseFlowOptions options;
  options.solver = DenseSolver::wcsph;
  options.sound_speed = 10 * std::sqrt(9.81);
  check(column(20, 1.5, options), 20, 300, 1e-2, 0.05);
}

TEST_CASE("a column comes to rest", "[column][slow]") {
  SECTION("by density_tolerance alone as far as it goes: about 2.5e-4 of compression a step over its depth") {
    const int rows = GENERATE(20, 50);
    DenseFlowOptions options;
    options.pressure.relative_tolerance = 0;
    check(column(rows, 20, options), rows, 300, 1e-3, 0.02);
  }
  SECTION("with the default tolerances at any resolution: what is left goes with dt^2 g / H") {
    const int rows = GENERATE(20, 50, 100);
    check(column(rows, 20, {}), rows, 300, 1e-3, 0.02);
  }
  SECTION("with a tight solve within the catalogue's gates, at any resolution and for long (A2)") {
    const int rows = GENERATE(20, 50, 100);
    DenseFlowOptions options;
    options.pressure.density_tolerance = 2e-5;
    options.pressure.max_iterations = 1000;
    const Rest rest = column(rows, rows == 20 ? 40 : 20, options);
    check(rest, rows, 300, 1e-3, 1e-3);
    CHECK(rest.pressure_error < 0.1 * 300 * 9.81);  // of single particles; the floor's mean is 1e-4 off
  }
}
