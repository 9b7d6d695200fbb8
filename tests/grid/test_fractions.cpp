#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "grid/ground.hpp"
#include "grid/open_fractions.hpp"

using namespace spindrift;

namespace {

template <int Dim>
MacGrid<Dim> unit_grid(int n, double dx = 1) {
  MacGrid<Dim> grid;
  grid.dx = dx;
  grid.cells.fill(n);
  return grid;
}

/// Signed distances at the nodes to a plane through `point` with the air on the side of `normal`.
template <int Dim>
Field<Dim> plane(const MacGrid<Dim>& grid, const Vec<Dim>& point, const Vec<Dim>& normal) {
  Field<Dim> distance(grid.nodes());
  for_each_index<Dim>(grid.nodes(),
                      [&](const Index<Dim>& i) { distance[i] = normal.normalized().dot(grid.node(i) - point); });
  return distance;
}

}  // namespace

TEST_CASE("fractions of a segment, square and cube by hand", "[fractions]") {
  CHECK(open_fraction<1>({1, -1}) == Approx(0.5));
  CHECK(open_fraction<1>({-1, 3}) == Approx(0.75));
  CHECK(open_fraction<1>({0, 1}) == Approx(1));
  CHECK(open_fraction<1>({0, -1}) == 0);
  CHECK(open_fraction<2>({1, -1, -1, -3}) == Approx(0.125));  // corner triangle with legs of a half
  CHECK(open_fraction<2>({-1, 1, 1, 3}) == Approx(0.875));
  CHECK(open_fraction<2>({-1, -1, 3, 3}) == Approx(0.75));
  CHECK(open_fraction<3>({1, -1, -1, -3, -1, -3, -3, -5}) == Approx(1.0 / 48));
  CHECK(open_fraction<3>({-1, 1, -1, 1, -1, 1, -1, 1}) == Approx(0.5));
  CHECK(open_fraction<3>({-3, -1, -1, 1, -1, 1, 1, 3}) == Approx(0.5));
}

TEST_CASE("fractions are within 0..1, and what is open and what is closed fill the box", "[fractions]") {
  const double tiny = GENERATE(1e-300, 1e-16, 1.0, 1e16, 1e300);
  const double other = GENERATE(-1e300, -1e-300, -1.0, 0.0, 1e-300, 1e300);
  const std::array<double, 8> d{tiny, other, -tiny, other, tiny, -other, other, tiny};
  std::array<double, 8> opposite;
  for (std::size_t k = 0; k < 8; ++k) opposite[k] = -d[k];
  const double open = open_fraction<3>(d), closed = open_fraction<3>(opposite);
  CHECK((open >= 0 && open <= 1));
  if (other != 0) CHECK(open + closed == Approx(1).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("an inclined plane leaves its exact volume and its faces balance", "[fractions]",
                       ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = unit_grid<Dim>(8);
  Vec<Dim> normal = Vec<Dim>::Constant(0.3);
  normal[up_axis<Dim>] = 1;
  Ground<Dim> ground(grid, 1.2);
  ground.set(plane<Dim>(grid, Vec<Dim>::Constant(4), normal), std::array{Span{0, 8}});
  double volume = 0;
  for (std::size_t c = 0; c < ground.volume().size(); ++c) volume += ground.volume()[c];
  CHECK(volume == Approx(0.5 * std::pow(8, Dim)).epsilon(0.02));  // by symmetry, but for the floor
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& i) {
    // The missing area is the ground's, normal to the plane.
    Vec<Dim> missing;
    for (int k = 0; k < Dim; ++k) missing[k] = ground.open()[k][shifted<Dim>(i, k, 1)] - ground.open()[k][i];
    for (int k = 0; k + 1 < Dim; ++k)
      CHECK(missing[k] == Approx(0.3 * missing[Dim - 1]).margin(2 * Ground<Dim>::smallest_opening));
  });
}

