#include <catch2/catch.hpp>

#include "fluid_fixture.hpp"
#include "sph/artificial_viscosity.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

constexpr double d = 0.1;

template <int Dim>
const Vec<Dim> pair_axis = 0.6 * Vec<Dim>::Unit(0) + 0.8 * up<Dim>();

/// Two particles d apart along pair_axis: 300 and 150 kg/m3, the second of twice the volume, so that both
/// have the same mass. Wave speeds 10 and 2 m/s.
template <int Dim>
struct Pair {
  DenseFlow<Dim> flow{options_for<Dim>(d)};

  Pair(const Vec<Dim>& v0, const Vec<Dim>& v1, double dt, std::vector<double> wave_speed = {10, 2}) {
    Particles<Dim>& p = flow.particles;
    add_particle<Dim>(p, Vec<Dim>::Zero(), v0, std::pow(d, Dim), 300);
    add_particle<Dim>(p, d * pair_axis<Dim>, v1, 2 * std::pow(d, Dim), 150);
    Stages stages;
    flow.sort(no_walls<Dim>(), stages);
    flow.find_neighbours(no_walls<Dim>(), {}, stages);
    if (p.id[0] == 1) std::swap(wave_speed[0], wave_speed[1]);
    ArtificialViscosity<Dim>(d).apply(p, flow.neighbours(), wave_speed, dt);
  }
  Vec<Dim> velocity(std::uint64_t id) const { return flow.particles.velocity[flow.particles.id[0] == id ? 0 : 1]; }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("artificial viscosity slows two approaching particles by the hand-computed impulse",
                       "[artificial_viscosity]", ((int Dim), Dim), 2, 3) {
  // alpha c = 0.3 * 6 = 1.8, rho = 150, v_ij . x_ij = -2 * 0.1, x_ij^2 + 0.01 d^2 = 0.0101, and at q = 1/2
  // |dW/dr| = 1.5 W(0) / h. J = dt * 1.8 * 150 * d * (0.2 / 0.0101) * (d^Dim * 2 d^Dim) * 1.5 W(0) / 0.2,
  // W(0) = 40 / (7 pi 0.04) in 2D, 8 / (pi 0.008) in 3D; J / m, both masses being 300 d^Dim:
  const Vec<Dim> e = pair_axis<Dim>, shear = 3 * (0.8 * Vec<Dim>::Unit(0) - 0.6 * up<Dim>());
  const double slowed = Dim == 2 ? 0.012156106 : 0.008509274;
  const Pair<Dim> pair(e + shear, -e - shear, 1e-3);
  CHECK((pair.velocity(0) - shear - (1 - slowed) * e).norm() < 1e-6 * slowed);
  CHECK((pair.velocity(1) + shear + (1 - slowed) * e).norm() < 1e-6 * slowed);
}

TEMPLATE_TEST_CASE_SIG("artificial viscosity stays under its bound of stability", "[artificial_viscosity]",
                       ((int Dim), Dim), 2, 3) {
  // At dt = 0.1 s alpha c is 0.25 d / dt = 0.25 instead of 1.8; otherwise as before.
  const Vec<Dim> e = pair_axis<Dim>;
  const double slowed = Dim == 2 ? 0.168834805 : 0.118184364;
  const Pair<Dim> pair(e, -e, 0.1);
  CHECK((pair.velocity(0) - (1 - slowed) * e).norm() < 1e-6 * slowed);
  CHECK((pair.velocity(0) + pair.velocity(1)).norm() < 1e-15);
}

TEMPLATE_TEST_CASE_SIG("artificial viscosity leaves particles alone that separate, shear or have no wave speed",
                       "[artificial_viscosity]", ((int Dim), Dim), 2, 3) {
  const Vec<Dim> e = pair_axis<Dim>, shear = 0.8 * Vec<Dim>::Unit(0) - 0.6 * up<Dim>();
  const Pair<Dim> separating(-e, e, 1e-3), shearing(shear, -shear, 1e-3), quiet(e, -e, 1e-3, {0, 0});
  CHECK(separating.velocity(0) == Vec<Dim>(-e));
  CHECK(separating.velocity(1) == Vec<Dim>(e));
  CHECK((shearing.velocity(0) - shear).norm() < 1e-15);
  CHECK(quiet.velocity(0) == Vec<Dim>(e));
  const Pair<Dim> half_quiet(e, -e, 1e-3, {0, 12});  // the mean of the two speeds counts, 6 as above
  CHECK(e.dot(half_quiet.velocity(0)) == Approx(1 - (Dim == 2 ? 0.012156106 : 0.008509274)).epsilon(1e-7));
}
