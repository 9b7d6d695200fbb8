#include <catch2/catch.hpp>

#include "box.hpp"
#include "coupling/ground_surface.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

constexpr double d = 0.1, cover_height = 0.3;

/// A plane, and on `n_bins` bins of it stacks of three particles: a flat cover 3 d thick.
template <int Dim>
struct Bed {
  Walls<Dim> walls;
  MacGrid<Dim> grid;
  Cover<Dim> cover;

  explicit Bed(double angle, int n_bins = 20) {
    walls.terrain.emplace(std::vector<Vec<2>>{{0, 3}, {4, 3 - 4 * std::tan(angle)}});
    grid.dx = 0.17;
    grid.cells.fill(24);
    if constexpr (Dim == 3) grid.cells[1] = 9;
    cover.spacing = d;
    cover.density = 100;
    cover.thickness = cover_height;
    const int across = Dim == 2 ? 1 : 9;
    for (int s = 0; s < n_bins; ++s)
      for (int y = 0; y < across; ++y)
        for (int k = 0; k < 3; ++k) {
          Vec<Dim - 1> place = Vec<Dim - 1>::Constant((2 * y + 1) * d);
          place[0] = (2 * s + 1) * d;
          const Vec<Dim> x = walls.terrain->position(place, (k + 0.5) * d);
          add_particle<Dim>(cover.particles, x, Vec<Dim>::Zero(), 0.1, std::pow(d, Dim));
          cover.foot.push_back({(k + 0.5) * d, walls.terrain->foot(x).normal, place});
        }
    cover.hazard.assign(cover.particles.size(), 0);
    index_cover(cover);
  }
  /// The exact distance of a node to the plane.
  Foot<Dim> foot(const Index<Dim>& node) const { return walls.terrain->foot(grid.node(node)); }
  /// Calls f(node, foot) for nodes near the surface whose feet have cover on all sides.
  template <class F>
  void for_each_covered(double margin, F&& f) const {
    for_each_index<Dim>(grid.nodes(), [&](const Index<Dim>& i) {
      const Foot<Dim> at = foot(i);
      bool inside = std::abs(at.distance) < 0.5 && at.place[0] > margin && at.place[0] < 4 - margin;
      if constexpr (Dim == 3) inside = inside && at.place[1] > margin && at.place[1] < 1.8 - margin;
      if (inside) f(i, at);
    });
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("The ground of the air: a plane, or a flat cover on it", "[coupling]", ((int Dim), Dim), 2, 3) {
  const double angle = GENERATE(0.0, 0.5);
  const Bed<Dim> bed(angle);
  const GroundSurface<Dim> bare(bed.walls, bed.grid, nullptr), covered(bed.walls, bed.grid, &bed.cover);
  const Vec<Dim> normal = std::sin(angle) * Vec<Dim>::Unit(0) + std::cos(angle) * up<Dim>();
  int n = 0;
  bed.for_each_covered(0.3, [&](const Index<Dim>& i, const Foot<Dim>&) {
    const double height = normal.dot(bed.grid.node(i) - 3 * up<Dim>());  // over the plane through (0, 3)
    REQUIRE(bare.node_distance()[i] == Approx(height).margin(1e-12));
    REQUIRE(covered.node_distance()[i] == Approx(height - cover_height).margin(1e-12));
    ++n;
  });
  CHECK(n > 50);
}

TEMPLATE_TEST_CASE_SIG("The ground of the air sinks linearly where a bin of cover lost its top", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  // All bins at arc length 2.0 to 2.2 m lose one particle of height d: the surface is d lower at their middle, 2.1 m,
  // and as before from the middles of the bins beside, 1.9 and 2.3 m.
  Bed<Dim> bed(0.5);
  GroundSurface<Dim> surface(bed.walls, bed.grid, &bed.cover);
  const Field<Dim> before = surface.node_distance();
  std::vector<Vec<Dim>> places;
  for (std::size_t slot = 0; slot < bed.cover.particles.size(); ++slot)
    if (std::abs(bed.cover.foot[slot].place[0] - 2.1) < 0.01 && bed.cover.foot[slot].distance > 2 * d) {
      places.push_back(bed.cover.particles.position[slot]);
      remove_from_cover(bed.cover, slot);
    }
  REQUIRE(places.size() == (Dim == 2 ? 1 : 9));
  const std::span<const Span> moved = surface.follow(bed.cover, places);

  int sunk = 0;
  bed.for_each_covered(0.3, [&](const Index<Dim>& i, const Foot<Dim>& at) {
    const double share = std::max(0.0, 1 - std::abs(at.place[0] - 2.1) / 0.2);
    REQUIRE(surface.node_distance()[i] == Approx(at.distance - cover_height + d * share).margin(1e-12));
    sunk += share > 0;
  });
  CHECK(sunk > 3);
  for_each_index<Dim>(bed.grid.nodes(), [&](const Index<Dim>& i) {  // nodes i, i + 1 belong to the column of cells i
    bool listed = false;
    for (const Span span : moved) listed = listed || (i[0] >= span.begin && i[0] <= span.end);
    REQUIRE((listed || surface.node_distance()[i] == before[i]));
  });
}

TEMPLATE_TEST_CASE_SIG("Following the cover is the same as building its surface anew", "[coupling]", ((int Dim), Dim),
                       2, 3) {
  Bed<Dim> bed(GENERATE(0.0, 0.5));
  Box<Dim> obstacle{Vec<Dim>(Vec<Dim>::Constant(0.4)), Vec<Dim>(Vec<Dim>::Constant(1.3))};
  obstacle.lower[Dim - 1] = 2;
  obstacle.upper[Dim - 1] = 3.2;
  bed.walls.obstacles.push_back(obstacle);
  GroundSurface<Dim> surface(bed.walls, bed.grid, &bed.cover);
  for (std::uint32_t round = 0; round < 3; ++round) {
    std::vector<Vec<Dim>> places;
    for (std::size_t slot = 0; slot < bed.cover.particles.size(); ++slot) {
      if (!bed.cover.alive(slot) || noise(slot, round) < 0.7) continue;
      places.push_back(bed.cover.particles.position[slot]);
      remove_from_cover(bed.cover, slot);
    }
    REQUIRE(!places.empty());
    surface.follow(bed.cover, places);
    const GroundSurface<Dim> anew(bed.walls, bed.grid, &bed.cover);
    for (std::size_t node = 0; node < anew.node_distance().size(); ++node)
      REQUIRE(surface.node_distance()[node] == anew.node_distance()[node]);
  }
}

TEMPLATE_TEST_CASE_SIG("F13: a wall thinner than a cell closes one layer of faces, wherever it stands", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  const double dx = 0.25, begin = GENERATE(0.0, 0.1, 0.37, 0.5, 0.63, 0.9, 0.999);
  const double thickness = GENERATE(1e-6, 0.04, 0.4, 0.99);
  MacGrid<Dim> grid;
  grid.dx = dx;
  grid.origin = Vec<Dim>::Constant(-1.3);
  grid.cells.fill(9);
  Walls<Dim> walls;
  Box<Dim> wall{Vec<Dim>(Vec<Dim>::Constant(-9)), Vec<Dim>(Vec<Dim>::Constant(9))};
  wall.lower[0] = grid.origin[0] + (3 + begin) * dx;
  wall.upper[0] = wall.lower[0] + thickness * dx;
  walls.obstacles.push_back(wall);
  Suspension<Dim> air = [&] {
    typename Suspension<Dim>::Sides sides;
    for (auto& axis : sides) axis = {Side::closed, Side::closed};
    return Suspension<Dim>(grid, sides, {});
  }();
  air.set_ground(GroundSurface<Dim>(walls, grid, nullptr).node_distance());
  Index<Dim> rows = grid.cells;
  rows[0] = 1;
  for_each_index<Dim>(rows, [&](Index<Dim> i) {
    int closed = 0;
    for (i[0] = 1; i[0] < grid.cells[0]; ++i[0]) closed += air.ground().open()[0][i] == 0;
    CHECK(closed >= 1);
    CHECK(closed <= 2);
    double open = 0;
    for (i[0] = 0; i[0] < grid.cells[0]; ++i[0]) open += air.ground().volume()[i] / grid.cell_volume();
    CHECK(open >= grid.cells[0] - 1.01);
  });
}
