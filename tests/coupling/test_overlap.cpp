#include <catch2/catch.hpp>

#include "box.hpp"
#include "coupling/core_cells.hpp"
#include "coupling/overlap.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

constexpr double d = 0.105;

/// Snow from z = 0 (a closed floor) to `rows` spacings, several spacings wide.
template <int Dim>
DenseFlow<Dim> block(const Vec<Dim>& shift, int rows, double support = 2 * d) {
  DenseFlowOptions options;
  options.support_radius = support;
  options.spacing = d;
  DenseFlow<Dim> dense(options);
  Index<Dim> shape;
  shape.fill(Dim == 2 ? 24 : 10);
  shape[Dim - 1] = rows;
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = d * (i[k] + 0.5);
    add_particle<Dim>(dense.particles, Vec<Dim>(x + shift), Vec<Dim>::Unit(0), 300 * std::pow(d, Dim),
                      std::pow(d, Dim));
  });
  return dense;
}

template <int Dim>
Walls<Dim> floor_at(double z) {
  Walls<Dim> walls;
  walls.domain = {Vec<Dim>(Vec<Dim>::Constant(-50)), Vec<Dim>(Vec<Dim>::Constant(50))};
  walls.domain.lower[Dim - 1] = z;
  walls.sides[Dim - 1][0] = Side::closed;
  return walls;
}

