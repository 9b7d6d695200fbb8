#include <catch2/catch.hpp>
#include <numbers>

#include "box.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

/// Integral of C_g S w(t)^1.7 with dw/dt = -(1 + phi) (a / dt) w^2, by many small steps.
double integrated_smoke(double c_g, double surface, double slip, double b, double threshold, double dt) {
  const int n = 200000;
  double dm = 0;
  for (int i = 0; i < n; ++i) {
    const double w = slip / (1 + b * (i + 0.5) / n);
    if (w > threshold) dm += c_g * surface * std::pow(w, 1.7) * dt / n;
  }
  return dm;
}

}  // namespace

TEST_CASE("Surface and section of particles", "[coupling]") {
  CHECK(surface<2>(0.5) == Approx(std::numbers::pi));
  CHECK(section<2>(0.5) == Approx(1));
  CHECK(surface<3>(0.5) == Approx(std::numbers::pi));
  CHECK(section<3>(0.5) == Approx(std::numbers::pi / 4));
}

TEST_CASE("Generation is the integral of Eq. (12) along the speed that drag leaves", "[coupling]") {
  const double slip = GENERATE(0.5, 6.0, 30.0);
  const double b = GENERATE(0.0, 1e-7, 0.3, 40.0);
  const double threshold = GENERATE(0.0, 5.0);
  CHECK(generated_smoke({0.2, threshold}, slip, b, 0.33, 0.01) ==
        Approx(integrated_smoke(0.2, 0.33, slip, b, threshold, 0.01)).epsilon(1e-4));
}

TEST_CASE("The mean slip is that of exact drag", "[coupling]") {
  CHECK(mean_slip(10, 0) == 10);
  CHECK(mean_slip(10, 1e-12) == Approx(10));
  CHECK(mean_slip(10, std::exp(1.0) - 1) == Approx(10 / (std::exp(1.0) - 1)));
}

TEMPLATE_TEST_CASE_SIG("C8: generation and adhesion find their equilibrium at any time step", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  // Heavy snow in the middle of a cell of still air: w stays what it is.
  const double w = GENERATE(1.0, 10.0, 30.0);
  const double dt = GENERATE(1e-3, 0.1, 100.0);
  const double r = 0.05, c_g = 0.2, c_a = 0.2;
  Suspension<Dim> air = air_box<Dim>(3, 1, 1.2);
  Particles<Dim> particles;
  const int n = 1000;
  for (int i = 0; i < n; ++i)
    add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(1.5)), w * Vec<Dim>::Unit(0), 1e9);
  const SmokeOptions options{GenerationOptions{c_g, 0}, AdhesionOptions{c_a}, r, 0, 1e12};
  const double rate = c_a * n * section<Dim>(r) * w;  // of a cell of 1 m^Dim
  const double equilibrium = c_g / c_a * surface<Dim>(r) / section<Dim>(r) * std::pow(w, 0.7);
  Field<Dim> smoke = air.smoke_mass();
  double elapsed = 0;
  for (int step = 0; step < 3; ++step) {
    OverlapRegion<Dim> region;
    Exchange<Dim> exchange;
    exchange.clear(particles.size());
    find_region<Dim>(region, particles, std::vector<std::uint8_t>(particles.size(), 1), air);
    exchange_smoke<Dim>(region, exchange, particles, air, options, dt);
    REQUIRE(exchange.on_grid.smoke.size() == 1);
    smoke[exchange.on_grid.smoke[0].point] += exchange.on_grid.smoke[0].amount;
    air.set_smoke_mass(smoke);
    elapsed += dt;
    CHECK(air.total_smoke() == Approx(equilibrium * -std::expm1(-rate * elapsed)).epsilon(1e-10));
  }
  if constexpr (Dim == 3) CHECK(equilibrium == Approx(4 * std::pow(w, 0.7)));
}

