#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "suspension_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;
using std::numbers::pi;

namespace {

struct TaylorGreen {
  double energy = 0;  ///< kinetic, at t = 2 over that at t = 0
  double error = 0;   ///< root mean square over all faces of the change since t = 0, over the largest speed
};

/// The inviscid Taylor-Green vortex in a closed box at t = 2, at CFL 1 (case B3). It is steady.
TaylorGreen taylor_green(int n, AdvectionScheme scheme, bool reflection = false) {
  const MacGrid<2> grid = box_grid<2>(n);
  SuspensionOptions<2> options = exact_options<2>();
  options.scheme = scheme;
  options.reflection = reflection;
  options.pressure.tolerance = 1e-8;
  Suspension<2> air(grid, all_sides<2>(Side::closed), options);
  const FaceField<2> exact =
      swirl<2>(grid, [](double x, double z) { return std::sin(2 * pi * x) * std::sin(2 * pi * z) / (2 * pi); });
  air.set_velocity(exact);
  Stages stages;
  for (int step = 0; step < 2 * n; ++step) air.advance(1.0 / n, {}, stages);
  TaylorGreen result;
  double start = 0;
  std::size_t n_faces = 0;
  for (std::size_t axis = 0; axis < 2; ++axis)
    for (std::size_t f = 0; f < exact[axis].size(); ++f, ++n_faces) {
      const double u = air.velocity()[axis][f], u0 = exact[axis][f];
      start += u0 * u0;
      result.energy += u * u;
      result.error += (u - u0) * (u - u0);
    }
  result.energy /= start;
  result.error = std::sqrt(result.error / static_cast<double>(n_faces));
  return result;
}

}  // namespace

TEST_CASE("Taylor-Green keeps the energy that its scheme is known to keep", "[advection]") {
  const double maccormack = taylor_green(32, AdvectionScheme::maccormack).energy;
  const double semi_lagrangian = taylor_green(32, AdvectionScheme::semi_lagrangian).energy;
  UNSCOPED_INFO("MacCormack " << maccormack << ", semi-Lagrangian " << semi_lagrangian);
  CHECK(maccormack > 0.9 * 0.46);
  CHECK(maccormack < 1);
  CHECK(semi_lagrangian == Approx(0.27).epsilon(0.1));
}

TEST_CASE("Taylor-Green at 64 and 128 cells", "[advection][slow]") {
  CHECK(taylor_green(64, AdvectionScheme::maccormack).energy > 0.9 * 0.63);
  CHECK(taylor_green(128, AdvectionScheme::maccormack).energy > 0.9 * 0.77);
  CHECK(taylor_green(64, AdvectionScheme::semi_lagrangian).energy == Approx(0.47).epsilon(0.1));
  CHECK(taylor_green(128, AdvectionScheme::semi_lagrangian).energy == Approx(0.66).epsilon(0.1));
}

TEST_CASE("Taylor-Green with reflection is of second order and keeps its energy", "[advection][slow]") {
  const TaylorGreen coarse = taylor_green(32, AdvectionScheme::maccormack, true);
  const TaylorGreen middle = taylor_green(64, AdvectionScheme::maccormack, true);
  const TaylorGreen fine = taylor_green(128, AdvectionScheme::maccormack, true);
  CAPTURE(coarse.energy, middle.energy, fine.energy, coarse.error, middle.error, fine.error);
  CHECK(coarse.energy > 0.94);
  CHECK(middle.energy > 0.985);
  CHECK(fine.energy > 0.996);
  CHECK(fine.error < 1e-3);
  CHECK(std::log2(coarse.error / middle.error) > 1.9);
  CHECK(std::log2(middle.error / fine.error) > 1.9);
}

