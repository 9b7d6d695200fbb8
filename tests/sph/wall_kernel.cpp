#include "sph/wall_kernel.hpp"

#include <catch2/catch.hpp>

#include "sph/kernels.hpp"

using namespace spindrift;

namespace {

/// Sums of f(x) over a fine lattice of the half space (or the corner's outside) given by `inside`.
template <int Dim, class F, class Inside>
double lattice_integral(double h, int n, F&& f, Inside&& inside) {
  Index<Dim> shape;
  shape.fill(n);
  const double step = 2 * h / n;
  double sum = 0;
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = (i[k] + 0.5) * step - h;
    if (inside(x)) sum += f(x) * std::pow(step, Dim);
  });
  return sum;
}

template <int Dim>
Walls<Dim> closed_box(double size) {
  Walls<Dim> walls;
  walls.domain.upper = Vec<Dim>::Constant(size);
  for (auto& axis : walls.sides) axis = {Side::closed, Side::closed};
  return walls;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("wall integrals match sums over a fine lattice", "[wall_kernel]", ((int Dim), Dim), 2, 3) {
  const double h = 0.4;
  const int n = Dim == 2 ? 800 : 160;  // distances fall between the lattice's planes
  const WallKernel<Dim> wall(h);
  const CubicSpline<Dim> kernel(h);
  const double s = GENERATE(-0.35, -0.1, 0.0, 0.05, 0.2, 0.3, 0.39);
  const auto behind = [&](const Vec<Dim>& x) { return x[0] > s; };
  const double fraction = lattice_integral<Dim>(h, n, [&](const Vec<Dim>& x) { return kernel.value(x.norm()); }, behind);
  const double slope =
      lattice_integral<Dim>(h, n, [&](const Vec<Dim>& x) { return kernel.gradient(x)[0]; }, behind);
  CHECK(wall.fraction(s) == Approx(fraction).margin(2e-3));
  CHECK(wall.slope(s) * h == Approx(slope * h).margin(5e-3));
  const auto number = [&](const Vec<Dim>& x) { return number_density_kernel(x.norm(), h); };
  const double all = lattice_integral<Dim>(h, n, number, [](const Vec<Dim>&) { return true; });
  CHECK(wall.number_density_fraction(s) ==
        Approx(lattice_integral<Dim>(h, n, number, behind) / all).margin(3e-3));
  CHECK(wall.number_density_integral() == Approx(all).epsilon(3e-3));
}

TEMPLATE_TEST_CASE_SIG("wall integrals end where they must", "[wall_kernel]", ((int Dim), Dim), 2, 3) {
  const WallKernel<Dim> wall(0.2);
  CHECK(wall.fraction(0) == Approx(0.5).margin(1e-6));
  CHECK(wall.fraction(0.2) == 0);
  CHECK(wall.fraction(5) == 0);
  CHECK(wall.fraction(-0.2) == Approx(1));
  CHECK(wall.fraction(-7) == Approx(1));
  CHECK(wall.slope(0.2) == Approx(0).margin(1e-9));
  CHECK(wall.slope(-0.2) == Approx(0).margin(1e-9));
  const double s = GENERATE(-0.15, -0.02, 0.03, 0.11, 0.19), e = 1e-3;
  CHECK(wall.slope(s) == Approx((wall.fraction(s + e) - wall.fraction(s - e)) / (2 * e)).margin(1e-3 / 0.2));
}

TEMPLATE_TEST_CASE_SIG("a lattice above a wall is full", "[wall_kernel]", ((int Dim), Dim), 2, 3) {
  const double d = 0.1, h = 2 * d;
  const WallKernel<Dim> wall(h);
  const CubicSpline<Dim> kernel(h);
  Index<Dim> shape;
  shape.fill(5);
  double sum = wall.fraction(0.5 * d);
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = (i[k] - 2) * d;
    if (x[Dim - 1] > -0.5 * d) sum += kernel.value(x.norm()) * std::pow(d, Dim);
  });
  CHECK(sum == Approx(1).margin(0.02));
}

TEMPLATE_TEST_CASE_SIG("at a corner the free fractions multiply", "[wall_kernel]", ((int Dim), Dim), 2, 3) {
  const double d = 0.1, h = 2 * d;
  const WallKernel<Dim> wall(h);
  const CubicSpline<Dim> kernel(h);
  const Walls<Dim> walls = closed_box<Dim>(1.0);
  const Vec<Dim> x = Vec<Dim>::Constant(0.5 * d);
  const WallShare<Dim> share = wall.share(walls, x);
  const double exact = lattice_integral<Dim>(
      h, Dim == 2 ? 400 : 100, [&](const Vec<Dim>& y) { return kernel.value(y.norm()); },
      [&](const Vec<Dim>& y) { return (x + y).minCoeff() < 0; });
  CHECK(share.fraction == Approx(exact).margin(0.03));
  CHECK(share.fraction == Approx(1 - std::pow(1 - wall.fraction(0.5 * d), Dim)));
  for (int k = 0; k < Dim; ++k) {
    const double e = 1e-4;
    const Vec<Dim> step = e * Vec<Dim>::Unit(k);
    const double slope = (wall.share(walls, x + step).fraction - wall.share(walls, x - step).fraction) / (2 * e);
    CHECK(share.gradient[k] == Approx(slope).epsilon(1e-2));
    CHECK(share.gradient[k] < 0);
  }
  CHECK(wall.number_density_share(walls, x) ==
        Approx(1 - std::pow(1 - wall.number_density_fraction(0.5 * d), Dim)));
  CHECK(wall.share(walls, Vec<Dim>::Constant(0.5)).fraction == 0);
}

TEST_CASE("the no-slip coefficient is the Laplacian of a mirrored flow", "[wall_kernel]") {
  const double h = 0.4, s = GENERATE(0.05, 0.1, 0.3);
  const WallKernel<2> wall(h);
  const CubicSpline<2> kernel(h);
  Walls<2> walls;
  walls.domain.upper = {10, 10};
  walls.sides[1][0] = Side::closed;
  const double integral = lattice_integral<2>(
      h, 800, [&](const Vec<2>& x) { return -2 * kernel.slope_over_r(x.norm()) * (x[1] / s); },
      [&](const Vec<2>& x) { return x[1] > s; });
  CHECK(wall.no_slip_coefficient(walls, {5, s}) == Approx(integral).epsilon(0.02));
}
