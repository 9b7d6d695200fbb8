#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "sph/dense_flow.hpp"
#include "sph/kernels.hpp"
#include "sph/sampling.hpp"

using namespace spindrift;

namespace {

constexpr double d = 0.1;

template <int Dim>
Terrain<Dim> incline(double angle) {
  return Terrain<Dim>({{0, 0}, {100, -100 * std::tan(angle)}});
}

/// Stacks of height(s) particles, one a bin and in 3D the same across: a cover whose surface is known.
template <int Dim, class Height>
Cover<Dim> stacks(const Terrain<Dim>& terrain, int n_bins, Height&& height) {
  Cover<Dim> cover;
  cover.spacing = d;
  cover.density = 100;
  cover.thickness = 2;
  const int n_across = Dim == 2 ? 1 : n_bins;
  for (int s = 0; s < n_bins; ++s)
    for (int y = 0; y < n_across; ++y)
      for (int k = 0; k < height(s); ++k) {
        Vec<Dim - 1> place = Vec<Dim - 1>::Constant((2 * y + 1) * d);
        place[0] = (2 * s + 1) * d;
        const Vec<Dim> x = terrain.position(place, (k + 0.5) * d);
        cover.particles.push_back_from(
            sample_box<Dim>({x.array() - d / 2, x.array() + d / 2}, {.spacing = d, .density = 100}), 0);
        cover.foot.push_back({(k + 0.5) * d, terrain.foot(x).normal, place});
      }
  cover.hazard.assign(cover.particles.size(), 0);
  cover.ground_lower.setConstant(d);
  cover.ground_upper.setConstant((2 * n_bins - 1) * d);
  index_cover(cover);
  return cover;
}

template <int Dim>
std::size_t bin_along(const Cover<Dim>& cover, std::size_t slot) {
  return static_cast<std::size_t>(cover.foot[slot].place[0] / cover.bin_size);
}

template <int Dim>
CoverView<Dim> view(const Cover<Dim>& cover) {
  return {&cover.particles, &cover.cells, &cover.surface_normal};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("A level surface has the ground's normal, up to the ends of the ground", "[cover]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(0.6);
  const Cover<Dim> cover = stacks<Dim>(terrain, 12, [](int) { return 3; });
  for (std::size_t i = 0; i < cover.particles.size(); ++i)
    CHECK((cover.surface_normal[i] - cover.foot[i].normal).norm() < 1e-14);
}

TEMPLATE_TEST_CASE_SIG("A wedge tilts the normals by its slope", "[cover]", ((int Dim), Dim), 2, 3) {
  const double angle = GENERATE(0.0, 0.6);
  const Terrain<Dim> terrain = incline<Dim>(angle);
  const Cover<Dim> cover = stacks<Dim>(terrain, 16, [](int s) { return s + 1; });  // d up over 2 d along
  Vec<Dim> expected = Vec<Dim>::Zero();
  const double tilt = angle + std::atan(-0.5);
  expected[0] = std::sin(tilt), expected[Dim - 1] = std::cos(tilt);
  for (std::size_t i = 0; i < cover.particles.size(); ++i) {
    const std::size_t s = bin_along<Dim>(cover, i);
    if (s < surface_reach || s + surface_reach >= 16) continue;
    CHECK((cover.surface_normal[i] - expected).norm() < 1e-12);
  }
}

TEMPLATE_TEST_CASE_SIG("The rim of a cover on longer ground tilts, the ground's own end does not", "[cover]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(0);
  const auto rim_tilt = [&](double ground_from) {
    const Cover<Dim> cover =
        sample_cover<Dim>(terrain, {.from = 2, .to = 6, .ground_from = ground_from, .y = {0, 1}, .depth = 0.5},
                          {.spacing = d, .density = 100});
    double tilt = 0, n = 0;
    for (std::size_t i = 0; i < cover.particles.size(); ++i)
      if (cover.foot[i].place[0] < 2 + 2 * d) tilt += cover.surface_normal[i][0], ++n;
    return tilt / n;
  };
  CHECK(rim_tilt(0) < -0.1);
  CHECK(std::abs(rim_tilt(2)) < 0.05);
}

TEMPLATE_TEST_CASE_SIG("the cover's cells reach as far as the flow's kernel", "[cover]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(0.5);
  const Cover<Dim> cover = sample_cover<Dim>(terrain, {.to = 2, .y = {0, 1}, .depth = 0.5, .support_radius = 3.5 * d},
                                             {.spacing = d, .density = 100});
  const auto& x = cover.particles.position;
  const Vec<Dim> middle = terrain.position(0.5 * (Vec<Dim - 1>::Unit(0) + Vec<Dim - 1>::Ones()), 0.3);
  std::size_t n = 0, n_near = 0;
  for (const Vec<Dim>& at : x) n += (at - middle).norm() < 3.5 * d;
  cover.cells.for_each_near(middle, [&](std::uint32_t c) { n_near += (x[c] - middle).norm() < 3.5 * d; });
  CHECK(n > 10);
  CHECK(n_near == n);
}

TEMPLATE_TEST_CASE_SIG("settle_surface finds what index_cover would", "[cover]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(0.5);
  Cover<Dim> cover = sample_cover<Dim>(terrain, {.to = 4, .y = {0, 1}, .depth = 0.5}, {.spacing = d, .density = 100});
  std::vector<GroundBin<Dim>> bins;
  GroundBin<Dim> bin{};
  for (const int b : {9, 10, 14}) {
    bin[0] = b;
    bins.push_back(bin);
    for (const std::uint32_t slot : cover.slots_in(bin)) remove_from_cover(cover, slot);
  }
  const std::vector<Vec<Dim>> before = cover.surface_normal;
  settle_surface<Dim>(cover, bins);
  const std::vector<std::uint64_t> id = cover.particles.id;
  const std::vector<Vec<Dim>> settled = cover.surface_normal;
  REQUIRE(settled != before);
  index_cover(cover);
  REQUIRE(cover.particles.id == id);
  for (std::size_t i = 0; i < id.size(); ++i)
    if (cover.alive(i)) CHECK(cover.surface_normal[i] == settled[i]);
}

TEMPLATE_TEST_CASE_SIG("A pitted surface does not push along the slope", "[cover]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(0.5);
  Cover<Dim> cover = sample_cover<Dim>(terrain, {.to = 4, .y = {0, 1}, .depth = 0.5}, {.spacing = d, .density = 100});
  for (std::size_t i = 0; i < cover.particles.size(); i += 2)
    if (cover.foot[i].distance > 0.4) remove_from_cover(cover, i);
  index_cover(cover);
  DenseFlowOptions options;
  options.support_radius = 2 * d;
  options.spacing = d;
  DenseFlow<Dim> flow(options);
  flow.particles = sample_slab<Dim>(terrain, {.at = 1.5, .length = 1, .base = 0.45, .thickness = 0.3, .y = {0.2, 0.8}},
                                    {.spacing = d});
  Walls<Dim> walls;
  walls.domain = {Vec<Dim>(Vec<Dim>::Constant(-50)), Vec<Dim>(Vec<Dim>::Constant(50))};
  Stages stages;
  flow.sort(walls, stages);
  flow.find_neighbours(walls, view(cover), stages);
  const CubicSpline<Dim> kernel(2 * d);
  const Vec<Dim> normal = terrain.foot(flow.particles.position[0]).normal;
  double raw = 0, smooth = 0, across = 0;
  for (std::size_t i = 0; i < flow.particles.size(); ++i) {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t c = 0; c < cover.particles.size(); ++c)
      sum += cover.particles.volume[c] * kernel.gradient(flow.particles.position[i] - cover.particles.position[c]);
    const Vec<Dim>& b = flow.neighbours().boundary_gradient()[i];
    raw += (sum - sum.dot(normal) * normal).norm();
    smooth += (b - b.dot(normal) * normal).norm();
    across += std::abs(b.dot(normal));
  }
  CHECK(raw > 0.2 * across);
  CHECK(smooth < 0.1 * across);
}