TEMPLATE_TEST_CASE_SIG("closed cells hold no air, small cells are listed and floored", "[fractions]", ((int Dim), Dim),
                       2, 3) {
  const MacGrid<Dim> grid = unit_grid<Dim>(4);
  Ground<Dim> ground(grid, 2);
  ground.set(plane<Dim>(grid, 1.95 * up<Dim>(), up<Dim>()), std::array{Span{0, 4}});
  std::size_t layer = count<Dim>(grid.cells) / 4;
  CHECK(ground.small_cells().size() == layer);
  CHECK(ground.volume()[std::size_t{0}] == 0);
  CHECK(ground.volume()[layer] == Approx(Ground<Dim>::smallest_volume));
  CHECK(ground.volume()[2 * layer] == 1);
  CHECK(ground.air_mass()[0][std::size_t{0}] == 0);
  CHECK(ground.air_mass()[up_axis<Dim>][2 * layer] == Approx(2 * 0.5 * (1 + Ground<Dim>::smallest_volume)));
}

TEMPLATE_TEST_CASE_SIG("a partial update gives the bits of a full one", "[fractions]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = unit_grid<Dim>(12, 0.3);
  const auto wavy = [&](double dent) {
    Field<Dim> d(grid.nodes());
    for_each_index<Dim>(grid.nodes(), [&](const Index<Dim>& i) {
      d[i] = 0.3 * i[Dim - 1] - 1.4 - 0.5 * std::sin(0.7 * i[0]) + (i[0] >= 5 && i[0] <= 7 ? dent : 0);
    });
    return d;
  };
  Ground<Dim> part(grid, 1.2), full(grid, 1.2);
  part.set(wavy(0), std::array{Span{0, 12}});
  part.set(wavy(0.35), std::array{Span{4, 8}});
  full.set(wavy(0.35), std::array{Span{0, 12}});
  for (int axis = 0; axis < Dim; ++axis) {
    for (std::size_t f = 0; f < full.open()[axis].size(); ++f) {
      REQUIRE(part.open()[axis][f] == full.open()[axis][f]);
      REQUIRE(part.air_mass()[axis][f] == full.air_mass()[axis][f]);
    }
    for (std::size_t r = 0; r < full.rows(axis).size(); ++r) {
      REQUIRE(part.rows(axis)[r].begin == full.rows(axis)[r].begin);
      REQUIRE(part.rows(axis)[r].end == full.rows(axis)[r].end);
    }
  }
  CHECK(part.small_cells() == full.small_cells());
  FaceField<Dim> a = make_face_field<Dim>(grid), b;
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < a[axis].size(); ++f) a[axis][f] = std::sin(static_cast<double>(f));
  b = a;
  part.extrapolate(a);
  full.extrapolate(b);
  for (int axis = 0; axis < Dim; ++axis)
    for (std::size_t f = 0; f < a[axis].size(); ++f) REQUIRE(a[axis][f] == b[axis][f]);
}

TEMPLATE_TEST_CASE_SIG("velocity goes on into the ground, and is 0 deep in it", "[fractions]", ((int Dim), Dim), 2, 3) {
  const MacGrid<Dim> grid = unit_grid<Dim>(8);
  Ground<Dim> ground(grid, 1.2);
  ground.set(plane<Dim>(grid, 5.5 * up<Dim>(), up<Dim>()), std::array{Span{0, 8}});
  FaceField<Dim> u = make_face_field<Dim>(grid, 7.0);
  for_each_index<Dim>(grid.faces(0), [&](const Index<Dim>& i) { u[0][i] = i[Dim - 1] >= 5 ? 3 : 99; });
  ground.extrapolate(u);
  ground.clear_deep(u, 0, 8);
  for_each_index<Dim>(grid.faces(0), [&](const Index<Dim>& i) { CHECK(u[0][i] == (i[Dim - 1] >= 2 ? 3 : 0)); });
}

TEMPLATE_TEST_CASE_SIG("a distance that is not finite is refused and changes nothing", "[fractions]", ((int Dim), Dim),
                       2, 3) {
  const MacGrid<Dim> grid = unit_grid<Dim>(4);
  Field<Dim> distance(grid.nodes(), -1);
  distance[std::size_t{7}] = GENERATE(std::numeric_limits<double>::quiet_NaN(), HUGE_VAL, -HUGE_VAL);
  Ground<Dim> ground(grid, 1.2);
  CHECK_THROWS_AS(ground.set(distance, std::array{Span{0, 4}}), Error);
  CHECK(ground.volume()[std::size_t{0}] == 1);
}
