#include <catch2/catch.hpp>
#include <cmath>

#include "suspension_fixture.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

/// Variance along x of smoke over its mass.
template <int Dim>
double variance(const MacGrid<Dim>& grid, const Field<Dim>& smoke, int axis) {
  double mass = 0, mean = 0, square = 0;
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
    const double x = grid.cell_centre(i)[axis];
    mass += smoke[i], mean += smoke[i] * x, square += smoke[i] * x * x;
  });
  return square / mass - (mean / mass) * (mean / mass);
}

template <int Dim>
FaceField<Dim> whole_areas(const MacGrid<Dim>& grid) {
  return make_face_field<Dim>(grid, grid.face_area());
}

template <int Dim>
Field<Dim> gaussian(const MacGrid<Dim>& grid, double sigma) {
  Field<Dim> smoke(grid.cells);
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
    smoke[i] = std::exp(-(grid.cell_centre(i) - Vec<Dim>::Constant(0.5)).squaredNorm() / (2 * sigma * sigma));
  });
  return smoke;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the variance of a Gaussian grows by 2 kappa t", "[diffusion]", ((int Dim), Dim), 2, 3) {
  const int n = Dim == 2 ? 64 : 32;
  const MacGrid<Dim> grid = box_grid<Dim>(n);
  const Ground<Dim> ground(grid, 1.2);
  Field<Dim> smoke = gaussian<Dim>(grid, 0.06);
  const double before = variance<Dim>(grid, smoke, 0), kappa = 0.01, dt = 0.01;
  Diffusion<Dim> diffusion;
  for (int step = 0; step < 20; ++step) diffusion.diffuse_smoke(smoke, whole_areas(grid), grid, ground, kappa, dt);
  for (int axis = 0; axis < Dim; ++axis)
    CHECK(variance<Dim>(grid, smoke, axis) - before == Approx(2 * kappa * 20 * dt).epsilon(0.005));
}

TEMPLATE_TEST_CASE_SIG("diffusion is stable, positive and conservative up to kappa dt / dx^2 = 1e4", "[diffusion]",
                       ((int Dim), Dim), 2, 3) {
  const double number = GENERATE(0.1, 1.0, 100.0, 1e4);
  const MacGrid<Dim> grid = box_grid<Dim>(16);
  Ground<Dim> ground(grid, 1.2);
  Field<Dim> smoke = gaussian<Dim>(grid, 0.05);
  double start = 0, most = 0;
  for (std::size_t c = 0; c < smoke.size(); ++c) start += smoke[c], most = std::max(most, smoke[c]);
  Diffusion<Dim> diffusion;
  for (int step = 0; step < 200; ++step)
    diffusion.diffuse_smoke(smoke, whole_areas(grid), grid, ground, number * grid.dx * grid.dx, 1);
  double end = 0;
  for (std::size_t c = 0; c < smoke.size(); ++c) {
    end += smoke[c];
    REQUIRE((smoke[c] >= 0 && smoke[c] <= most));
  }
  CHECK(end == Approx(start).epsilon(1e-12));
  if (number >= 100) CHECK(smoke[std::size_t{0}] == Approx(start / static_cast<double>(smoke.size())).epsilon(1e-6));
}

TEMPLATE_TEST_CASE_SIG("smoke does not diffuse through closed faces", "[diffusion]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = box_grid<Dim>(4);
  const Ground<Dim> ground(grid, 1.2);
  FaceField<Dim> area = whole_areas(grid);
  for_each_index<Dim>(grid.faces(0), [&](const Index<Dim>& i) {
    if (i[0] == 2) area[0][i] = 0;
  });
  Field<Dim> smoke(grid.cells);
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) { smoke[i] = i[0] < 2 ? 1 : 0; });
  const Field<Dim> before = smoke;
  Diffusion<Dim>().diffuse_smoke(smoke, area, grid, ground, 1, 1);
  for (std::size_t c = 0; c < smoke.size(); ++c) CHECK(smoke[c] == Approx(before[c]).margin(1e-14));
}

