#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <set>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sph/sampling.hpp"

using namespace spindrift;

namespace {

constexpr double d = 0.105;

std::vector<Vec<2>> profile(const std::string& shape) {
  if (shape == "line") return {{0, 0}, {60, -36}};
  if (shape == "kinks") return {{0, 0}, {20, -15}, {45, -15}, {52, -21}, {60, -22}};
  if (shape == "cliff") return {{0, 0}, {20, -10}, {20, -30}, {60, -40}};
  std::vector<Vec<2>> bumps;
  for (int i = 0; i <= 300; ++i) bumps.push_back({0.2 * i, -0.12 * i + 0.5 * std::sin(0.2 * i * 2 * M_PI / 15)});
  return bumps;
}

template <int Dim>
Cover<Dim> sampled(const Terrain<Dim>& terrain, double depth, double to, std::uint64_t seed = 1) {
  CoverLayer layer{.from = 0, .to = to, .y = {0, 2}, .depth = depth, .seed = seed};
  return sample_cover<Dim>(terrain, layer, {.spacing = d, .density = 100, .first_id = 1000});
}

template <int Dim>
NearestNeighbours by_brute_force(const std::vector<Vec<Dim>>& x) {
  NearestNeighbours all{0, std::numeric_limits<double>::infinity()};
  for (std::size_t i = 0; i < x.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < x.size(); ++j)
      if (j != i) least = std::min(least, (x[i] - x[j]).norm());
    all.mean += least / static_cast<double>(x.size());
    all.least = std::min(all.least, least);
  }
  return all;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("The cover is nearly uniform, d apart and inside its layer", "[sampling]", ((int Dim), Dim), 2,
                       3) {
  const auto shape = GENERATE(as<std::string>{}, "line", "bumps", "kinks", "cliff");
  const double depth = 0.525, to = Dim == 2 ? 60 : 28;
  const auto seed = GENERATE(std::uint64_t{1}, std::uint64_t{77});
  CAPTURE(shape, seed);
  const Terrain<Dim> terrain(profile(shape));
  const Cover<Dim> cover = sampled<Dim>(terrain, depth, to, seed);
  const std::size_t n = cover.particles.size();
  REQUIRE(n > 500);

  const NearestNeighbours nearest = nearest_neighbours<Dim>(cover.particles.position);
  CHECK(nearest.mean == Approx(d).epsilon(0.03));
  CHECK(nearest.least >= 0.7 * d);

  const double covered = shape == "cliff" ? std::sqrt(500.0) + std::max(0.0, to - std::sqrt(500.0) - 20) : to;
  CHECK(static_cast<double>(n) == Approx(covered * (Dim == 3 ? 2 : 1) * depth / std::pow(d, Dim)).epsilon(0.03));

  double outside = 0, farthest_off = 0;
  std::set<std::uint64_t> ids;
  for (std::size_t i = 0; i < n; ++i) {
    const double distance = terrain.foot(cover.particles.position[i]).distance;
    outside = std::max({outside, d / 2 - distance, distance - (depth - d / 2)});
    const Vec<Dim> back = terrain.position(cover.foot[i].place, cover.foot[i].distance);
    farthest_off = std::max(farthest_off, (back - cover.particles.position[i]).norm());
    ids.insert(cover.particles.id[i]);
    REQUIRE(cover.particles.mass[i] == Approx(100 * std::pow(d, Dim)));
    REQUIRE(cover.particles.entrained_at[i] == -1);
    REQUIRE(cover.particles.velocity[i] == Vec<Dim>::Zero());
  }
  CHECK(outside <= 1e-6 * d);
  CHECK(farthest_off <= 1e-9);
  CHECK(ids.size() == n);
  CHECK(*ids.begin() == 1000);
  CHECK(*ids.rbegin() == 1000 + n - 1);
}

TEMPLATE_TEST_CASE_SIG("Every height of the layer is equally full", "[sampling]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain(profile("line"));
  const Cover<Dim> cover = sampled<Dim>(terrain, 0.84, Dim == 2 ? 60 : 10);
  std::vector<double> share(4, 0);
  for (const Foot<Dim>& foot : cover.foot)
    share[static_cast<std::size_t>(foot.distance / 0.21)] += 4.0 / static_cast<double>(cover.foot.size());
  for (const double s : share) CHECK(s == Approx(1).margin(0.1));
}

TEMPLATE_TEST_CASE_SIG("The cover is the same again, with any number of threads, and piece by piece", "[sampling]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain(profile("kinks"));
  const Cover<Dim> cover = sampled<Dim>(terrain, 0.525, 30);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    const Cover<Dim> again = sampled<Dim>(terrain, 0.525, 30);
    CHECK(again.particles.position == cover.particles.position);
    CHECK(again.particles.id == cover.particles.id);
    CHECK(again.members == cover.members);
  }
  CHECK(sampled<Dim>(terrain, 0.525, 30, 2).particles.position != cover.particles.position);

  const auto before = [](const Vec<Dim>& a, const Vec<Dim>& b) {
    return std::lexicographical_compare(a.data(), a.data() + Dim, b.data(), b.data() + Dim);
  };
  const Cover<Dim> shorter = sampled<Dim>(terrain, 0.525, 15);
  std::vector<Vec<Dim>> all = cover.particles.position;
  std::sort(all.begin(), all.end(), before);
  REQUIRE(shorter.particles.size() > 500);
  for (const Vec<Dim>& x : shorter.particles.position) REQUIRE(std::binary_search(all.begin(), all.end(), x, before));
}

