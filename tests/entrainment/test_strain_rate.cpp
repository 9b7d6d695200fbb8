#include <catch2/catch.hpp>
#include <cmath>

#include "entrainment/strain_rate.hpp"

using namespace spindrift;

TEST_CASE("Kojima's viscosity, Eq. (15)", "[entrainment]") {
  CHECK(cover_viscosity(0) == Approx(8.5e6));
  CHECK(cover_viscosity(100) == Approx(6.9412e7).epsilon(1e-4));  // 8.5e6 e^2.1
  CHECK(cover_viscosity(300) / cover_viscosity(100) == Approx(std::exp(4.2)).epsilon(1e-12));
}

TEST_CASE("strain rate, Eq. (14), with the overburden as a stress", "[entrainment]") {
  const double g_tangential = 9.81 * std::sin(35 * M_PI / 180), eta = cover_viscosity(100);
  CHECK(strain_rate(1 * 300, g_tangential, eta) == Approx(2.432e-5).epsilon(1e-3));
  CHECK(strain_rate(2 * 300, g_tangential, eta) == Approx(4.864e-5).epsilon(1e-3));
  CHECK(strain_rate(0, g_tangential, eta) == 0);
  CHECK(strain_rate(300, 0, eta) == 0);
  CHECK(strain_rate(0, g_tangential, 2e7, 1000) == Approx(5e-5).epsilon(1e-12));
  CHECK(strain_rate(100, 5, 2e7, 1000, 0.5) == Approx(5e-5).epsilon(1e-12));
  CHECK(strain_rate(100, 5, 2e7, 1000, 0) == Approx(2.5e-5).epsilon(1e-12));
}

TEST_CASE("threshold, log-linear from the initial surface to the base", "[entrainment]") {
  const FailureThreshold threshold;
  CHECK(failure_strain_rate(threshold, 0, 0.525) == Approx(1e-6).epsilon(1e-12));
  CHECK(failure_strain_rate(threshold, 0.2625, 0.525) == Approx(1e-5).epsilon(1e-12));
  CHECK(failure_strain_rate(threshold, 0.525, 0.525) == Approx(1e-4).epsilon(1e-12));
  CHECK(failure_strain_rate(threshold, -1, 0.525) == Approx(1e-6).epsilon(1e-12));
  CHECK(failure_strain_rate(threshold, 7, 0.525) == Approx(1e-4).epsilon(1e-12));
  CHECK(failure_strain_rate(threshold, 0, 0) == threshold.surface);
  CHECK(failure_strain_rate({2e-6, 2e-6}, 0.3, 0.5) == Approx(2e-6).epsilon(1e-12));
}

TEST_CASE("2 m of dense flow break a cover of 0.3 m to its base at 35 degrees only through friction", "[entrainment]") {
  const double eta = cover_viscosity(100), slope = 35 * M_PI / 180, column = 600;
  const double base = failure_strain_rate({}, 0.3, 0.3);
  CHECK(strain_rate(column, 9.81 * std::sin(slope), eta) < base);
  const double traction = 0.25 * column * 9.81 * std::cos(slope) + 300 * 9.81 * 30 * 30 / 1000;
  CHECK(strain_rate(column, 9.81 * std::sin(slope), eta, traction) > base);
}
