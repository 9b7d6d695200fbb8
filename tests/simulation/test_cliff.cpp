// F1: snow at ground of 90 degrees, where there is no friction and no normal that is not a number.

#include <catch2/catch.hpp>
#include <string>

#include "simulation/scene_reader.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

namespace {

/// A cliff of 60 m at x = 10 m, and a ball of snow.
template <int Dim>
Scene at_the_cliff(double x, double z, double speed) {
  const auto place = [](double a, double y, double b) {
    return Dim == 2 ? "[" + std::to_string(a) + ", " + std::to_string(b) + "]"
                    : "[" + std::to_string(a) + ", " + std::to_string(y) + ", " + std::to_string(b) + "]";
  };
  return parse_scene("schema_version = 1\n[scene]\nend_time = 1.5\ndim = " + std::to_string(Dim) +
                         "\n[domain]\nlower = " + place(0, 0, -2) + "\nupper = " + place(40, 4, 70) +
                         "\n[terrain]\nshape = \"polyline\"\npoints = [[-1, 60], [10, 60], [10, 0], [50, 0]]\n"
                         "[release]\nshape = \"ball\"\nradius = 0.5\ncenter = " +
                         place(x, 2, z) + "\nvelocity = " + place(speed, 0, 0) +
                         "\n[dense_flow]\nsupport_radius = 0.25\nfriction_mu = 0.5\n",
                     "cliff.toml");
}

template <int Dim>
Vec<Dim> middle(const Particles<Dim>& p, const std::vector<Vec<Dim>>& of) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * of[i], mass += p.mass[i];
  return sum / mass;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("F1: snow thrown off a cliff of 90 degrees falls on a parabola", "[cliff]", ((int Dim), Dim), 2,
                       3) {
  Simulation<Dim> simulation(at_the_cliff<Dim>(9.2, 60.8, 12));
  const Particles<Dim>& p = simulation.dense()->particles;
  const Vec<Dim> start = middle<Dim>(p, p.position);
  REQUIRE(p.size() > 40);
  while (!simulation.done()) {
    simulation.step();
    const double t = simulation.time(), longest = simulation.scene().scene.max_step;
    const Vec<Dim> way = middle<Dim>(p, p.position) - start, v = middle<Dim>(p, p.velocity);
    REQUIRE(v[0] == Approx(12).epsilon(1e-9));
    REQUIRE(v[Dim - 1] == Approx(-9.81 * t).epsilon(1e-9));
    REQUIRE(way[0] == Approx(12 * t).epsilon(1e-9));
    const double late = way[Dim - 1] + 9.81 * t * t / 2;  // symplectic Euler falls g t dt / 2 too far
    REQUIRE(late <= 1e-9);
    REQUIRE(late >= -9.81 * t * longest / 2 - 1e-9);
  }
  CHECK(middle<Dim>(p, p.position)[Dim - 1] < start[Dim - 1] - 10);
}

TEMPLATE_TEST_CASE_SIG("F1: snow that falls along a face of 90 degrees feels no friction", "[cliff]", ((int Dim), Dim),
                       2, 3) {
  Simulation<Dim> simulation(at_the_cliff<Dim>(10.5, 40, -3));  // thrown at the face
  const Particles<Dim>& p = simulation.dense()->particles;
  const std::size_t n = p.size();
  double pushed = 0;
  while (simulation.time() < 1.2) {
    simulation.step();
    REQUIRE(p.size() == n);
    const Vec<Dim> v = middle<Dim>(p, p.velocity);
    REQUIRE(v.allFinite());
    REQUIRE(v[Dim - 1] == Approx(-9.81 * simulation.time()).epsilon(1e-9));
    for (const Vec<Dim>& x : p.position) REQUIRE(x[0] >= 10 - 1e-9);
    pushed = std::max(pushed, v[0] + 3);
  }
  CHECK(pushed > 2.9);  // the face did stop it
}
