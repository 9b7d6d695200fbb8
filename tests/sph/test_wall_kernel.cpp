#include <catch2/catch.hpp>
#include <type_traits>

#include "sph/wall_kernel.hpp"

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

template <class Shape>
constexpr KernelShape shape_of =
    std::is_same_v<Shape, WendlandShape> ? KernelShape::wendland : KernelShape::cubic_spline;

}  // namespace

TEMPLATE_TEST_CASE_SIG("wall integrals match sums over a fine lattice", "[wall_kernel]",
                       ((int Dim, class Shape), Dim, Shape), (2, CubicSplineShape), (3, CubicSplineShape),
                       (2, WendlandShape), (3, WendlandShape)) {
  const double h = 0.4;
  const int n = Dim == 2 ? 800 : 160;  // distances fall between the lattice's planes
  const double d = GENERATE(0.2, 0.15);
  const WallKernel<Dim> wall(h, d, shape_of<Shape>);
  const Kernel<Dim, Shape> kernel(h);
  const double s = GENERATE(-0.35, -0.1, 0.0, 0.05, 0.2, 0.3, 0.39);
  const auto behind = [&](const Vec<Dim>& x) { return x[0] > s; };
  const double fraction = lattice_integral<Dim>(
      h, n, [&](const Vec<Dim>& x) { return kernel.value(x.norm()); }, behind);
  const double slope = lattice_integral<Dim>(
      h, n, [&](const Vec<Dim>& x) { return kernel.gradient(x)[0]; }, behind);
  CHECK(wall.fraction(s) == Approx(fraction).margin(2e-3));
  CHECK(wall.slope(s) * h == Approx(slope * h).margin(5e-3));
  const auto number = [&](const Vec<Dim>& x) { return number_density_kernel(x.norm(), h, d); };
  const double all = lattice_integral<Dim>(h, n, number, [](const Vec<Dim>&) { return true; });
  CHECK(wall.number_density_fraction(s) == Approx(lattice_integral<Dim>(h, n, number, behind) / all).margin(3e-3));
  CHECK(wall.number_density_integral() == Approx(all).epsilon(3e-3));
}

TEMPLATE_TEST_CASE_SIG("wall integrals end where they must", "[wall_kernel]", ((int Dim), Dim), 2, 3) {
  const WallKernel<Dim> wall(0.2, 0.1);
  CHECK(wall.fraction(0) == Approx(0.5).margin(2e-5));
  CHECK(wall.fraction(0.2) == 0);
  CHECK(wall.fraction(5) == 0);
  CHECK(wall.fraction(-0.2) == Approx(1));
  CHECK(wall.fraction(-7) == Approx(1));
  CHECK(wall.slope(0.2) == Approx(0).margin(1e-9));
  CHECK(wall.slope(-0.2) == Approx(0).margin(1e-9));
  const double s = GENERATE(-0.15, -0.02, 0.03, 0.11, 0.19), e = 1e-3;
  CHECK(wall.slope(s) == Approx((wall.fraction(s + e) - wall.fraction(s - e)) / (2 * e)).margin(1e-3 / 0.2));
}

