// Drag and lift with the law "air", the default, against numbers worked out by hand. A particle of 0.3 kg and 0.1 m^Dim
// in air of 1.2 kg/m3 and cells of 1 m: the displaced air weighs 0.4 of the particle.
#include <catch2/catch.hpp>

#include "box.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

constexpr double mass = 0.3, volume = 0.1, air_density = 1.2, radius = 0.1;

struct Slowed {
  double v, u;  ///< of the particle, and of the air where it is [m s^-1]
};

/// A particle of 10 m/s along x through still air, k = 0.81 and dt = 0.05 s: a = 0.81 * 0.05 / 0.1 * 0.4 = 0.162 s/m.
template <int Dim>
Slowed drag(const Vec<Dim>& x, bool gravity_predicted) {
  Suspension<Dim> air = air_box<Dim>(8, 1, air_density);
  Particles<Dim> particles;
  add_particle<Dim>(particles, x, 10 * Vec<Dim>::Unit(0), mass, volume);
  run_exchange<Dim>(air, particles, [&](auto& region, auto& exchange) {
    exchange_drag<Dim>(region, exchange, particles, {0.81, ForceLaw::air}, radius, air_density, 0.05,
                       gravity_predicted);
  });
  return {particles.velocity[0][0], velocity_at<Dim>(air.grid(), air.velocity(), x)[0]};
}

/// The centre of a face normal to x, `cells` cells from the box's closed side.
template <int Dim>
Vec<Dim> on_a_face(double cells) {
  Vec<Dim> x = Vec<Dim>::Constant(4.5);
  x[0] = cells;
  return x;
}

/// A particle of 2 m/s along x in the middle of air that turns by 10 rad/s, dt = 0.1 s. Its air stands still.
template <int Dim>
std::array<Vec<Dim>, 2> lift(double k_lift) {
  Suspension<Dim> air = air_box<Dim>(8, 1, air_density, Side::open);
  FaceField<Dim> u = air.velocity();
  for (int axis : {0, Dim - 1})
    for_each_index<Dim>(air.grid().faces(axis), [&](const Index<Dim>& i) {
      const Vec<Dim> x = air.grid().face_centre(axis, i) - Vec<Dim>::Constant(4);
      u[static_cast<std::size_t>(axis)][i] = axis == 0 ? 5 * x[Dim - 1] : -5 * x[0];
    });
  air.set_velocity(u);
  Particles<Dim> particles;
  const Vec<Dim> x = Vec<Dim>::Constant(4);
  add_particle<Dim>(particles, x, 2 * Vec<Dim>::Unit(0), mass, volume);
  run_exchange<Dim>(air, particles, [&](auto& region, auto& exchange) {
    exchange_lift<Dim>(region, exchange, particles, air, {k_lift, ForceLaw::air}, 0.1);
  });
  return {particles.velocity[0], velocity_at<Dim>(air.grid(), air.velocity(), x)};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Drag of the displaced air: hand-computed exchange with one face", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  // beta = a w = 1.62, gamma = 0.618321; u' = 0.3 gamma 10 / (1.2 + 0.3 gamma), v' = 10 - gamma (10 - u').
  const Slowed slowed = drag<Dim>(on_a_face<Dim>(4), false);
  CHECK(slowed.v == Approx(4.644628099).epsilon(1e-9));
  CHECK(slowed.u == Approx(1.338842975).epsilon(1e-9));
}

TEMPLATE_TEST_CASE_SIG("Drag of falling snow: hand-computed with the loading of the faces around", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  // Along x one face of 1.2 kg carries all, 0.25; along every other axis four faces carry a quarter each, 0.0625. So
  // phi is 0.15625 in 2D and 0.125 in 3D, and beta = (sqrt(1 + 4 a (1 + phi) w) - 1) / (2 (1 + phi)) 0.827758 and
  // 0.835216.
  const Slowed slowed = drag<Dim>(on_a_face<Dim>(4), true);
  CHECK(slowed.v == Approx(Dim == 2 ? 5.931789379 : 5.913856018).epsilon(1e-9));
  CHECK(slowed.u == Approx(Dim == 2 ? 1.017052655 : 1.021535995).epsilon(1e-9));
}

TEMPLATE_TEST_CASE_SIG("Beside a closed side the open faces take the whole exchange", "[coupling]", ((int Dim), Dim), 2,
                       3) {
  // A quarter of a cell from the side, whose faces cannot move: the next face has weight 1/4 of the interpolation, but
  // all of the exchange. Where the particle is, a quarter of that face's velocity is seen.
  const Slowed slowed = drag<Dim>(on_a_face<Dim>(0.25), false);
  CHECK(slowed.v == Approx(4.644628099).epsilon(1e-9));
  CHECK(slowed.u == Approx(1.338842975 / 4).epsilon(1e-9));
}

TEMPLATE_TEST_CASE_SIG("Lift of the displaced air: hand-computed turn of the slip, and the air's answer", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  // 2^(Dim-1) faces an axis share the particle: phi = 0.3 / 1.2 / 2^(Dim-1). theta = 0.5 * 0.1 * 0.4 * (1 + phi) * 10,
  // w' = (2, -2 theta) / (1 + theta^2), v' = v + (w' - w) / (1 + phi).
  const auto [v, u] = lift<Dim>(0.5);
  Vec<Dim> v_expected = Vec<Dim>::Zero(), u_expected = Vec<Dim>::Zero();
  v_expected[0] = Dim == 2 ? 1.914336704 : 1.918672447;
  v_expected[Dim - 1] = Dim == 2 ? -0.380725758 : -0.382717895;
  u_expected[0] = Dim == 2 ? 0.010707912 : 0.005082972;  // what the particle lost, on 1.2 kg times 2^(Dim-1)
  u_expected[Dim - 1] = Dim == 2 ? 0.047590720 : 0.023919868;
  CHECK((v - v_expected).norm() < 1e-8);
  CHECK((u - u_expected).norm() < 1e-8);
}

TEMPLATE_TEST_CASE_SIG("Lift turns by one radian at most", "[coupling]", ((int Dim), Dim), 2, 3) {
  // k = 3 asks for 1.3, k = 50 for more than 20: w' = (2, -2) / 2 instead, whatever k.
  const double phi = Dim == 2 ? 0.125 : 0.0625;
  Vec<Dim> expected = Vec<Dim>::Zero();
  expected[0] = 2 - 1 / (1 + phi);
  expected[Dim - 1] = -1 / (1 + phi);
  for (const double k_lift : {3.0, 50.0, 5000.0}) CHECK((lift<Dim>(k_lift)[0] - expected).norm() < 1e-12);
}
