/// The projection against a manufactured solution and against a direct solver.

#include <Eigen/SparseCholesky>
#include <catch2/catch.hpp>
#include <numbers>

#include "grid/pressure_case.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

/// Largest error of the pressure whose exact solution is the product of cos(pi x_k) in the closed unit box.
template <int Dim>
double manufactured_error(int n) {
  Index<Dim> cells;
  cells.fill(n);
  PressureCase<Dim> c(cells, 1.0 / n, all_sides<Dim>(Side::closed));
  c.density = Field<Dim>(cells, 1.3);
  const double pi = std::numbers::pi;
  c.set_velocity([&](int axis, const Vec<Dim>& x) {
    double gradient = 1;
    for (int k = 0; k < Dim; ++k) gradient *= k == axis ? -pi * std::sin(pi * x[k]) : std::cos(pi * x[k]);
    return c.dt / 1.3 * gradient;
  });
  PressureProjection<Dim> projection(c.grid, c.sides);
  const double speed = c.largest_speed();
  const ProjectionOptions options{1e-8, 100};
  const ProjectionResult result = c.project(projection, options);
  CHECK(result.converged);
  CHECK(c.largest_outflow() <= 10 * options.tolerance * speed);
  double error = 0;
  for_each_index<Dim>(cells, [&](const Index<Dim>& i) {
    double exact = 1;
    for (int k = 0; k < Dim; ++k) exact *= std::cos(pi * c.grid.cell_centre(i)[k]);
    error = std::max(error, std::abs(projection.pressure(i) - exact));
  });
  return error;
}

/// The velocity after a projection by a sparse direct solver, written without a look at the code under test.
template <int Dim>
FaceField<Dim> projected_directly(const PressureCase<Dim>& c) {
  const auto n = static_cast<Eigen::Index>(c.kind.size());
  const auto number = [&](const Index<Dim>& i) { return static_cast<Eigen::Index>(flat<Dim>(i, c.grid.cells)); };
  const auto is_cell = [&](const Index<Dim>& i) { return inside<Dim>(i, c.grid.cells); };
  const auto one_over_rho = [&](int axis, const Index<Dim>& face) {
    const Index<Dim> lower = shifted<Dim>(face, axis, -1);
    if (!is_cell(lower)) return 2 / c.density[face];
    if (!is_cell(face)) return 2 / c.density[lower];
    return 2 / (c.density[lower] + c.density[face]);
  };
  std::vector<Eigen::Triplet<double>> entries;
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    if (!c.is_free(axis, face)) return;
    const double conductance = c.open[axis][face] * one_over_rho(axis, face);
    const Index<Dim> lower = shifted<Dim>(face, axis, -1);
    for (const Index<Dim>& cell : {lower, face}) {
      if (is_cell(cell)) entries.emplace_back(number(cell), number(cell), conductance);
    }
    if (is_cell(lower) && is_cell(face)) {
      entries.emplace_back(number(lower), number(face), -conductance);
      entries.emplace_back(number(face), number(lower), -conductance);
    }
  });
  Eigen::VectorXd b = Eigen::VectorXd::Zero(n);
  for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
    if (c.kind[i] == CellKind::open) b[number(i)] = -c.outflow(i);
  });

  // Components by repeated spreading of the smallest number; those without an open side lose their mean and get a pin.
  std::vector<Eigen::Index> label(static_cast<std::size_t>(n));
  for (std::size_t k = 0; k < label.size(); ++k) label[k] = static_cast<Eigen::Index>(k);
  std::vector<bool> anchored(label.size(), false);
  for (bool changed = true; changed;) {
    changed = false;
    c.for_each_face([&](int axis, const Index<Dim>& face) {
      if (!c.is_free(axis, face)) return;
      const Index<Dim> lower = shifted<Dim>(face, axis, -1);
      if (!is_cell(lower) || !is_cell(face)) return;
      auto &p = label[static_cast<std::size_t>(number(lower))], &q = label[static_cast<std::size_t>(number(face))];
      changed = changed || p != q;
      p = q = std::min(p, q);
    });
  }
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    if (!c.is_free(axis, face)) return;
    const Index<Dim> lower = shifted<Dim>(face, axis, -1);
    if (!is_cell(lower)) anchored[static_cast<std::size_t>(label[static_cast<std::size_t>(number(face))])] = true;
    if (!is_cell(face)) anchored[static_cast<std::size_t>(label[static_cast<std::size_t>(number(lower))])] = true;
  });
  std::vector<double> sum(label.size(), 0.0), members(label.size(), 0.0);
  for (std::size_t k = 0; k < label.size(); ++k) {
    sum[static_cast<std::size_t>(label[k])] += b[static_cast<Eigen::Index>(k)];
    members[static_cast<std::size_t>(label[k])] += 1;
  }
  for (std::size_t k = 0; k < label.size(); ++k) {
    const auto l = static_cast<std::size_t>(label[k]);
    if (anchored[l]) continue;
    b[static_cast<Eigen::Index>(k)] -= sum[l] / members[l];
    if (k == l) entries.emplace_back(label[k], label[k], 1.0);
  }
  Eigen::SparseMatrix<double> matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> direct(matrix);
  REQUIRE(direct.info() == Eigen::Success);
  const Eigen::VectorXd phi = direct.solve(b);

  FaceField<Dim> u = c.u;
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    if (!c.is_free(axis, face)) return;
    const Index<Dim> lower = shifted<Dim>(face, axis, -1);
    const double above = is_cell(face) ? phi[number(face)] : 0, below = is_cell(lower) ? phi[number(lower)] : 0;
    u[axis][face] -= one_over_rho(axis, face) * (above - below);
  });
  return u;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the pressure converges to the manufactured solution with order two", "[projection]",
                       ((int Dim), Dim), 2, 3) {
  const int coarsest = Dim == 2 ? 16 : 8;
  double before = manufactured_error<Dim>(coarsest);
  for (int n = 2 * coarsest; n <= 4 * coarsest; n *= 2) {
    const double error = manufactured_error<Dim>(n);
    CHECK(std::log2(before / error) == Approx(2).margin(0.07));
    before = error;
  }
}

TEMPLATE_TEST_CASE_SIG("the projection agrees with a direct solver on random cases", "[projection]", ((int Dim), Dim),
                       2, 3) {
  const auto seed = GENERATE(range(std::uint64_t{1}, std::uint64_t{9}));
  Sides<Dim> sides = all_sides<Dim>(seed % 4 == 0 ? Side::closed : Side::open);
  if (seed % 2 == 1) sides[seed % Dim][0] = Side::closed;
  Index<Dim> cells;
  for (int k = 0; k < Dim; ++k) cells[k] = (Dim == 2 ? 17 : 7) + static_cast<int>(seed * (k + 3) % 6);
  PressureCase<Dim> c = random_case<Dim>(cells, sides, seed);
  const FaceField<Dim> expected = projected_directly<Dim>(c);
  PressureProjection<Dim> projection(c.grid, c.sides);
  const ProjectionResult result = c.project(projection, {1e-13, 400});
  INFO(result.iterations << " iterations, residual " << result.residual);
  CHECK(result.converged);
  double scale = 0, difference = 0;
  c.for_each_face([&](int axis, const Index<Dim>& face) {
    scale = std::max(scale, std::abs(expected[axis][face]));
    difference = std::max(difference, std::abs(expected[axis][face] - c.u[axis][face]));
  });
  CHECK(difference <= 1e-8 * scale);
}
