#include <catch2/catch.hpp>

#include "sph/kernels.hpp"

using namespace spindrift;

// Case A1 of the validation catalogue.
TEMPLATE_TEST_CASE_SIG("the kernel integrates to one and its gradient to zero", "[kernels]",
                       ((int Dim, class Shape), Dim, Shape), (2, CubicSplineShape), (3, CubicSplineShape),
                       (2, WendlandShape), (3, WendlandShape)) {
  const double h = 0.21;
  const Kernel<Dim, Shape> kernel(h);
  const int n = Dim == 2 ? 400 : 120;
  Index<Dim> shape;
  shape.fill(n);
  const double step = 2 * h / n;
  double sum = 0;
  Vec<Dim> gradient = Vec<Dim>::Zero();
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = (i[k] + 0.5) * step - h;
    const double w = kernel.value(x.norm());
    CHECK_FALSE(w < 0);
    sum += w * std::pow(step, Dim);
    gradient += kernel.gradient(x) * std::pow(step, Dim);
  });
  CHECK(sum == Approx(1).margin(1e-5));
  CHECK(gradient.norm() * h < 1e-10);
}

TEMPLATE_TEST_CASE_SIG("the kernel's gradient is the derivative of its value", "[kernels]",
                       ((int Dim, class Shape), Dim, Shape), (2, CubicSplineShape), (3, CubicSplineShape),
                       (2, WendlandShape), (3, WendlandShape)) {
  const double h = 0.5;
  const Kernel<Dim, Shape> kernel(h);
  const double r = GENERATE(0.01, 0.1, 0.2499, 0.2501, 0.4, 0.499, 0.51);
  const double e = 1e-6;
  const double slope = (kernel.value(r + e) - kernel.value(r - e)) / (2 * e);
  CHECK(kernel.gradient(r * Vec<Dim>::Unit(0))[0] == Approx(slope).margin(1e-6 * kernel.sigma / h));
}

TEST_CASE("the kernel at its centre, half-way and at its rim", "[kernels]") {
  const CubicSpline<2> kernel(1.0);
  CHECK(kernel.value(0) == Approx(40 / (7 * M_PI)));
  CHECK(kernel.value(0.5) == Approx(0.25 * kernel.sigma));
  CHECK(kernel.value(1) == 0);
  CHECK(kernel.value(7) == 0);
  CHECK(kernel.slope_over_r(1) == 0);
  CHECK(std::isfinite(kernel.slope_over_r(0)));
}

TEST_CASE("the Wendland kernel at its centre, half-way and at its rim", "[kernels]") {
  const Wendland<2> kernel(1.0);
  CHECK(kernel.value(0) == Approx(7 / M_PI));
  CHECK(kernel.value(0.5) == Approx(3.0 / 16 * kernel.sigma));
  CHECK(kernel.value(1) == 0);
  CHECK(kernel.slope_over_r(7) == 0);
  CHECK(kernel.slope_over_r(0) == Approx(-20 * kernel.sigma));
}

TEST_CASE("with_kernel gives the kernel of that shape", "[kernels]") {
  const auto centre = [](KernelShape shape) {
    double value = 0;
    with_kernel<3>(shape, 2.0, [&](const auto& kernel) { value = kernel.value(0); });
    return value;
  };
  CHECK(centre(KernelShape::cubic_spline) == CubicSpline<3>(2.0).sigma);
  CHECK(centre(KernelShape::wendland) == Wendland<3>(2.0).sigma);
}

TEMPLATE_TEST_CASE_SIG("the volume sum of a full lattice is one", "[kernels]", ((int Dim), Dim), 2, 3) {
  const CubicSpline<Dim> kernel(2.0);
  Index<Dim> shape;
  shape.fill(5);
  double sum = 0;
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = i[k] - 2;
    sum += kernel.value(x.norm());
  });
  CHECK(sum == Approx(1).margin(Dim == 2 ? 1e-3 : 1e-2));
  CHECK(lattice_sum(kernel, 1.0) == Approx(sum));
  if (Dim == 2) {
    CHECK(lattice_sum(CubicSpline<Dim>(2.0), 1.0) == Approx(1.0008).margin(1e-4));
    CHECK(lattice_sum(Wendland<Dim>(2.0), 1.0) == Approx(1.038).margin(5e-4));
    CHECK(lattice_sum(Wendland<Dim>(2.5), 1.0) == Approx(1.014).margin(5e-4));
    CHECK(lattice_sum(Wendland<Dim>(3.0), 1.0) == Approx(1.005).margin(5e-4));
  }
}

TEST_CASE("the number-density kernel has its floor at the spacing", "[kernels]") {
  CHECK(number_density_kernel(0.5, 1, 0.5) == Approx(1));
  CHECK(number_density_kernel(0.75, 1, 0.5) == Approx(1.0 / 3));
  CHECK(number_density_kernel(0, 1, 0.5) == 1);
  CHECK(number_density_kernel(1, 1, 0.5) == 0);
  CHECK(number_density_kernel(0.3, 1, 0.25) == Approx(1 / 0.3 - 1));
  CHECK(number_density_kernel(0.1, 1, 0.25) == Approx(3));
}
