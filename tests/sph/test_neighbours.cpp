#include <catch2/catch.hpp>
#include <map>
#include <nanoflann.hpp>
#include <type_traits>

#include "fluid_fixture.hpp"
#include "sph/kernels.hpp"
#include "sph/neighbours.hpp"

using namespace spindrift;
using namespace spindrift::test;

namespace {

template <int Dim>
struct Cloud {
  const std::vector<Vec<Dim>>& x;
  std::size_t kdtree_get_point_count() const { return x.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t k) const { return x[i][static_cast<Eigen::Index>(k)]; }
  template <class B>
  bool kdtree_get_bbox(B&) const {
    return false;
  }
};

template <int Dim>
DenseFlow<Dim> shaken_block(double d, KernelShape kernel = KernelShape::cubic_spline) {
  DenseFlowOptions options = options_for<Dim>(d);
  options.kernel = kernel;
  DenseFlow<Dim> flow(options);
  Index<Dim> n;
  n.fill(Dim == 2 ? 25 : 9);
  add_block<Dim>(flow.particles, n, d, 300, Vec<Dim>::Constant(0.3));
  shake(flow.particles, 0.4 * d, 3);
  for (std::size_t i = 0; i < flow.particles.size(); ++i) flow.particles.volume[i] *= 1 + 0.1 * std::sin(double(i));
  return flow;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("rows match a k-d tree", "[neighbours]", ((int Dim), Dim), 2, 3) {
  const double d = 0.05, h = 2 * d;
  DenseFlow<Dim> flow = shaken_block<Dim>(d);
  Stages stages;
  flow.sort(no_walls<Dim>(), stages);
  flow.find_neighbours(no_walls<Dim>(), {}, stages);
  const Cloud<Dim> cloud{flow.particles.position};
  nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud<Dim>>, Cloud<Dim>, Dim> tree(
      Dim, cloud, nanoflann::KDTreeSingleIndexAdaptorParams(8));
  tree.buildIndex();
  std::size_t n_pairs = 0;
  for (std::size_t i = 0; i < flow.particles.size(); ++i) {
    std::vector<std::pair<std::uint32_t, double>> found;
    tree.radiusSearch(flow.particles.position[i].data(), h * h, found, nanoflann::SearchParams());
    std::vector<std::uint32_t> expected;
    for (const auto& hit : found)
      if (hit.first != i) expected.push_back(hit.first);
    const auto row = flow.neighbours().row(i);
    std::vector<std::uint32_t> got(row.index.begin(), row.index.end());
    std::sort(expected.begin(), expected.end());
    std::sort(got.begin(), got.end());
    CHECK(got == expected);
    n_pairs += row.size();
  }
  CHECK(flow.neighbours().n_pairs() == n_pairs);
}

TEMPLATE_TEST_CASE_SIG("pair gradients are right and antisymmetric to the last bit", "[neighbours]", ((int Dim), Dim),
                       2, 3) {
  const double d = 0.05;
  DenseFlow<Dim> flow = shaken_block<Dim>(d);
  for (auto& x : flow.particles.position) x += Vec<Dim>::Constant(1234.5);
  Stages stages;
  flow.sort(no_walls<Dim>(), stages);
  flow.find_neighbours(no_walls<Dim>(), {}, stages);
  const CubicSpline<Dim> kernel(2 * d);
  std::map<std::pair<std::size_t, std::size_t>, std::array<float, Dim>> gradients;
  for (std::size_t i = 0; i < flow.particles.size(); ++i) {
    const auto row = flow.neighbours().row(i);
    for (std::size_t k = 0; k < row.size(); ++k) {
      std::array<float, Dim> g;
      std::copy_n(row.gradient(k), Dim, g.begin());
      gradients[{i, row.index[k]}] = g;
    }
  }
  for (const auto& [pair, g] : gradients) {
    const Vec<Dim> exact = kernel.gradient(flow.particles.position[pair.first] - flow.particles.position[pair.second]);
    const auto& back = gradients.at({pair.second, pair.first});
    for (std::size_t k = 0; k < Dim; ++k) {
      CHECK(g[k] == -back[k]);
      CHECK(static_cast<double>(g[k]) == Approx(exact[static_cast<int>(k)]).margin(2e-5 * kernel.sigma / kernel.h));
    }
  }
}

TEMPLATE_TEST_CASE_SIG("sums over neighbours, cover and walls match brute force", "[neighbours]",
                       ((int Dim, class Shape), Dim, Shape), (2, CubicSplineShape), (3, CubicSplineShape),
                       (2, WendlandShape)) {
  const double d = 0.05, h = 2 * d;
  DenseFlow<Dim> flow =
      shaken_block<Dim>(d, std::is_same_v<Shape, WendlandShape> ? KernelShape::wendland : KernelShape::cubic_spline);
  auto& p = flow.particles;
  const Walls<Dim> walls = box<Dim>(Vec<Dim>::Constant(5));
  for (auto& x : p.position) x -= Vec<Dim>::Constant(0.28);
  Particles<Dim> cover;
  Index<Dim> n;
  n.fill(6);
  add_block<Dim>(cover, n, d, 100, Vec<Dim>::Constant(0.1));
  cover.volume[17] = 0;
  CellList<Dim> cover_cells(h);
  cover_cells.build(cover);
  Stages stages;
  std::vector<Vec<Dim>> normals;
  for (const Vec<Dim>& x : cover.position) normals.push_back((Vec<Dim>::Unit(Dim - 1) + 0.5 * x).normalized());
  flow.sort(walls, stages);
  flow.find_neighbours(walls, {&cover, &cover_cells, &normals}, stages);
  const Kernel<Dim, Shape> kernel(h);
  for (std::size_t i = 0; i < p.size(); ++i) {
    const WallShare<Dim> wall = flow.wall_kernel().share(walls, p.position[i], flow.foot(i));
    double sum = wall.fraction;
    Vec<Dim> boundary = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero(), all = Vec<Dim>::Zero();
    for (std::size_t j = 0; j < p.size(); ++j) {
      const Vec<Dim> x = p.position[i] - p.position[j];
      sum += p.volume[j] * kernel.value(x.norm());
      all += p.volume[j] * kernel.gradient(x);
    }
    for (std::size_t c = 0; c < cover.size(); ++c) {
      const Vec<Dim> x = p.position[i] - cover.position[c];
      sum += cover.volume[c] * kernel.value(x.norm());
      boundary += cover.volume[c] * kernel.gradient(x);
      normal += cover.volume[c] * kernel.gradient(x).norm() * normals[c];
    }
    if (normal.norm() > 0) boundary = boundary.dot(normal.normalized()) * normal.normalized();
    boundary += wall.gradient;
    all += 2 * boundary;
    CHECK(flow.neighbours().volume_sum()[i] == Approx(sum).epsilon(1e-5));
    CHECK((flow.neighbours().boundary_gradient()[i] - boundary).norm() * h < 1e-9);
    CHECK((flow.neighbours().gradient_sum()[i] - all).norm() * h < 1e-5);
  }
}