TEMPLATE_TEST_CASE_SIG("viscosity keeps momentum and a uniform stream, and damps a shear wave", "[diffusion]",
                       ((int Dim), Dim), 2, 3) {
  const int n = 32;
  const MacGrid<Dim> grid = box_grid<Dim>(Dim == 2 ? n : 16);
  const Ground<Dim> ground(grid, 1.2);
  const FaceField<Dim> area = whole_areas(grid);
  Field<Dim> smoke(grid.cells);
  for (std::size_t c = 0; c < smoke.size(); ++c) smoke[c] = 1e-5 * static_cast<double>(c % 7);
  const auto momentum = [&](const FaceField<Dim>& u) {
    double p = 0;
    for_each_index<Dim>(grid.faces(0), [&](const Index<Dim>& i) {
      p += (ground.air_mass()[0][i] + smoke_of_face<Dim>(smoke, 0, i)) * u[0][i];
    });
    return p;
  };
  Diffusion<Dim> diffusion;
  FaceField<Dim> uniform = make_face_field<Dim>(grid, 3.0);
  diffusion.diffuse_velocity(uniform, smoke, area, grid, ground, {}, 10, 1);
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < uniform[axis].size(); ++f) REQUIRE(uniform[axis][f] == Approx(3).epsilon(1e-12));

  constexpr double k = 3.14159265358979323846;
  FaceField<Dim> wave = face_velocity<Dim>(
      grid, [](const Vec<Dim>& x) { return Vec<Dim>((2 + std::cos(k * x[Dim - 1])) * Vec<Dim>::Unit(0)); });
  const double before = momentum(wave), top = wave[0][std::size_t{0}] - 2;
  const double viscosity = 1e-2;
  for (int step = 0; step < 100; ++step)
    diffusion.diffuse_velocity(wave, Field<Dim>(grid.cells), area, grid, ground, {}, viscosity, 0.05);
  CHECK(wave[0][std::size_t{0}] - 2 == Approx(top * std::exp(-viscosity * k * k * 5)).epsilon(0.01));
  FaceField<Dim> again = face_velocity<Dim>(
      grid, [](const Vec<Dim>& x) { return Vec<Dim>((2 + std::cos(k * x[Dim - 1])) * Vec<Dim>::Unit(0)); });
  diffusion.diffuse_velocity(again, smoke, area, grid, ground, {}, viscosity, 100);
  CHECK(momentum(again) == Approx(before).epsilon(1e-12));
}

/// u_0 = sin(pi x_0) cos(pi x_up) between closed sides decays by exp(-2 nu pi^2 t): the shear passes to the sides that
/// stop it, and lines whose momentum is zero have no say.
TEMPLATE_TEST_CASE_SIG("viscosity damps a vortex between slippery walls at its rate", "[diffusion]", ((int Dim), Dim),
                       2, 3) {
  constexpr double pi = 3.14159265358979323846, viscosity = 1e-2, dt = 1e-2;
  constexpr int n_steps = 50;
  const auto error = [&](int n) {
    const MacGrid<Dim> grid = box_grid<Dim>(n);
    const Ground<Dim> ground(grid, 1.2);
    FaceField<Dim> area = whole_areas(grid);
    for_each_index<Dim>(grid.faces(0), [&](const Index<Dim>& i) {
      if (i[0] == 0 || i[0] == n) area[0][i] = 0;
    });
    FaceField<Dim> u = face_velocity<Dim>(grid, [&](const Vec<Dim>& x) {
      return Vec<Dim>(std::sin(pi * x[0]) * std::cos(pi * x[Dim - 1]) * Vec<Dim>::Unit(0));
    });
    const FaceField<Dim> start = u;
    Diffusion<Dim> diffusion;
    for (int step = 0; step < n_steps; ++step)
      diffusion.diffuse_velocity(u, Field<Dim>(grid.cells), area, grid, ground, {}, viscosity, dt);
    const double share = std::pow(1 + viscosity * pi * pi * dt, -2 * n_steps);
    double largest = 0;
    for (std::size_t f = 0; f < u[0].size(); ++f) largest = std::max(largest, std::abs(u[0][f] - share * start[0][f]));
    return largest;
  };
  CHECK(error(16) < 5e-4);
  CHECK(error(32) < error(16) / 3.5);
}

TEST_CASE("diffusion that has not been used holds nothing", "[diffusion]") {
  CHECK(Diffusion<2>().bytes() == 0);
}
