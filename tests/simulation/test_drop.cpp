// A scene of configs/ against the parabola. Cases with numbers from the literature are those of src/verification.

#include <catch2/catch.hpp>

#include "simulation/scene_reader.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

TEST_CASE("A drop in free flight keeps to its parabola and to its spin", "[cases]") {
  Simulation<2> simulation(read_scene(SPINDRIFT_SOURCE_DIR "/configs/drop.toml", {"scene.end_time=0.5 s"}));
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