/// Rows (by height) of overlap particles in the middle of the block, away from its flanks.
template <int Dim>
std::vector<int> overlap_rows(const Vec<Dim>& shift, int rows, bool with_floor, double fraction = 0.8,
                              double support = 2 * d) {
  DenseFlow<Dim> dense = block<Dim>(shift, rows, support);
  const Walls<Dim> walls = floor_at<Dim>(with_floor ? shift[Dim - 1] : -40);
  Stages stages;
  dense.sort(walls, stages);
  dense.find_neighbours(walls, {}, stages);
  std::vector<std::uint8_t> overlap;
  classify_overlap<Dim>(overlap, dense, {}, walls, fraction, interior_number_density<Dim>(d, support));
  std::vector<int> found;
  for (std::size_t i = 0; i < dense.particles.size(); ++i) {
    const Vec<Dim> x = (dense.particles.position[i] - shift) / d;
    bool middle = true;
    for (int k = 0; k + 1 < Dim; ++k) middle &= x[k] > 3 && x[k] < (Dim == 2 ? 21 : 7);
    if (middle && overlap[i]) found.push_back(static_cast<int>(x[Dim - 1]));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

/// n at a place among the particles of a lattice, itself left out, over n in the interior: the row `below` rows under
/// the surface of a half-space has the points up to `below` rows above it.
template <int Dim>
double share_of_row(int below, double support) {
  const int reach = static_cast<int>(support / d) + 1;
  double n = 0, interior = 0;
  Index<Dim> around;
  around.fill(2 * reach + 1);
  for_each_index<Dim>(around, [&](const Index<Dim>& i) {
    double squared = 0;
    for (const int k : i) squared += std::pow(d * (k - reach), 2);
    const double r = std::sqrt(squared);
    if (r == 0 || r >= support) return;
    interior += support / r - 1;
    if (i[Dim - 1] - reach <= below) n += support / r - 1;
  });
  return n / interior;
}

/// Overlap rows where particles take the class of the nearest node of a grid with cells of dx, as the paper has it.
template <int Dim>
std::size_t n_rows_by_nodes(const Vec<Dim>& shift, int rows, double dx) {
  const DenseFlow<Dim> dense = block<Dim>(shift, rows);
  const std::vector<Vec<Dim>>& all = dense.particles.position;
  std::size_t n_rows = 0;
  for (int row = 0; row < rows; ++row) {
    Vec<Dim> x = shift + Vec<Dim>::Constant((Dim == 2 ? 12.5 : 5.5) * d);
    x[Dim - 1] = shift[Dim - 1] + (row + 0.5) * d;
    const Vec<Dim> node = dx * (x / dx).array().round().matrix();
    double n = 0;
    for (const Vec<Dim>& other : all) n += std::max(0.0, 2 * d / std::max((other - node).norm(), d) - 1);
    n_rows += n < 0.8 * interior_number_density<Dim>(d, 2 * d);
  }
  return n_rows;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("C10: the overlap region is the surface row, not the underside", "[coupling]", ((int Dim), Dim),
                       2, 3) {
  CHECK(overlap_rows<Dim>(Vec<Dim>::Zero(), 8, true) == std::vector<int>{7});
  CHECK(overlap_rows<Dim>(Vec<Dim>::Zero(), 8, false) == std::vector<int>{0, 7});  // without ground: both faces
}

TEMPLATE_TEST_CASE_SIG("C10: the class does not depend on where the snow lies", "[coupling]", ((int Dim), Dim), 2, 3) {
  const double fraction = GENERATE(0.1, 0.37, 0.5, 0.93);
  CHECK(overlap_rows<Dim>(Vec<Dim>(Vec<Dim>::Constant(fraction * d)), 8, true) == std::vector<int>{7});
}

TEMPLATE_TEST_CASE_SIG("C10: snow that flies alone is overlap, no snow has none", "[coupling]", ((int Dim), Dim), 2,
                       3) {
  DenseFlowOptions options;
  options.support_radius = 2 * d;
  options.spacing = d;
  DenseFlow<Dim> dense(options);
  const Walls<Dim> walls = floor_at<Dim>(-40);
  Stages stages;
  std::vector<std::uint8_t> overlap(3, 1);
  dense.sort(walls, stages);
  dense.find_neighbours(walls, {}, stages);
  classify_overlap<Dim>(overlap, dense, {}, walls, 0.8, interior_number_density<Dim>(d, 2 * d));
  CHECK(overlap.empty());
  add_particle<Dim>(dense.particles, Vec<Dim>::Zero(), Vec<Dim>::Zero(), 1.0, std::pow(d, Dim));
  dense.sort(walls, stages);
  dense.find_neighbours(walls, {}, stages);
  classify_overlap<Dim>(overlap, dense, {}, walls, 0.8, interior_number_density<Dim>(d, 2 * d));
  CHECK(overlap == std::vector<std::uint8_t>{1});
}

TEMPLATE_TEST_CASE_SIG("C10, control: the surface row has the share of neighbours that its lattice has", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  // A lattice of spacing h / 2 has n = 4 sqrt(2) inside in 2D, its surface row 3 + 2 (sqrt(2) - 1): 0.6768 of it. In 3D
  // 6 + 12 (sqrt(2) - 1) + 8 (2 / sqrt(3) - 1), and 5 + 8 (sqrt(2) - 1) + 4 (2 / sqrt(3) - 1): 0.7317.
  const double share = Dim == 2 ? 0.6768 : 0.7317;
  CHECK(overlap_rows<Dim>(Vec<Dim>::Zero(), 8, true, share - 0.001).empty());
  CHECK(overlap_rows<Dim>(Vec<Dim>::Zero(), 8, true, share + 0.001) == std::vector<int>{7});
  CHECK(overlap_rows<Dim>(Vec<Dim>::Zero(), 8, true, 10) == std::vector<int>{0, 1, 2, 3, 4, 5, 6, 7});
}

TEMPLATE_TEST_CASE_SIG("C10: the band grows with the threshold, row by row", "[coupling]", ((int Dim), Dim), 2, 3) {
  const double support = GENERATE(2.0, 3.0, 3.9) * d;
  const int deepest = static_cast<int>(support / d * 0.999);  // the last row that the surface's air is in reach of
  std::vector<int> band;
  for (int below = 0; below < deepest; ++below) {
    const double share = share_of_row<Dim>(below, support);
    CHECK(overlap_rows<Dim>(Vec<Dim>::Zero(), 9, true, share - 1e-3, support) == band);
    band.insert(band.begin(), 8 - below);
    CHECK(overlap_rows<Dim>(Vec<Dim>::Zero(), 9, true, share + 1e-3, support) == band);
  }
}

TEMPLATE_TEST_CASE_SIG("C10, control: classes of nodes farther apart than h change as the snow is moved", "[coupling]",
                       ((int Dim), Dim), 2, 3) {
  const double dx = GENERATE(0.33, 1.0);
  std::size_t least = 99, most = 0;
  for (const double fraction : {0.0, 0.2, 0.4, 0.6, 0.8}) {
    const Vec<Dim> shift = Vec<Dim>::Constant(fraction * dx);
    CHECK(overlap_rows<Dim>(shift, 8, true) == std::vector<int>{7});
    const std::size_t n = n_rows_by_nodes<Dim>(shift, 8, dx);
    least = std::min(least, n), most = std::max(most, n);
  }
  CHECK(most > least);
}

TEMPLATE_TEST_CASE_SIG("A core cell is at least half full of snow outside overlap", "[coupling]", ((int Dim), Dim), 2,
                       3) {
  Suspension<Dim> air = air_box<Dim>(4, 1, 1.2);
  Particles<Dim> particles;
  const auto fill = [&](double x0, double share, const Vec<Dim>& v) {
    for (int i = 0; i < 10; ++i) {
      Vec<Dim> x = Vec<Dim>::Constant(1.5);
      x[0] = x0 + 0.05 * i;
      add_particle<Dim>(particles, x, v, 1.0 + i, share / 10);
    }
  };
  fill(0.2, 0.51, Vec<Dim>::Unit(0));
  fill(1.2, 0.49, Vec<Dim>::Unit(0));
  fill(2.2, 0.80, 3 * Vec<Dim>::Unit(0));
  std::vector<std::uint8_t> overlap(particles.size(), 0);
  std::fill(overlap.begin() + 20, overlap.begin() + 24, std::uint8_t{1});
  CoreCells<Dim> core;
  core.find(particles, overlap, air);
  REQUIRE(core.cells().size() == 1);
  CHECK(core.cells()[0].cell[0] == 0);
  CHECK(core.cells()[0].mass == Approx(55));

  core.cells()[0].impulse = 11 * Vec<Dim>::Unit(Dim - 1);
  core.cells()[0].adhered = 5.5;
  core.cells()[0].adhered_momentum = 2 * Vec<Dim>::Unit(0);
  const Vec<Dim> before = particle_momentum(particles);
  double adhered = 0;
  const Vec<Dim> given = core.give_back(particles, adhered);
  CHECK(adhered == 5.5);
  CHECK((particle_momentum(particles) - before - given).norm() < 1e-12);
  CHECK((given - 11 * Vec<Dim>::Unit(Dim - 1) - 2 * Vec<Dim>::Unit(0)).norm() == 0);
  CHECK(particles.mass[0] == Approx(1.1));
  CHECK(particles.mass[15] == 6);
}
