/// The multigrid preconditioner: symmetric, positive, and good enough that few iterations are needed.

#include <catch2/catch.hpp>

#include "grid/multigrid.hpp"
#include "grid/pressure_case.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

template <int Dim>
struct Preconditioner {
  const PressureCase<Dim>& c;
  PoissonOperator<Dim> poisson;
  Multigrid<Dim> multigrid;

  explicit Preconditioner(const PressureCase<Dim>& c_)
      : c(c_), poisson(c.grid.cells, c.sides), multigrid(c.grid.cells) {
    poisson.build(c.density, c.open, c.kind);
    multigrid.build(poisson);
  }
  Field<Dim> random_vector(std::uint64_t seed) const {
    Sequence random{seed};
    Field<Dim> z(c.grid.cells, 0.0);
    for (std::size_t n = 0; n < z.size(); ++n) z[n] = c.kind[n] == CellKind::open ? random() - 0.5 : 0;
    return z;
  }
  Field<Dim> operator()(const Field<Dim>& r) {
    for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
      multigrid.right_side()[static_cast<std::size_t>(poisson.layout.at(i))] = static_cast<float>(r[i]);
    });
    multigrid.cycle();
    Field<Dim> z(c.grid.cells, 0.0);
    for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
      if (c.kind[i] == CellKind::open) {
        z[i] = static_cast<double>(multigrid.solution()[static_cast<std::size_t>(poisson.layout.at(i))]);
      }
    });
    return z;
  }
};

template <int Dim>
double dot(const Field<Dim>& a, const Field<Dim>& b) {
  double sum = 0;
  for (std::size_t n = 0; n < a.size(); ++n) sum += a[n] * b[n];
  return sum;
}

int iterations(double ratio) {
  PressureCase<2> c = slope_case<2>({690, 240}, ratio);
  PressureProjection<2> projection(c.grid, c.sides);
  const ProjectionResult result = c.project(projection);
  CHECK(result.converged);
  return result.iterations;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the multigrid cycle is symmetric and positive", "[multigrid]", ((int Dim), Dim), 2, 3) {
  const auto seed = GENERATE(range(std::uint64_t{1}, std::uint64_t{5}));
  Index<Dim> cells;
  for (int k = 0; k < Dim; ++k) cells[k] = (Dim == 2 ? 37 : 11) + static_cast<int>(seed) * (k + 1);
  PressureCase<Dim> c = random_case<Dim>(cells, all_sides<Dim>(Side::open), seed);
  c.density = Field<Dim>(cells, 1.0);  // else the heavy cells' terms hide the others in the sums
  Preconditioner<Dim> apply(c);
  const Field<Dim> a = apply.random_vector(10 * seed), b = apply.random_vector(10 * seed + 1);
  const Field<Dim> ma = apply(a), mb = apply(b);
  const double size = std::sqrt(dot<Dim>(a, ma) * dot<Dim>(b, mb));
  CHECK(std::abs(dot<Dim>(a, mb) - dot<Dim>(ma, b)) <= 1e-6 * size);
  CHECK(dot<Dim>(a, ma) > 0);
  CHECK(dot<Dim>(b, mb) > 0);
}

TEST_CASE("few iterations on a slope at the paper's size, also with a density ratio of 10^4", "[multigrid]") {
  const int uniform_density = iterations(1);
  CHECK(uniform_density <= 7);
  CHECK(iterations(1e4) <= 2 * uniform_density);
}

TEMPLATE_TEST_CASE_SIG("the number of iterations hardly depends on the size, odd or even", "[multigrid]",
                       ((int Dim), Dim), 2, 3) {
  const int n = GENERATE(16, 17, 19, 23, 31, 32, 33, 47);
  const Side side = GENERATE(Side::open, Side::closed);
  Index<Dim> cells;
  cells.fill(n);
  PressureCase<Dim> c(cells, 1.0, all_sides<Dim>(side));
  Sequence random{3};
  c.set_velocity([&](int, const Vec<Dim>&) { return random() - 0.5; });
  PressureProjection<Dim> projection(c.grid, c.sides);
  const ProjectionResult result = c.project(projection, {1e-8, 100});
  INFO(n << " cells, residual " << result.residual);
  CHECK(result.converged);
  CHECK(result.iterations <= 11);
}