TEMPLATE_TEST_CASE_SIG("a lattice d/2 above a wall is full and in equilibrium", "[wall_kernel]",
                       ((int Dim, class Shape), Dim, Shape), (2, CubicSplineShape), (3, CubicSplineShape),
                       (2, WendlandShape), (3, WendlandShape)) {
  const double ratio = GENERATE(1.6, 2.0, 2.5, 3.0), d = 0.1, h = ratio * d;
  CAPTURE(ratio);
  const WallKernel<Dim> wall(h, d, shape_of<Shape>);
  const Kernel<Dim, Shape> kernel(h);
  Walls<Dim> walls;
  walls.domain = {Vec<Dim>::Constant(-10), Vec<Dim>::Constant(10)};
  walls.domain.lower[Dim - 1] = 0;
  walls.sides[Dim - 1][0] = Side::closed;
  const WallShare<Dim> share = wall.share(walls, 0.5 * d * Vec<Dim>::Unit(Dim - 1), nowhere<Dim>);
  Index<Dim> shape;
  shape.fill(7);
  double sum = share.fraction, lattice = 0, shear = 0;
  Vec<Dim> gradient = 2 * share.gradient;
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    Vec<Dim> x;  // of the particle, seen from its neighbour
    for (int k = 0; k < Dim; ++k) x[k] = (3 - i[k]) * d;
    const double volume = std::pow(d, Dim);
    lattice += volume * kernel.value(x.norm());
    if (x[Dim - 1] > 0.5 * d) return;
    sum += volume * kernel.value(x.norm());
    gradient += 2 * volume * kernel.gradient(x);
    shear += -2 * volume * kernel.slope_over_r(x.norm()) * x[Dim - 1];
  });
  CHECK(sum == Approx(lattice).margin(1e-5));
  CHECK(gradient.norm() * h < 1e-3);
  // u = z over a no-slip wall at z = 0 is force-free
  shear += wall.no_slip_coefficient(walls, 0.5 * d * Vec<Dim>::Unit(Dim - 1), nowhere<Dim>) * 0.5 * d;
  CHECK(shear * d < 2e-3);
  CHECK(shear * d > -2e-3);
}

TEMPLATE_TEST_CASE_SIG("at a corner the free fractions multiply", "[wall_kernel]", ((int Dim), Dim), 2, 3) {
  const double d = 0.1, h = 2 * d;
  const WallKernel<Dim> wall(h, d);
  const Walls<Dim> walls = closed_box<Dim>(1.0);
  Walls<Dim> floor = walls;
  for (int k = 0; k + 1 < Dim; ++k) floor.sides[k] = {Side::open, Side::open};
  const double s = GENERATE(0.3, 0.5, 0.8) * 0.1;
  const Vec<Dim> x = Vec<Dim>::Constant(s);
  const WallShare<Dim> share = wall.share(walls, x, nowhere<Dim>);
  CHECK(share.fraction == Approx(1 - std::pow(1 - wall.share(floor, x, nowhere<Dim>).fraction, Dim)));
  for (int k = 0; k < Dim; ++k) {
    const double e = 1e-4;
    const Vec<Dim> step = e * Vec<Dim>::Unit(k);
    const double slope =
        (wall.share(walls, x + step, nowhere<Dim>).fraction - wall.share(walls, x - step, nowhere<Dim>).fraction) /
        (2 * e);
    CHECK(2 * share.gradient[k] == Approx(slope).epsilon(1e-2));
    CHECK(share.gradient[k] < 0);
  }
  CHECK(wall.number_density_share(walls, x, nowhere<Dim>) ==
        Approx(1 - std::pow(1 - wall.number_density_fraction(s), Dim)));
  CHECK(wall.share(walls, Vec<Dim>::Constant(0.5), nowhere<Dim>).fraction == 0);
  CHECK(wall.no_slip_coefficient(walls, Vec<Dim>::Constant(0.5), nowhere<Dim>) == 0);
  CHECK(std::isfinite(wall.no_slip_coefficient(walls, Vec<Dim>::Zero(), nowhere<Dim>)));
}

TEMPLATE_TEST_CASE_SIG("snow is full where its lattice is, and at 1 with the cubic spline over two spacings",
                       "[wall_kernel]", ((int Dim), Dim), 2, 3) {
  const double d = 0.105;
  CHECK(WallKernel<Dim>(2 * d, d).full() == 1);
  const double ratio = GENERATE(1.6, 2.0, 3.0), h = ratio * d, unit = lattice_sum(CubicSpline<Dim>(2 * d), d);
  CHECK(WallKernel<Dim>(h, d).full() == Approx(lattice_sum(CubicSpline<Dim>(h), d) / unit));
  CHECK(WallKernel<Dim>(h, d, KernelShape::wendland).full() == Approx(lattice_sum(Wendland<Dim>(h), d) / unit));
}
