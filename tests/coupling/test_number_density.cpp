// Eqs. (5) and (6) by hand. With spacing d and h = 2 d a neighbour of volume V at distance r counts
// V / d^Dim * (2 d / max(r, d) - 1): 1 up to d, 1/3 at 1.5 d, 0 from 2 d on.
#include <catch2/catch.hpp>
#include <numbers>

#include "box.hpp"
#include "coupling/overlap.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

constexpr double d = 0.1;

/// A particle at the origin; neighbours and cover are added to it.
template <int Dim>
struct Probe {
  DenseFlow<Dim> dense{[] {
    DenseFlowOptions options;
    options.support_radius = 2 * d;
    options.spacing = d;
    return options;
  }()};
  Particles<Dim> cover;
  Walls<Dim> walls;

  Probe() {
    walls.domain = {Vec<Dim>(Vec<Dim>::Constant(-50)), Vec<Dim>(Vec<Dim>::Constant(50))};
    add(dense.particles, Vec<Dim>::Zero(), 1);
  }
  /// x in spacings, volume in d^Dim.
  static void add(Particles<Dim>& particles, const Vec<Dim>& x, double volume) {
    add_particle<Dim>(particles, Vec<Dim>(d * x), Vec<Dim>::Zero(), 1.0, volume * std::pow(d, Dim));
  }
  /// Whether n of the first particle is `n`: under a threshold a little above, not under one a little below.
  bool has_n(double n) {
    Stages stages;
    CellList<Dim> cells(2 * d);
    cells.build(cover);
    const std::vector<Vec<Dim>> normals(cover.size(), up<Dim>());
    const CoverView<Dim> view{&cover, &cells, &normals};
    dense.sort(walls, stages);
    dense.find_neighbours(walls, view, stages);
    const auto& id = dense.particles.id;
    const auto first = static_cast<std::size_t>(std::find(id.begin(), id.end(), 0u) - id.begin());
    std::vector<std::uint8_t> above, below;
    classify_overlap<Dim>(above, dense, view, walls, 1 + 1e-4, n);
    classify_overlap<Dim>(below, dense, view, walls, 1 - 1e-4, n);
    return above[first] == 1 && below[first] == 0;
  }
};

/// n of the middle of a lattice, from a list of its points.
template <int Dim>
double lattice_sum(double spacing, double h) {
  double n = 0;
  Index<Dim> block;
  block.fill(11);
  for_each_index<Dim>(block, [&](const Index<Dim>& i) {
    double r2 = 0;
    for (const int k : i) r2 += spacing * spacing * (k - 5) * (k - 5);
    const double r = std::sqrt(r2);
    if (r > 0 && r < h) n += (h - r) / r;
  });
  return n;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("C10: the number density of two and of three neighbours by hand", "[coupling]", ((int Dim), Dim),
                       2, 3) {
  Probe<Dim> probe;
  probe.add(probe.dense.particles, Vec<Dim>::Unit(0), 2);            // 2 * 1
  probe.add(probe.dense.particles, -1.5 * up<Dim>(), 0.5);           // 0.5 / 3
  probe.add(probe.dense.particles, 2.001 * Vec<Dim>::Unit(0), 100);  // out of reach
  CHECK(probe.has_n(2 + 0.5 / 3));
  CHECK_FALSE(probe.has_n(2.2));
  probe.add(probe.dense.particles, 0.2 * up<Dim>(), 0.7);  // 0.7, not 0.7 * (2 / 0.2 - 1)
  CHECK(probe.has_n(2.7 + 0.5 / 3));
}

TEMPLATE_TEST_CASE_SIG("C10: cover and ground count in the number density", "[coupling]", ((int Dim), Dim), 2, 3) {
  Probe<Dim> probe;
  probe.add(probe.dense.particles, Vec<Dim>::Unit(0), 1);  // 1
  probe.add(probe.cover, -1.5 * up<Dim>(), 2);             // 2 / 3
  probe.add(probe.cover, -0.5 * up<Dim>(), 0.5);           // 0.5
  CHECK(probe.has_n(1 + 2.0 / 3 + 0.5));
  // The particle on the floor: half of the kernel's integral, pi h^Dim / 2 in both dimensions.
  probe.walls.domain.lower[Dim - 1] = 0;
  probe.walls.sides[Dim - 1][0] = Side::closed;
  CHECK(probe.has_n(1 + 2.0 / 3 + 0.5 + std::numbers::pi * std::pow(2, Dim) / 4));
}

TEMPLATE_TEST_CASE_SIG("The interior number density is the sum over the lattice", "[coupling]", ((int Dim), Dim), 2,
                       3) {
  const double root2 = std::sqrt(2.0),
               by_hand = Dim == 2 ? 4 * root2 : 6 + 12 * (root2 - 1) + 8 * (2 / std::sqrt(3.0) - 1);
  CHECK(interior_number_density<Dim>(d, 2 * d) == Approx(by_hand).epsilon(1e-12));
  const double wide = GENERATE(1.5, 2.0, 2.7, 4.3);
  CHECK(interior_number_density<Dim>(0.3, 0.3 * wide) == Approx(lattice_sum<Dim>(0.3, 0.3 * wide)).epsilon(1e-12));
}
