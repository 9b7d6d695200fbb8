// The limits of the dense flow's step by hand: d = 0.1 m, cfl = 0.4, g = 10 m/s2.
#include <catch2/catch.hpp>

#include "fluid_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

/// Three particles of 300 kg/m3 far from each other, at rest and without pressure.
template <int Dim>
DenseFlow<Dim> three(DenseFlowOptions options = options_for<Dim>(0.1)) {
  DenseFlow<Dim> flow(options);
  for (const double x : {0.0, 1.0, 2.0})
    add_particle<Dim>(flow.particles, x * Vec<Dim>::Unit(0), Vec<Dim>::Zero(), std::pow(0.1, Dim), 300);
  return flow;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the step of particles: start from rest, speed and pressure by hand", "[time_step]",
                       ((int Dim), Dim), 2, 3) {
  DenseFlow<Dim> flow = three<Dim>();
  Particles<Dim>& p = flow.particles;
  SECTION("from rest 0.4 sqrt(0.1 / 10)") {
    CHECK(flow.time_step_limit(0.4, 10) == Approx(0.04));
    CHECK(std::isinf(flow.time_step_limit(0.4, 0)));
  }
  SECTION("the fastest, 0.4 * 0.1 / 5") {
    p.velocity[0] = 2 * Vec<Dim>::Unit(0);
    p.velocity[2] = 3 * Vec<Dim>::Unit(0) - 4 * up<Dim>();
    CHECK(flow.time_step_limit(0.4, 10) == Approx(0.008));
    CHECK(flow.time_step_limit(0.2, 10) == Approx(0.004));
  }
  SECTION("pressure, 0.6 * 0.1 / sqrt(p / rho) whatever the cfl, with the particle's own density") {
    p.pressure = {3000, 0, 1500};
    CHECK(flow.time_step_limit(0.4, 10) == Approx(0.06 / std::sqrt(10.0)));
    CHECK(flow.time_step_limit(0.5, 10) == Approx(0.06 / std::sqrt(10.0)));
    p.mass[2] /= 4;  // 1500 Pa on 75 kg/m3
    CHECK(flow.time_step_limit(0.4, 10) == Approx(0.06 / std::sqrt(20.0)));
  }
}

TEMPLATE_TEST_CASE_SIG("the step of the equation of state: sound, never without the limits of motion", "[time_step]",
                       ((int Dim), Dim), 2, 3) {
  DenseFlowOptions options = options_for<Dim>(0.1);
  options.solver = DenseSolver::wcsph;
  options.sound_speed = 20;
  DenseFlow<Dim> flow = three<Dim>(options);
  Particles<Dim>& p = flow.particles;
  p.pressure = {1e9, 0, 0};  // of no account here
  CHECK(flow.time_step_limit(0.4, 10) == Approx(0.4 * 0.1 / 20));
  for (double& m : p.mass) m *= 4;  // no longer a step for heavy snow
  CHECK(flow.time_step_limit(0.4, 10) == Approx(0.4 * 0.1 / 20));
  p.velocity[1] = 50 * Vec<Dim>::Unit(0);
  CHECK(flow.time_step_limit(0.4, 10) == Approx(0.4 * 0.1 / 50));
  p.velocity[1].setZero();
  CHECK(flow.time_step_limit(0.4, 1e7) == Approx(0.4 * 1e-4));
}