TEMPLATE_TEST_CASE_SIG("Thin, deep and absurd layers", "[sampling]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain(profile("line"));
  const double extent = Dim == 2 ? 20 : 20 * 2;
  for (const double depth : {0.03, d, 1.5 * d, 2.5 * d, 2.0}) {
    CAPTURE(depth);
    const Cover<Dim> cover = sampled<Dim>(terrain, depth, 20);
    const double wanted = extent * depth / std::pow(d, Dim);
    CHECK(static_cast<double>(cover.particles.size()) == Approx(wanted).epsilon(depth < 2 * d ? 0.15 : 0.03));
    CHECK(nearest_neighbours<Dim>(cover.particles.position).least >= 0.7 * d);
    for (const Foot<Dim>& foot : cover.foot) REQUIRE((foot.distance > 0 && foot.distance < depth));
  }
  CHECK(sampled<Dim>(terrain, 0, 20).particles.empty());
  CHECK(sampled<Dim>(terrain, -1, 20).particles.empty());
  CHECK(sampled<Dim>(terrain, 0.5, 0).particles.empty());
  const double nan = std::numeric_limits<double>::quiet_NaN();
  CHECK_THROWS_AS(sampled<Dim>(terrain, nan, 20), Error);
  CHECK_THROWS_AS(sampled<Dim>(terrain, 0.5, std::numeric_limits<double>::infinity()), Error);
  for (const double spacing : {0.0, -1.0, nan})
    CHECK_THROWS_AS(sample_cover<Dim>(terrain, {.to = 1}, {.spacing = spacing}), Error);
}

TEMPLATE_TEST_CASE_SIG("Nearest neighbours agree with brute force", "[sampling]", ((int Dim), Dim), 2, 3) {
  const Cover<Dim> cover = sampled<Dim>(Terrain<Dim>(profile("bumps")), 0.525, Dim == 2 ? 8 : 1);
  const NearestNeighbours fast = nearest_neighbours<Dim>(cover.particles.position);
  const NearestNeighbours slow = by_brute_force<Dim>(cover.particles.position);
  CHECK(fast.mean == Approx(slow.mean).epsilon(1e-12));
  CHECK(fast.least == Approx(slow.least).epsilon(1e-12));
  CHECK(std::isinf(nearest_neighbours<Dim>({}).mean));
  CHECK(std::isinf(nearest_neighbours<Dim>(std::vector<Vec<Dim>>(1, Vec<Dim>::Zero())).mean));
  CHECK(nearest_neighbours<Dim>(std::vector<Vec<Dim>>(2, Vec<Dim>::Zero())).least == 0);
}

TEMPLATE_TEST_CASE_SIG("A slab is a lattice on the cover", "[sampling]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain(profile("line"));
  SnowKind<Dim> kind{.spacing = 0.1, .density = 300, .first_id = 7};
  kind.velocity[0] = 3;
  const Slab slab{.at = 5, .length = 2.04, .base = 0.5, .thickness = 0.97, .y = {1, 1.5}};
  const Particles<Dim> snow = sample_slab<Dim>(terrain, slab, kind);
  REQUIRE(snow.size() == 20 * 10 * (Dim == 3 ? 5 : 1));
  CHECK(nearest_neighbours<Dim>(snow.position).least == Approx(0.1).epsilon(1e-9));
  CHECK(nearest_neighbours<Dim>(snow.position).mean == Approx(0.1).epsilon(1e-9));
  for (std::size_t i = 0; i < snow.size(); ++i) {
    const Foot<Dim> foot = terrain.foot(snow.position[i]);
    REQUIRE((foot.distance > 0.549 && foot.distance < 1.451));
    REQUIRE((foot.place[0] > 5.049 && foot.place[0] < 6.951));
    if constexpr (Dim == 3) REQUIRE((foot.place[1] > 1.049 && foot.place[1] < 1.451));
    REQUIRE(snow.id[i] == 7 + i);
    REQUIRE(snow.velocity[i] == kind.velocity);
    REQUIRE(snow.mass[i] == Approx(300 * snow.volume[i]));
  }
}

TEMPLATE_TEST_CASE_SIG("A box is a lattice of exact counts", "[sampling]", ((int Dim), Dim), 2, 3) {
  Box<Dim> box;
  box.upper.setConstant(0.5);
  box.upper[0] = 1;
  const Particles<Dim> snow = sample_box<Dim>(box, {.spacing = 0.1});
  REQUIRE(snow.size() == 10 * 5 * (Dim == 3 ? 5 : 1));
  for (const Vec<Dim>& x : snow.position) REQUIRE(box.contains(x));
  Vec<Dim> corner = box.lower;
  corner.array() += 0.05;
  CHECK((snow.position.front() - corner).norm() < 1e-12);

  std::swap(box.lower, box.upper);
  CHECK(sample_box<Dim>(box, {.spacing = 0.1}).empty());
  box.lower.setConstant(-1e300);
  CHECK_THROWS_AS(sample_box<Dim>(box, {.spacing = 0.1}), Error);
}