TEMPLATE_TEST_CASE_SIG("C7: smoke and particles share one mass and one momentum", "[coupling]", ((int Dim), Dim), 2,
                       3) {
  const Side side = GENERATE(Side::closed, Side::open);
  Suspension<Dim> air = air_box<Dim>(6, 0.33, 1.2, side);
  stir<Dim>(air, 10);
  Field<Dim> smoke = air.smoke_mass();
  for (std::size_t c = 0; c < smoke.size(); ++c) smoke[c] = 0.1 * (1 + noise(c, 60));
  air.set_smoke_mass(smoke);
  Particles<Dim> particles;
  for (std::uint64_t i = 0; i < 2000; ++i)
    add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(0.99) + 0.98 * noise_vector<Dim>(i, 0)),
                      Vec<Dim>(30 * noise_vector<Dim>(i, 10)), 0.2 + 3 * uniform(5, RandomStream::bernoulli, i), 0.011);
  const SmokeOptions options{GenerationOptions{0.2, 0}, AdhesionOptions{0.2}, 0.0525, 0.16, 3};
  const auto snow = [&] {
    double sum = air.total_smoke();
    for (const double m : particles.mass) sum += m;
    return sum;
  };
  const double mass = snow();
  const Vec<Dim> grid_before = air.momentum();
  const Exchange<Dim> exchange = run_exchange<Dim>(air, particles, [&](auto& region, auto& out) {
    exchange_drag<Dim>(region, out, particles, {0.81, ForceLaw::air}, 0.0525, 1.2, 0.01, true);
    exchange_smoke<Dim>(region, out, particles, air, options, 0.01);
  });
  double scale = 0;
  for (std::size_t i = 0; i < particles.size(); ++i) scale += particles.mass[i] * particles.velocity[i].norm();
  CHECK(exchange.generated > 1);
  CHECK(exchange.adhered > 0.1);
  CHECK(snow() == Approx(mass).epsilon(1e-13));
  CHECK(std::abs(mass_imbalance(exchange)) < 1e-12 * mass);
  CHECK(momentum_imbalance(exchange).norm() < 1e-13 * scale);
  CHECK((air.momentum() - grid_before - momentum_on_grid(exchange)).norm() < 1e-13 * scale);
  for (const double m : particles.mass) CHECK(m >= 0.16 * (1 - 1e-12));
  for (const double m : air.smoke_mass().values()) CHECK(m >= 0);
}

TEMPLATE_TEST_CASE_SIG("Smoke made in air of the same velocity leaves the wind as it is", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  Suspension<Dim> air = air_box<Dim>(6, 1, 1.2, Side::open);
  FaceField<Dim> u = air.velocity();
  for (double& value : u[0].values()) value = 7;
  air.set_velocity(u);
  Particles<Dim> particles;
  add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(3.2)), 7 * Vec<Dim>::Unit(0), 1.0);
  OverlapRegion<Dim> region;
  Exchange<Dim> exchange;
  CHECK(dissolve_spent<Dim>(region, exchange, particles, air, 2.0) == 1);
  CHECK(exchange.on_particles.mass[0] == -1);
  air.apply(exchange.on_grid);
  CHECK(air.total_smoke() == Approx(1).epsilon(1e-14));
  for (const double value : air.velocity()[0].values()) CHECK(value == Approx(7).epsilon(1e-14));
}

TEMPLATE_TEST_CASE_SIG("A particle at max_mass sweeps up no smoke, one at min_mass gives none (R17)", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  // Two particles in the middle of one cell of 1 m^Dim with 0.1 kg of smoke; only the one between the bounds takes
  // part.
  const double r = 0.05, w = 10, c_a = 0.2, dt = 0.01, smoke = 0.1;
  const bool lower = GENERATE(false, true);
  Suspension<Dim> air = air_box<Dim>(3, 1, 1.2);
  Field<Dim> held = air.smoke_mass();
  for (double& m : held.values()) m = smoke;
  air.set_smoke_mass(held);
  Particles<Dim> particles;
  add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(1.5)), w * Vec<Dim>::Unit(0), lower ? 0.1 : 2);
  add_particle<Dim>(particles, Vec<Dim>(Vec<Dim>::Constant(1.5)), w * Vec<Dim>::Unit(0), 1.999);
  SmokeOptions options{std::nullopt, AdhesionOptions{c_a}, r, 0.1, 2};
  if (lower) options = {GenerationOptions{0.2, 0}, std::nullopt, r, 0.1, 2};
  const Exchange<Dim> exchange = run_exchange<Dim>(
      air, particles, [&](auto& region, auto& out) { exchange_smoke<Dim>(region, out, particles, air, options, dt); });
  CHECK(exchange.on_particles.mass[0] == 0);
  CHECK(exchange.on_particles.momentum[0].norm() == 0);
  const double swept = smoke * -std::expm1(-c_a * section<Dim>(r) * w * dt);
  const double made = 0.2 * surface<Dim>(r) * std::pow(w, 1.7) * dt;
  CHECK(exchange.on_particles.mass[1] == Approx(lower ? -made : swept).epsilon(1e-12));
}
