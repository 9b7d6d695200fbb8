// The same avalanche on the same slope, told as a profile and as a height field that falls across its grid.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "simulation/scene_reader.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

namespace {

struct Outcome {
  double front, mass_entrained, spread;
};

/// A ball of snow that falls on covered snow and slides down `downhill` for two seconds. The cover has four layers: one
/// of two lies in two flat sheets on a profile, whose depths set the thresholds, and evenly spread on a height field.
Outcome slide(const std::string& domain, const std::string& terrain, const Vec<3>& middle, const Vec<3>& downhill,
              int seed) {
  const auto list = [](const Vec<3>& v) {
    return "[" + std::to_string(v[0]) + ", " + std::to_string(v[1]) + ", " + std::to_string(v[2]) + "]";
  };
  Simulation<3> simulation(parse_scene(
      "schema_version = 1\n[scene]\ndim = 3\nseed = " + std::to_string(seed) + "\n[domain]\n" + domain +
          "bottom = \"open\"\nfront = \"open\"\nback = \"open\"\n[terrain]\n" + terrain +
          "[dense_flow]\nsupport_radius = 0.4\n[release]\nshape = \"ball\"\nradius = 1.1\ncenter = " + list(middle) +
          "\nvelocity = " + list(5 * downhill) + "\n[cover]\ndepth = 0.8\n[entrainment]\n",
      "a.toml"));
  while (simulation.time() < 2) simulation.step();
  const Particles<3>& p = simulation.dense()->particles;
  std::vector<double> way, aside;
  const Vec<3> across = Vec<3>(downhill[1], -downhill[0], 0).normalized();
  for (const Vec<3>& x : p.position) {
    way.push_back((x - middle).dot(downhill));
    aside.push_back(std::abs((x - middle).dot(across)));
  }
  const auto percentile = [](std::vector<double>& v, double share) {
    const auto at = v.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(v.size() - 1));
    std::nth_element(v.begin(), at, v.end());
    return *at;
  };
  CHECK(simulation.masses().n_outflow == 0);
  return {percentile(way, 0.99), simulation.masses().entrained, percentile(aside, 0.9)};
}

}  // namespace

TEST_CASE("An avalanche runs alike on a profile and on a height field that falls along its diagonal",
          "[ground][slow]") {
  const double slope = 35 * M_PI / 180, z = 24, half = std::sqrt(0.5);
  Outcome profile{}, field{};
  const int n = 3;
  for (int seed = 1; seed <= n; ++seed) {
    const auto add = [&](Outcome& sum, const Outcome& one) {
      sum.front += one.front / n, sum.mass_entrained += one.mass_entrained / n, sum.spread += one.spread / n;
    };
    // 3 m down the slope from where its height is z, 1.7 m off the ground
    const Vec<3> along(std::cos(slope), 0, -std::sin(slope)), normal(std::sin(slope), 0, std::cos(slope));
    add(profile,
        slide("lower = [0, -12, -12]\nupper = [36, 12, 30]\n",
              "shape = \"polyline\"\npoints = [[0, 24], [40, " + std::to_string(z - 40 * std::tan(slope)) + "]]\n",
              Vec<3>(0, 0, z) + 3 * along + 1.7 * normal, along, seed));
    const Vec<3> diagonal(half * along[0], half * along[0], along[2]);
    const Vec<3> diagonal_normal(half * normal[0], half * normal[0], normal[2]);
    const double fall = std::atan(half * std::tan(slope)) * 180 / M_PI;
    // The plane's start lies in the middle of the breadth; its height is z at (0, 0).
    const double start_z = z - 12 * half * std::tan(slope);
    add(field, slide("lower = [-4, -4, -20]\nupper = [28, 28, 34]\n",
                     "shape = \"plane\"\nstart = [0, " + std::to_string(start_z) + "]\nangle = \"" +
                         std::to_string(fall) + " deg\"\nside_angle = \"" + std::to_string(fall) + " deg\"\n",
                     Vec<3>(0, 0, z) + 3 * diagonal + 1.7 * diagonal_normal, diagonal, seed));
  }
  CAPTURE(profile.front, field.front, profile.mass_entrained, field.mass_entrained, profile.spread, field.spread);
  CHECK(field.front == Approx(profile.front).epsilon(0.05));
  CHECK(field.mass_entrained == Approx(profile.mass_entrained).epsilon(0.1));
  CHECK(field.spread == Approx(profile.spread).epsilon(0.1));
}
