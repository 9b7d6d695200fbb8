// What the air begins with: values by hand, and what a projection makes of them.
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "simulation/setup.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

/// A box of 8 m by 4 m from (-2, 1), in cells of 1 m.
const std::string box = R"(schema_version = 1
[domain]
lower = [-2, 1]
upper = [6, 5]
left = "closed"
right = "closed"
top = "closed"
[suspension]
cell_size = 1
initial_speed = 3
)";

template <int Dim>
Suspension<Dim> air_of(const Scene& scene) {
  const Walls<Dim> walls = make_walls<Dim>(scene);
  return make_suspension<Dim>(scene, walls, make_grid<Dim>(scene, walls), walls.sides);
}

FaceField<2> flow_of(const std::string& name, const std::vector<std::string>& settings = {}) {
  std::vector<std::string> all = settings;
  all.push_back("suspension.initial_flow=" + name);
  const Scene scene = scene_of(box, all);
  return air_of<2>(scene).velocity();
}

double largest(const FaceField<2>& u) {
  double most = 0;
  for (const Field<2>& component : u)
    for (const double value : component.values()) most = std::max(most, std::abs(value));
  return most;
}

double largest_difference(const FaceField<2>& a, const FaceField<2>& b) {
  FaceField<2> difference = a;
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (std::size_t face = 0; face < a[axis].size(); ++face) difference[axis][face] -= b[axis][face];
  return largest(difference);
}

double root_mean_square(const FaceField<2>& u) {
  double sum = 0;
  for (const Field<2>& component : u)
    for (const double value : component.values()) sum += value * value;
  return std::sqrt(sum / static_cast<double>(u[0].size() + u[1].size()));
}

/// The square of 1 m in n x n cells, after a step so short that nothing but the projection is seen.
struct Projected {
  FaceField<2> before, after;
};
Projected projected(const std::string& name, int n) {
  Simulation<2> simulation(scene_of(
      "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [1, 1]\nleft = \"closed\"\nright = \"closed\"\n"
      "top = \"closed\"\n[suspension]\ntolerance = 1e-10\n",
      {"suspension.initial_flow=" + name, "suspension.cell_size=" + std::to_string(1.0 / n), "scene.max_step=1e-6"}));
  const FaceField<2> before = simulation.suspension()->velocity();
  simulation.step();
  return {before, simulation.suspension()->velocity()};
}

}  // namespace

TEST_CASE("The air begins with a vortex, a rotation or a potential flow, by hand", "[initial_flow]") {
  SECTION("vortices") {
    const FaceField<2> u = flow_of("vortices");
    // Face (2, 1): x = 2 of 8, z = 1.5 of 4; face (2, 1) along z: x = 2.5, z = 1.
    CHECK(u[0][Index<2>{2, 1}] == Approx(3 * std::sqrt(0.5) * std::cos(std::numbers::pi * 0.375)));
    CHECK(u[1][Index<2>{2, 1}] == Approx(-1.5 * std::cos(std::numbers::pi * 0.3125) * std::sqrt(0.5)));
  }
  SECTION("rotation") {
    const FaceField<2> u = flow_of("rotation");  // 0.75 / s about (4, 2)
    CHECK(u[0][Index<2>{2, 3}] == Approx(-0.75 * 1.5));
    CHECK(u[0][Index<2>{6, 0}] == Approx(0.75 * 1.5));
    CHECK(u[1][Index<2>{7, 2}] == Approx(0.75 * 3.5));
    CHECK(u[1][Index<2>{0, 2}] == Approx(-0.75 * 3.5));
    CHECK(flow_of("rotation", {"suspension.initial_speed=-3"})[1][Index<2>{7, 2}] == Approx(-0.75 * 3.5));
  }
  SECTION("potential") {
    const FaceField<2> u = flow_of("potential");
    // 48 sqrt(3) * 3 m/s * 4 m, over 8 m and 4 m; X(1/4) = 9/256, X'(1/4) = 3/16, X(5/16), X'(5/16) = 55 * 6 / 2048.
    const double scale = 48 * std::sqrt(3.0) * 3 * 4, hill = std::pow(5.0 / 16 * 11 / 16, 2);
    CHECK(u[0][Index<2>{2, 1}] == Approx(scale / 8 * 0.1875 * std::pow(0.375 * 0.625, 2)));
    CHECK(u[1][Index<2>{2, 1}] == Approx(scale / 4 * hill * 0.1875));
  }
}

TEST_CASE("No flow begins through closed sides, nor along y", "[initial_flow]") {
  const auto name = GENERATE(as<std::string>{}, "vortices", "rotation", "potential");
  const FaceField<2> u = flow_of(name);
  for (int k = 0; k < 4; ++k) {
    CHECK(u[0][Index<2>{0, k}] == 0);
    CHECK(u[0][Index<2>{8, k}] == 0);
  }
  for (int i = 0; i < 8; ++i) {
    CHECK(u[1][Index<2>{i, 0}] == 0);
    CHECK(u[1][Index<2>{i, 4}] == 0);
  }
  const Scene scene = scene_of(
      box, {"scene.dim=3", "domain.lower=[-2, 0, 1]", "domain.upper=[6, 3, 5]", "suspension.initial_flow=" + name});
  const FaceField<3> solid = air_of<3>(scene).velocity();
  for (const double v : solid[1].values()) REQUIRE(v == 0);
  for (const std::size_t axis : {0u, 2u})
    for_each_index<3>(solid[axis].shape(), [&](const Index<3>& face) {
      REQUIRE(solid[axis][face] == u[axis / 2][Index<2>{face[0], face[2]}]);
    });
}

TEST_CASE("Largest speeds are what the scene says", "[initial_flow]") {
  const auto [name, finest] = GENERATE(table<std::string, double>({{"vortices", 3.0}, {"potential", 3.0}}));
  CHECK(largest(flow_of(name, {"suspension.cell_size=0.03125"})) == Approx(finest).epsilon(0.01));
}

TEST_CASE("A projection leaves the vortex as it is, and of a potential flow an error of second order",
          "[initial_flow]") {
  const Projected vortex = projected("vortices", 32);
  CHECK(largest_difference(vortex.before, vortex.after) < 1e-4);
  const Projected coarse = projected("potential", 32), fine = projected("potential", 64);
  CHECK(largest(coarse.before) > 0.98);
  CHECK(largest(coarse.after) < 0.02);
  CHECK(root_mean_square(coarse.after) / root_mean_square(fine.after) == Approx(4).epsilon(0.1));
}
