#include <catch2/catch.hpp>
#include <limits>
#include <set>

#include "core/error.hpp"
#include "fluid_fixture.hpp"
#include "sph/cell_list.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

template <int Dim>
Particles<Dim> cloud(int n, double size, unsigned seed) {
  Particles<Dim> p;
  for (int i = 0; i < n; ++i) add_particle<Dim>(p, Vec<Dim>::Zero(), Vec<Dim>::Zero(), 1, 1);
  shake(p, size, 1, seed);
  return p;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("runs hold all particles within a cell size", "[cell_list]", ((int Dim), Dim), 2, 3) {
  const double h = 0.3;
  Particles<Dim> p = cloud<Dim>(700, GENERATE(0.2, 1.0, 400.0), 3);
  CellList<Dim> cells(h);
  cells.build(p);
  std::size_t seen = 0;
  for (std::size_t c = 0; c < cells.n_cells(); ++c) {
    seen += cells.cell(c).end - cells.cell(c).begin;
    for (std::uint32_t i = cells.cell(c).begin; i < cells.cell(c).end; ++i) {
      CHECK(cells.cell_of(i) == c);
      std::multiset<std::uint32_t> found;
      for (const auto& run : cells.runs(c))
        for (std::uint32_t j = run.begin; j < run.end; ++j) found.insert(j);
      CHECK(std::set<std::uint32_t>(found.begin(), found.end()).size() == found.size());
      for (std::uint32_t j = 0; j < p.size(); ++j)
        if ((p.position[i] - p.position[j]).norm() < h) CHECK(found.count(j) == 1);
    }
  }
  CHECK(seen == p.size());
  const Vec<Dim> x = Vec<Dim>::Constant(0.37);
  std::set<std::uint32_t> near;
  cells.for_each_near(x, [&](std::uint32_t j) { CHECK(near.insert(j).second); });
  for (std::uint32_t j = 0; j < p.size(); ++j)
    if ((p.position[j] - x).norm() < h) CHECK(near.count(j) == 1);
}

TEMPLATE_TEST_CASE_SIG("the order depends on the state alone", "[cell_list]", ((int Dim), Dim), 2, 3) {
  Particles<Dim> a = cloud<Dim>(500, 2.0, 11), b;
  for (std::size_t i = a.size(); i-- > 0;) b.push_back_from(a, i);
  const Particles<Dim> before = a;
  CellList<Dim> cells_a(0.4), cells_b(0.4);
  cells_a.build(a);
  cells_b.build(b);
  CHECK(a.id == b.id);
  CHECK(a.position == b.position);
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(before.id[cells_a.order()[i]] == a.id[i]);
  cells_a.build(a);
  CHECK(a.id == b.id);
  for (std::size_t i = 0; i < a.size(); ++i) CHECK(cells_a.order()[i] == i);
}

TEMPLATE_TEST_CASE_SIG("few particles and far particles are legal", "[cell_list]", ((int Dim), Dim), 2, 3) {
  CellList<Dim> cells(0.1);
  Particles<Dim> p;
  cells.build(p);
  CHECK(cells.n_cells() == 0);
  cells.for_each_near(Vec<Dim>::Zero(), [](std::uint32_t) { FAIL("there is nothing"); });
  add_particle<Dim>(p, Vec<Dim>::Constant(-9e4), Vec<Dim>::Zero(), 1, 1);
  add_particle<Dim>(p, Vec<Dim>::Constant(9e4), Vec<Dim>::Zero(), 1, 1);
  cells.build(p);
  CHECK(cells.n_cells() == 2);
  cells.for_each_near(Vec<Dim>::Constant(std::numeric_limits<double>::quiet_NaN()),
                      [](std::uint32_t) { FAIL("no place has no neighbours"); });
}

TEMPLATE_TEST_CASE_SIG("absurd positions are reported with their id", "[cell_list]", ((int Dim), Dim), 2, 3) {
  const double bad =
      GENERATE(std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e30, -1e12);
  Particles<Dim> p = cloud<Dim>(20, 1.0, 5);
  p.id[13] = 4711;
  p.position[13][Dim - 1] = bad;
  CellList<Dim> cells(0.1);
  try {
    cells.build(p);
    FAIL("accepted");
  } catch (const Error& e) {
    CHECK(e.code() == ExitCode::unstable);
    CHECK(std::string(e.what()).find("4711") != std::string::npos);
  }
}
