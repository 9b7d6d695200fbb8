// Cases with numbers from the literature, on the scene files of configs/ that users run.

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "simulation/scene_reader.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

namespace {

Simulation<2> simulation_of(const std::string& file, const std::vector<std::string>& settings = {}) {
  return Simulation<2>(read_scene(std::string(SPINDRIFT_SOURCE_DIR "/configs/") + file, settings));
}

double interpolated(const std::vector<std::array<double, 2>>& curve, double t) {
  std::size_t i = 1;
  while (i + 1 < curve.size() && curve[i][0] < t) ++i;
  const auto& [t0, y0] = curve[i - 1];
  const auto& [t1, y1] = curve[i];
  return y0 + (y1 - y0) * (t - t0) / (t1 - t0);
}

/// x up to which the bottom slab of `height` is at least half full of snow, in columns of `width` [m].
double bulk_front(const Simulation<2>& simulation, double width, double height) {
  const Particles<2>& p = simulation.dense()->particles;
  std::vector<double> filled(static_cast<std::size_t>(simulation.walls().domain.size()[0] / width) + 1);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.position[i][1] < height) filled[static_cast<std::size_t>(p.position[i][0] / width)] += p.volume[i];
  double front = 0;
  for (std::size_t c = 0; c < filled.size(); ++c)
    if (filled[c] >= 0.5 * width * height) front = width * static_cast<double>(c + 1);
  return front;
}

double height_at_left_wall(const Simulation<2>& simulation, double width) {
  const Particles<2>& p = simulation.dense()->particles;
  double volume = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.position[i][0] < width) volume += p.volume[i];
  return volume / width;
}

/// Where the smoke of the bottom row of cells falls below half of `density`, linear between cells [m].
double gas_front(const Suspension<2>& air, double density) {
  const int n = air.grid().cells[0];
  for (int i = n - 1; i > 0; --i) {
    const double here = air.smoke_density(static_cast<std::size_t>(i));
    const double left = air.smoke_density(static_cast<std::size_t>(i - 1));
    if (left >= density / 2 && here < density / 2)
      return air.grid().origin[0] + air.grid().dx * (i - 0.5 + (left - density / 2) / (left - here));
  }
  return 0;
}

/// Froude number of the heavy front between one and three depths from the gate.
double froude_number(int n_cells) {
  Simulation<2> simulation =
      simulation_of("heavy_gas_front.toml", {"suspension.cell_size=" + std::to_string(1.0 / n_cells)});
  const Scene& scene = simulation.scene();
  const double smoke = scene.smoke[0].density, air = scene.suspension->air_density;
  const double reduced_gravity = 9.81 * smoke / (air + smoke / 2);
  double passed_first = 0;
  while (!simulation.done()) {
    simulation.step();
    const double front = gas_front(*simulation.suspension(), smoke) - 8;
    if (front < 1) passed_first = simulation.time();
    if (front >= 3) return 2 / (simulation.time() - passed_first) / std::sqrt(reduced_gravity);
  }
  return 0;
}

/// Velocity u of the air along the vertical middle line of the lid-driven box at height z.
double u_on_middle_line(const Suspension<2>& air, double z) {
  const MacGrid<2>& grid = air.grid();
  const double k = z / grid.dx - 0.5;
  const int low = static_cast<int>(std::floor(k));
  const Field<2>& u = air.velocity()[0];
  const int middle = grid.cells[0] / 2;
  return u[Index<2>{middle, low}] + (k - low) * (u[Index<2>{middle, low + 1}] - u[Index<2>{middle, low}]);
}

double lid_driven_minimum(int n_cells) {
  Simulation<2> simulation =
      simulation_of("lid_driven_box.toml", {"suspension.cell_size=" + std::to_string(1.0 / n_cells)});
  while (!simulation.done()) simulation.step();
  return u_on_middle_line(*simulation.suspension(), 0.4531);
}

}  // namespace

