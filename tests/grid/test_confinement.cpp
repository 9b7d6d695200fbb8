#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "suspension_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;
using std::numbers::pi;

namespace {

double vortex(double x, double z) {
  const double r2 = (x - 0.5) * (x - 0.5) + (z - 0.5) * (z - 0.5);
  return std::exp(-r2 / 0.02);
}

/// Where all faces have the same flow area and there is no smoke.
template <int Dim, class C>
Vec<Dim> confine(C&& confinement, FaceField<Dim>& u, double area, const MacGrid<Dim>& grid, double strength,
                 double dt) {
  return confinement.apply(u, make_face_field<Dim>(grid, area), Ground<Dim>(grid, 1.2), Field<Dim>(grid.cells), grid,
                           strength, dt);
}

/// Largest change of velocity by confinement of strength 1 in 1 s.
template <int Dim>
double push(int n) {
  const MacGrid<Dim> grid = box_grid<Dim>(n);
  FaceField<Dim> u = swirl<Dim>(grid, vortex);
  const FaceField<Dim> before = u;
  confine<Dim>(Confinement<Dim>(), u, 1.0, grid, 1, 1);
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < u[axis].size(); ++f) u[axis][f] -= before[axis][f];
  return largest<Dim>(u);
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("confinement spins a vortex up", "[confinement]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(Dim == 2 ? 32 : 20);
  FaceField<Dim> u = swirl<Dim>(grid, vortex);
  const auto energy = [&] {
    double e = 0;
    for (const auto& c : u)
      for (std::size_t f = 0; f < c.size(); ++f) e += c[f] * c[f];
    return e;
  };
  const double before = energy();
  confine<Dim>(Confinement<Dim>(), u, 1.0, grid, 0.5, 0.01);
  CHECK(energy() > before);
}

TEMPLATE_TEST_CASE_SIG("confinement vanishes with dx", "[confinement]", ((int Dim), Dim), 2, 3) {
  const int n = Dim == 2 ? 64 : 32;
  CHECK(push<Dim>(2 * n) < 0.65 * push<Dim>(n));
}

TEMPLATE_TEST_CASE_SIG("confinement leaves faces without flow and uniform air alone", "[confinement]", ((int Dim), Dim),
                       2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(12);
  FaceField<Dim> u = make_face_field<Dim>(grid, 2.0);
  Confinement<Dim> confinement;
  CHECK(confinement.bytes() == 0);
  confine<Dim>(confinement, u, 1.0, grid, 1, 1);
  for (const auto& c : u)
    for (std::size_t f = 0; f < c.size(); ++f) REQUIRE(c[f] == 2);
  u = swirl<Dim>(grid, vortex);
  const FaceField<Dim> before = u;
  confine<Dim>(confinement, u, 0.0, grid, 1, 1);
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < u[axis].size(); ++f) REQUIRE(u[axis][f] == before[axis][f]);
}

TEMPLATE_TEST_CASE_SIG("absent confinement is off to the bit, present it reports its momentum", "[confinement]",
                       ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(12);
  const auto run = [&](std::optional<double> strength, Stages& stages) {
    SuspensionOptions<Dim> options = exact_options<Dim>();
    options.confinement = strength;
    Suspension<Dim> air(grid, all_sides<Dim>(Side::closed), options);
    air.set_velocity(swirl<Dim>(grid, [](double x, double z) {
      return std::sin(pi * x) * std::sin(2 * pi * z) + 0.3 * std::sin(2 * pi * x) * std::sin(pi * z);
    }));
    air.advance(0.02, {}, stages);
    return air;
  };
  Stages off, zero, on;
  const auto a = run(std::nullopt, off), b = run(0.0, zero), c = run(0.5, on);
  CHECK(off.passes("suspension.confinement") == 0);
  CHECK(on.passes("suspension.confinement") == 1);
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < a.velocity()[axis].size(); ++f) REQUIRE(a.velocity()[axis][f] == b.velocity()[axis][f]);
  CHECK(a.budget().confinement.isZero());
  CHECK(c.budget().confinement.norm() > 0);
}
