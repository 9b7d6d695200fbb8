#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <vector>

#include "core/parallel.hpp"
#include "sph/sampling.hpp"
#include "sph/standing_columns.hpp"

using namespace spindrift;

namespace {

constexpr double d = 0.1, h = 0.2;

template <int Dim>
Terrain<Dim> flat_ground() {
  return Terrain<Dim>({{0, 0}, {100, 0}});
}

template <int Dim>
Vec<Dim> at(double x, double z) {
  Vec<Dim> p = Vec<Dim>::Constant(0.05);
  p[0] = x, p[Dim - 1] = z;
  return p;
}

template <int Dim>
Particles<Dim> particles_at(const std::vector<Vec<Dim>>& positions) {
  Particles<Dim> all;
  for (const Vec<Dim>& x : positions) {
    Particles<Dim> one =
        sample_box<Dim>({x.array() - d / 2, x.array() + d / 2}, {.spacing = d, .first_id = all.size()});
    REQUIRE(one.size() == 1);
    all.push_back_from(one, 0);
  }
  return all;
}

template <int Dim>
double area() {
  return ground_bin_area<Dim>(2 * d);
}

}  // namespace

TEST_CASE("Ground bins", "[columns]") {
  CHECK(ground_bin<2>(Vec<1>(0.39), 0.2) == GroundBin<2>{1});
  CHECK(ground_bin<2>(Vec<1>(-0.01), 0.2) == GroundBin<2>{-1});
  CHECK(ground_bin<3>(Vec<2>(0.5, -0.3), 0.2) == GroundBin<3>{2, -2});
  CHECK(ground_bin<2>(Vec<1>(1e300), 0.2)[0] == 1000000000);
  CHECK(ground_bin<2>(Vec<1>(std::numeric_limits<double>::quiet_NaN()), 0.2)[0] == -1000000000);
  int n = 0;
  for_each_bin_around<3>({5, 5}, [&](const GroundBin<3>& bin) { n += std::abs(bin[0] - 5) + std::abs(bin[1] - 5); });
  CHECK(n == 12);
}

TEMPLATE_TEST_CASE_SIG("A lattice on the ground has columns of its own height", "[columns]", ((int Dim), Dim), 2, 3) {
  const Slab slab{.at = 4, .length = 4, .thickness = 1, .y = {0, 1}};
  const Terrain<Dim> terrain({{0, 0}, {60, -36}});
  Particles<Dim> snow = sample_slab<Dim>(terrain, slab, {.spacing = d, .density = 300});
  for (Vec<Dim>& v : snow.velocity) v[0] = 2;
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
  REQUIRE(columns.columns.size() == 20 * (Dim == 3 ? 5 : 1));
  for (const Column<Dim>& c : columns.columns) {
    CHECK(c.bed == 0);
    CHECK(c.thickness == Approx(1));
    CHECK(c.mass_per_area == Approx(300));
    CHECK(c.velocity[0] == Approx(2));
    CHECK(columns.standing(c).size() == columns.over_bin(c).size());
    CHECK(columns.find(c.bin) == &c);
    double last = 0;
    for (const std::uint32_t i : columns.over_bin(c)) {
      REQUIRE(columns.foot[i].distance >= last);
      REQUIRE(&columns.columns[columns.column[i]] == &c);
      last = columns.foot[i].distance;
    }
  }
  GroundBin<Dim> nowhere{};
  nowhere[0] = -3;
  CHECK(columns.find(nowhere) == nullptr);
}

TEMPLATE_TEST_CASE_SIG("Snow over an air gap is not of the column", "[columns]", ((int Dim), Dim), 2, 3) {
  // Gaps between surfaces: 0.19 < h bridged, 0.21 > h not.
  const double gap = GENERATE(0.0, 0.19, 0.21, 5.0);
  const Particles<Dim> snow =
      particles_at<Dim>({at<Dim>(0.05, 0.05 + d + gap), at<Dim>(0.05, 0.05), at<Dim>(1.05, 0.05 + gap)});
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, flat_ground<Dim>(), snow, nullptr, d, h);
  REQUIRE(columns.columns.size() == 2);
  const Column<Dim>&pile = columns.columns[0], &single = columns.columns[1];
  CHECK(columns.over_bin(pile).size() == 2);
  CHECK(columns.over_bin(pile)[0] == 1);
  CHECK(columns.standing(pile).size() == (gap < h ? 2u : 1u));
  CHECK(columns.standing(single).size() == (gap < h ? 1u : 0u));
  CHECK(single.thickness == Approx(gap < h ? std::pow(d, Dim) / area<Dim>() : 0));
  CHECK(single.mass_per_area == Approx(gap < h ? 300 * std::pow(d, Dim) / area<Dim>() : 0));
}