TEMPLATE_TEST_CASE_SIG("rows read in order and rows with look-ups agree", "[advection]", ((int Dim), Dim), 2, 3) {
  const int n = Dim == 2 ? 40 : 20;
  const MacGrid<Dim> grid = box_grid<Dim>(n, 2.0);
  Ground<Dim> ground(grid, 1.2);
  Field<Dim> distance(grid.nodes());
  for_each_index<Dim>(grid.nodes(),
                      [&](const Index<Dim>& i) { distance[i] = grid.node(i)[Dim - 1] - 0.55 + 0.2 * grid.node(i)[0]; });
  ground.set(distance, std::array{Span{0, n}});
  const FaceField<Dim> carrier = face_velocity<Dim>(grid, [](const Vec<Dim>& x) {
    Vec<Dim> u;
    for (int k = 0; k < Dim; ++k) u[k] = std::sin(3 * x[(k + 1) % Dim] + k) * std::cos(5 * x[k]);
    return u;
  });
  FaceField<Dim> area = make_face_field<Dim>(grid);
  RowSpeeds<Dim> slow, fast;  // the second claims speeds that force look-ups
  for (int axis = 0; axis < Dim; ++axis) {
    for (std::size_t f = 0; f < area[axis].size(); ++f) area[axis][f] = ground.open()[axis][f];
    slow[axis].assign(area[axis].n_rows(), 1.0);
    fast[axis].assign(area[axis].n_rows(), 1e9);
  }
  const AdvectionScheme scheme = GENERATE(AdvectionScheme::semi_lagrangian, AdvectionScheme::maccormack);
  const double dt = grid.dx * GENERATE(0.05, 0.6, 1.0);
  VelocityAdvection<Dim> advection(grid);
  FaceField<Dim> a = face_velocity<Dim>(grid, [](const Vec<Dim>&x) { return Vec<Dim>((4 * x).array().sin()); }), b = a;
  const FaceField<Dim> before = a;
  advection.advect(a, {grid, ground.rows(), carrier, slow, area}, dt, scheme);
  advection.advect(b, {grid, ground.rows(), carrier, fast, area}, dt, scheme);
  double difference = 0, change = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    for (std::size_t r = 0; r < a[axis].n_rows(); ++r) {
      for (int i = ground.rows(axis)[r].begin; i < ground.rows(axis)[r].end; ++i) {
        const std::size_t f = r * static_cast<std::size_t>(a[axis].shape()[0]) + static_cast<std::size_t>(i);
        difference = std::max(difference, std::abs(a[axis][f] - b[axis][f]));
        change = std::max(change, std::abs(a[axis][f] - before[axis][f]));
        if (area[axis][f] <= 0) REQUIRE(a[axis][f] == before[axis][f]);
      }
    }
  }
  CHECK(change > 1e-3);
  CHECK(difference < 1e-12);
}

TEMPLATE_TEST_CASE_SIG("a uniform carrier shifts a linear field exactly, at any CFL number", "[advection]",
                       ((int Dim), Dim), 2, 3) {
  const int n = 16;
  const MacGrid<Dim> grid = box_grid<Dim>(n, n);
  const Ground<Dim> ground(grid, 1.2);
  Vec<Dim> wind;
  for (int k = 0; k < Dim; ++k) wind[k] = 0.3 + 0.2 * k;
  const FaceField<Dim> carrier = face_velocity<Dim>(grid, [&](const Vec<Dim>&) { return wind; });
  RowSpeeds<Dim> speeds;
  for (int axis = 0; axis < Dim; ++axis) speeds[axis].assign(carrier[axis].n_rows(), wind.maxCoeff());
  const FaceField<Dim> area = make_face_field<Dim>(grid, 1.0);
  Vec<Dim> gradient;
  for (int k = 0; k < Dim; ++k) gradient[k] = 1 + k;
  FaceField<Dim> u =
      face_velocity<Dim>(grid, [&](const Vec<Dim>& x) { return Vec<Dim>::Constant(gradient.dot(x)).eval(); });
  const double dt = GENERATE(0.5, 1.0, 5.0);
  VelocityAdvection<Dim>(grid).advect(u, {grid, ground.rows(), carrier, speeds, area}, dt, AdvectionScheme::maccormack);
  Index<Dim> middle;
  middle.fill(n / 2);
  for (int axis = 0; axis < Dim; ++axis)
    CHECK(u[axis][middle] == Approx(gradient.dot(grid.face_centre(axis, middle) - dt * wind)));
}
