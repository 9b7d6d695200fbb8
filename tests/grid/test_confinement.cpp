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

TEMPLATE_TEST_CASE_SIG("confinement pushes by the hand-computed force, and books its momentum", "[confinement]",
                       ((int Dim), Dim), 2, 3) {
  // u_x = 2 z^2, u_z = -1.5 x^2: omega = du_x/dz - du_z/dx = 4 z + 3 x > 0 about y, N = (3, 4) / 5 in (x, z), and
  // N x omega = (-0.8, 0.6) omega. Central differences of squares are exact, and so is the mean over two cells. In
  // counter-rotating air the size of omega and N are the same, so that the push turns round.
  constexpr int z = up_axis<Dim>, n = 8;
  const double sign = GENERATE(1.0, -1.0), epsilon = 0.3, dt = 0.1, dx = 0.5;
  const MacGrid<Dim> grid = box_grid<Dim>(n, n * dx);
  FaceField<Dim> u = face_velocity<Dim>(grid, [&](const Vec<Dim>& x) {
    return Vec<Dim>(sign * (2 * x[z] * x[z] * Vec<Dim>::Unit(0) - 1.5 * x[0] * x[0] * Vec<Dim>::Unit(z)));
  });
  const FaceField<Dim> before = u;
  const Vec<Dim> given = confine<Dim>(Confinement<Dim>(), u, 1.0, grid, epsilon, dt);
  Vec<Dim> gained = Vec<Dim>::Zero();
  int n_compared = 0;
  for (int axis = 0; axis < Dim; ++axis)
    for_each_index<Dim>(grid.faces(axis), [&](const Index<Dim>& i) {
      const double change = u[axis][i] - before[axis][i];
      gained[axis] += 1.2 * grid.cell_volume() * change;
      // Two cells beside a side have no force or a gradient that sees one: compared are faces between cells 2 to n - 3.
      for (int k = 0; k < Dim; ++k)
        if (i[k] < (k == axis ? 3 : 2) || i[k] > n - 3) return;
      const Vec<Dim> x = grid.face_centre(axis, i);
      const double omega = sign * (4 * x[z] + 3 * x[0]);
      const double direction = axis == 0 ? -0.8 : axis == z ? 0.6 : 0.0;
      REQUIRE(change == Approx(dt * epsilon * dx * direction * omega).margin(1e-12));
      ++n_compared;
    });
  CHECK(n_compared == Dim * 3 * std::pow(4, Dim - 1));
  CHECK((given - gained).norm() < 1e-12 * gained.norm());
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