TEMPLATE_TEST_CASE_SIG("The bed is the cover's surface and falls with it", "[columns]", ((int Dim), Dim), 2, 3) {
  Cover<Dim> cover;
  cover.spacing = d;
  cover.density = 100;
  cover.thickness = 0.3;
  cover.particles = particles_at<Dim>({at<Dim>(0.05, 0.05), at<Dim>(0.05, 0.25), at<Dim>(0.05, 0.15)});
  for (std::size_t i = 0; i < 3; ++i) cover.foot.push_back(flat_ground<Dim>().foot(cover.particles.position[i]));
  cover.hazard.assign(3, 0);
  index_cover(cover);
  const Particles<Dim> snow = particles_at<Dim>({at<Dim>(0.05, 0.35), at<Dim>(0.95, 0.35)});
  StandingColumns<Dim> columns;

  for (const double surface : {0.3, 0.2, 0.1, 0.0}) {
    build_columns<Dim>(columns, flat_ground<Dim>(), snow, &cover, d, h);
    CHECK(columns.columns[0].bed == Approx(surface));
    CHECK(columns.columns[1].bed == 0);
    CHECK(columns.standing(columns.columns[0]).size() == (0.3 - surface < 0.21 ? 1u : 0u));
    if (surface == 0) break;
    std::size_t top = 0;
    while (std::abs(cover.particles.position[top][Dim - 1] - (surface - d / 2)) > 1e-9) ++top;
    remove_from_cover(cover, top);
    remove_from_cover(cover, top);
  }
  CHECK(cover.n_dead == 3);
  CHECK(compact_cover(cover));
  CHECK(cover.particles.empty());
  CHECK(cover.surface({}) == 0);
  CHECK_FALSE(compact_cover(cover));
}

TEMPLATE_TEST_CASE_SIG("Compaction keeps order and neighbours of the live slots", "[columns]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain({{0, 0}, {60, -36}});
  Cover<Dim> cover = sample_cover<Dim>(terrain, {.to = 5, .y = {0, 1}, .depth = 0.5}, {.spacing = d, .density = 100});
  std::vector<std::uint64_t> live;
  for (std::size_t i = 0; i < cover.particles.size(); ++i) {
    cover.hazard[i] = static_cast<double>(cover.particles.id[i]);
    if (i % 3 == 0)
      remove_from_cover(cover, i);
    else
      live.push_back(cover.particles.id[i]);
  }
  GroundBin<Dim> bin{};
  bin[0] = 3;
  const double surface = cover.surface(bin);
  REQUIRE(compact_cover(cover));
  CHECK(cover.n_dead == 0);
  CHECK(cover.particles.id == live);
  CHECK(cover.surface(bin) == surface);
  CHECK(cover.members.size() == live.size());
  CHECK(cover.cells.n_particles() == live.size());
  for (std::size_t i = 0; i < live.size(); ++i) {
    REQUIRE(cover.hazard[i] == static_cast<double>(live[i]));
    REQUIRE((terrain.position(cover.foot[i].place, cover.foot[i].distance) - cover.particles.position[i]).norm() <
            1e-9);
  }
}

TEMPLATE_TEST_CASE_SIG("Columns stand hostile snow, use no memory for empty ground, and allocate once", "[columns]",
                       ((int Dim), Dim), 2, 3) {
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, flat_ground<Dim>(), Particles<Dim>{}, nullptr, d, h);
  CHECK(columns.columns.empty());
  CHECK(columns.find({}) == nullptr);

  Particles<Dim> snow =
      particles_at<Dim>({at<Dim>(0.05, 0.05), at<Dim>(0.05, 0.05), at<Dim>(0.05, 0.05), at<Dim>(0.05, 0.05)});
  snow.position[0][0] = std::numeric_limits<double>::quiet_NaN();
  snow.position[1][0] = 1e300;
  snow.position[2][Dim - 1] = -5;
  build_columns<Dim>(columns, flat_ground<Dim>(), snow, nullptr, d, h);
  CHECK(columns.members.size() == 4);
  const Column<Dim>& column = columns.columns[columns.column[3]];
  CHECK(columns.column[0] == columns.column[3]);
  CHECK(columns.over_bin(column).back() == 0);
  CHECK(columns.standing(column).size() == columns.over_bin(column).size() - 1);

  snow = particles_at<Dim>({at<Dim>(-1e6, 0.05), at<Dim>(1e6, 0.05)});
  StandingColumns<Dim> sparse;
  build_columns<Dim>(sparse, flat_ground<Dim>(), snow, nullptr, d, h);
  CHECK(sparse.columns.size() == 2);
  CHECK(sparse.bytes() < 4096);
  const std::size_t warm = sparse.bytes();
  build_columns<Dim>(sparse, flat_ground<Dim>(), snow, nullptr, d, h);
  CHECK(sparse.bytes() == warm);
}

TEMPLATE_TEST_CASE_SIG("Columns do not depend on the number of threads or the order of the particles", "[columns]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain({{0, 0}, {20, -12}, {60, -20}});
  const Cover<Dim> source =
      sample_cover<Dim>(terrain, {.to = 40, .y = {0, 2}, .depth = 0.5}, {.spacing = d, .density = 300});
  Particles<Dim> snow = source.particles;
  StandingColumns<Dim> columns, again;
  build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    build_columns<Dim>(again, terrain, snow, nullptr, d, h);
    CHECK(again.members == columns.members);
  }
  snow.for_each_array([](auto& array) { std::reverse(array.begin(), array.end()); });
  build_columns<Dim>(again, terrain, snow, nullptr, d, h);
  REQUIRE(again.columns.size() == columns.columns.size());
  for (const Column<Dim>& c : columns.columns) {
    const Column<Dim>* same = again.find(c.bin);
    REQUIRE(same != nullptr);
    CHECK(same->mass_per_area == c.mass_per_area);
    CHECK(same->thickness == c.thickness);
  }
}