// Case A4 of the validation catalogue. Martin and Moyce 1952, n^2 = 2: Z = x / a over T = t sqrt(2 g / a); height at
// the wall over t sqrt(g/a).
TEST_CASE("A dam break runs as Martin and Moyce measured", "[cases][slow]") {
  const std::vector<std::array<double, 2>> front{{0.41, 1.11}, {0.84, 1.22}, {1.19, 1.44}, {1.43, 1.67}, {1.63, 1.89},
                                                 {1.83, 2.11}, {1.98, 2.33}, {2.20, 2.56}, {2.32, 2.78}, {2.51, 3.00},
                                                 {2.65, 3.22}, {2.83, 3.44}, {2.98, 3.67}, {3.11, 3.89}, {3.33, 4.11}};
  const std::vector<std::array<double, 2>> height{{0.56, 0.94}, {0.93, 0.83}, {1.46, 0.67}, {2.00, 0.50}, {2.45, 0.39}};
  Simulation<2> simulation = simulation_of("dam_break.toml", {"scene.end_time=0.8 s"});
  const double g = 9.81, d = simulation.dense()->options().spacing;
  std::vector<std::array<double, 2>> fronts, heights;
  while (!simulation.done()) {
    simulation.step();
    fronts.push_back({simulation.time() * std::sqrt(2 * g), bulk_front(simulation, 2 * d, 0.2)});
    heights.push_back({simulation.time() * std::sqrt(g), height_at_left_wall(simulation, 4 * d) / 2});
  }
  double squares = 0;
  for (const auto& [T, Z] : front) squares += std::pow(interpolated(fronts, T) / Z - 1, 2);
  const double rms = std::sqrt(squares / static_cast<double>(front.size()));
  const double slope = (interpolated(fronts, 3.33) - interpolated(fronts, 1.43)) / (3.33 - 1.43);
  CAPTURE(rms, slope);
  CHECK(rms < 0.1);
  CHECK(slope == Approx(1.319).epsilon(0.1));
  for (const auto& [T, H] : height) CHECK(interpolated(heights, T) == Approx(H).margin(0.05));
}

// Case B6 of the validation catalogue, full depth. Energy-conserving: 1/2 (Benjamin 1968); computed on 16, 32, 64
// cells: 0.448, 0.466, 0.477.
TEST_CASE("A heavy gas front approaches half of sqrt(g' H) as cells get finer", "[cases][slow]") {
  const double coarse = froude_number(16), middle = froude_number(32), fine = froude_number(64);
  CAPTURE(coarse, middle, fine);
  CHECK(middle == Approx(0.5).epsilon(0.08));
  CHECK(fine == Approx(0.5).epsilon(0.05));
  CHECK(0.5 - middle < 0.85 * (0.5 - coarse));
  CHECK(0.5 - fine < 0.85 * (0.5 - middle));
}

// Case B5 of the validation catalogue. Ghia, Ghia and Shin 1982, Re = 100: u = -0.21090 at z = 0.4531 of the vertical
// middle line.
TEST_CASE("The lid-driven box approaches Ghia's velocity as cells get finer", "[cases][slow]") {
  const double coarse = std::abs(lid_driven_minimum(16) + 0.2109), fine = std::abs(lid_driven_minimum(32) + 0.2109);
  CAPTURE(coarse, fine);
  CHECK(fine < 0.01);
  CHECK(fine < coarse / 2);
}

TEST_CASE("A drop in free flight keeps to its parabola and to its spin", "[cases]") {
  Simulation<2> simulation = simulation_of("drop.toml", {"scene.end_time=0.5 s"});
  const auto angular_momentum = [&](const Vec<2>& middle) {
    const Particles<2>& p = simulation.dense()->particles;
    double sum = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      const Vec<2> arm = p.position[i] - middle;
      sum += p.mass[i] * (arm[0] * p.velocity[i][1] - arm[1] * p.velocity[i][0]);
    }
    return sum;
  };
  const auto middle = [&] {
    const Particles<2>& p = simulation.dense()->particles;
    Vec<2> sum = Vec<2>::Zero();
    for (const Vec<2>& x : p.position) sum += x / static_cast<double>(p.size());
    return sum;
  };
  const double spin = angular_momentum(middle());
  double inertia = 0;
  for (const Vec<2>& x : simulation.dense()->particles.position) inertia += (x - Vec<2>(3, 4)).squaredNorm();
  CHECK(spin == Approx(0.3 * inertia * simulation.dense()->particles.mass[0]));
  while (!simulation.done()) simulation.step();
  const double t = simulation.time();
  const Vec<2> expected(3 + 8 * t, 4 + 10 * t - 9.81 * t * t / 2);
  CHECK((middle() - expected).norm() < 0.01 * t * 9.81 * 0.01 + 0.01);  // the integration is of first order in dt
  CHECK(angular_momentum(middle()) == Approx(spin).epsilon(1e-6));
}
