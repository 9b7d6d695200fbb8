#include <catch2/catch.hpp>

#include "grid/pressure_case.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

/// '.' open, '#' solid, 'o' core; the first line is the top row. In 3D one layer between closed sides.
template <int Dim>
PressureCase<Dim> drawn(const std::vector<std::string>& rows, Side side) {
  Index<Dim> cells;
  cells.fill(1);
  cells[0] = static_cast<int>(rows[0].size());
  cells[Dim - 1] = static_cast<int>(rows.size());
  Sides<Dim> sides = all_sides<Dim>(side);
  if (Dim == 3) sides[1] = {Side::closed, Side::closed};
  PressureCase<Dim> c(cells, 1.0, sides);
  for_each_index<Dim>(cells, [&](const Index<Dim>& i) {
    const char drawing = rows[rows.size() - 1 - static_cast<std::size_t>(i[Dim - 1])][static_cast<std::size_t>(i[0])];
    c.kind[i] = drawing == '.' ? CellKind::open : drawing == 'o' ? CellKind::core : CellKind::solid;
  });
  return c;
}

template <int Dim>
std::vector<std::string> marked(PressureCase<Dim>& c) {
  Components<Dim> scratch;
  const std::size_t n = mark_pockets<Dim>(c.kind, c.open, c.sides, scratch);
  std::vector<std::string> rows(static_cast<std::size_t>(c.grid.cells[Dim - 1]));
  std::size_t n_seen = 0;
  for_each_index<Dim>(c.grid.cells, [&](const Index<Dim>& i) {
    const char letters[] = {'.', '#', 'o', 'p'};
    rows[rows.size() - 1 - static_cast<std::size_t>(i[Dim - 1])] += letters[static_cast<int>(c.kind[i])];
    n_seen += c.kind[i] == CellKind::pocket;
  });
  CHECK(n == n_seen);
  return rows;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("air shut in between core and bed is a pocket", "[components]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c = drawn<Dim>({"........", "..oooo..", ".oo..oo.", "###.####", "########"}, Side::open);
  CHECK(marked<Dim>(c) == std::vector<std::string>{"........", "..oooo..", ".ooppoo.", "###p####", "########"});
}

TEMPLATE_TEST_CASE_SIG("air sealed in by solid alone is projected, not a pocket", "[components]", ((int Dim), Dim), 2,
                       3) {
  const std::vector<std::string> rows{"......", ".####.", ".#..#.", ".####."};
  PressureCase<Dim> c = drawn<Dim>(rows, Side::open);
  CHECK(marked<Dim>(c) == rows);
}

TEMPLATE_TEST_CASE_SIG("in a closed domain the largest component stays", "[components]", ((int Dim), Dim), 2, 3) {
  PressureCase<Dim> c = drawn<Dim>({"....o..", "....o..", "oooo#..", "...o###"}, Side::closed);
  CHECK(marked<Dim>(c) == std::vector<std::string>{"....opp", "....opp", "oooo#pp", "pppo###"});
}

TEST_CASE("components join around corners, in any order of their runs", "[components]") {
  const auto c = drawn<2>({".......", ".#####.", ".#...#.", ".#.#.#.", ".#.#.#.", "...#..."}, Side::closed);
  Components<2> components;
  components.find(c.kind, c.open, c.sides);
  REQUIRE(components.all().size() == 1);
  CHECK(components.all()[0].n_cells == 28);
  CHECK_FALSE(components.all()[0].reaches_open_side);
}

TEMPLATE_TEST_CASE_SIG("closed faces part components and shut sides", "[components]", ((int Dim), Dim), 2, 3) {
  const int axis = GENERATE(range(0, Dim));
  Index<Dim> cells;
  cells.fill(4);
  PressureCase<Dim> c(cells, 1.0, all_sides<Dim>(Side::closed));
  c.sides[axis][1] = Side::open;
  for_each_index<Dim>(c.grid.faces(axis), [&](const Index<Dim>& face) {
    if (face[axis] == 2) c.open[axis][face] = 0;
  });
  Components<Dim> components;
  components.find(c.kind, c.open, c.sides);
  REQUIRE(components.all().size() == 2);
  CHECK_FALSE(components.all()[0].reaches_open_side);
  CHECK(components.all()[1].reaches_open_side);
  for_each_index<Dim>(c.grid.faces(axis), [&](const Index<Dim>& face) {
    if (face[axis] == 4) c.open[axis][face] = 0;
  });
  components.find(c.kind, c.open, c.sides);
  CHECK_FALSE(components.all()[1].reaches_open_side);
}
