// Which snow is taken.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/parallel.hpp"
#include "resting_snow.hpp"

using namespace spindrift;

TEMPLATE_TEST_CASE_SIG("Only exposed cover in contact with moving snow is taken", "[entrainment]", ((int Dim), Dim), 2,
                       3) {
  const Terrain<Dim> terrain = incline<Dim>(0.6);
  const std::vector<Vec<Dim>> layer{place<Dim>(0.05, 0.05), place<Dim>(0.05, 0.15), place<Dim>(0.17, 0.05)};
  const EntrainmentOptions options{.threshold = always};
  SnowKind<Dim> kind{.spacing = d, .first_id = 100};
  kind.velocity[0] = 5;

  SECTION("the two with nothing above them, in the order of their ids, at rest") {
    Cover<Dim> cover = cover_at<Dim>(terrain, layer, 0.2);
    const Particles<Dim> snow = particles_at<Dim>(terrain, {place<Dim>(0.12, 0.18)}, kind);
    const Particles<Dim> taken = take<Dim>(options, cover, terrain, snow, for_ever);
    REQUIRE(taken.id == std::vector<std::uint64_t>{1, 2});
    for (std::size_t i = 0; i < 2; ++i) {
      CHECK(taken.velocity[i] == Vec<Dim>::Zero());
      CHECK(taken.entrained_at[i] == 3);
      CHECK(taken.mass[i] == Approx(100 * std::pow(d, Dim)));
      CHECK(taken.volume[i] == Approx(std::pow(d, Dim)));
    }
    CHECK(cover.particles.id == std::vector<std::uint64_t>{0});
  }
  SECTION("the next layer once it is exposed") {
    Cover<Dim> cover = cover_at<Dim>(terrain, layer, 0.2);
    remove_from_cover(cover,
                      static_cast<std::size_t>(std::find(cover.particles.id.begin(), cover.particles.id.end(), 1u) -
                                               cover.particles.id.begin()));
    const Particles<Dim> snow = particles_at<Dim>(terrain, {place<Dim>(0.12, 0.15)}, kind);
    CHECK(take<Dim>(options, cover, terrain, snow, for_ever).id == std::vector<std::uint64_t>{0, 2});
    CHECK(cover.particles.empty());
  }
  SECTION("by the literal rule every one that fails") {
    Cover<Dim> cover = cover_at<Dim>(terrain, layer, 0.2);
    const Particles<Dim> snow = particles_at<Dim>(terrain, {place<Dim>(0.12, 0.15)}, kind);
    EntrainmentOptions literal = options;
    literal.rule = EntrainmentRule::bernoulli;
    CHECK(take<Dim>(literal, cover, terrain, snow, for_ever).size() == 3);
  }
  SECTION("nothing without snow, out of reach, or under snow at rest") {
    Cover<Dim> cover = cover_at<Dim>(terrain, layer, 0.2);
    CHECK(take<Dim>(options, cover, terrain, {}, for_ever).empty());
    CHECK(take<Dim>(options, cover, terrain, particles_at<Dim>(terrain, {place<Dim>(0.05, 0.31)}, kind), for_ever)
              .empty());
    CHECK(
        take<Dim>(options, cover, terrain, particles_at<Dim>(terrain, {place<Dim>(0.05, 3)}, kind), for_ever).empty());
    kind.velocity.setZero();
    CHECK(take<Dim>(options, cover, terrain, particles_at<Dim>(terrain, {place<Dim>(0.12, 0.18)}, kind), for_ever)
              .empty());
    for (const double hazard : cover.hazard) CHECK(hazard == 0);
  }
  SECTION("nor under a column that jitters, whose momentum is zero") {
    Cover<Dim> cover = cover_at<Dim>(terrain, layer, 0.2);
    Particles<Dim> snow = particles_at<Dim>(terrain, {place<Dim>(0.12, 0.18), place<Dim>(0.12, 0.22)}, kind);
    snow.velocity[1] = -snow.velocity[0];
    CHECK(take<Dim>(options, cover, terrain, snow, for_ever).empty());
    snow.velocity[1].setZero();
    CHECK(take<Dim>(options, cover, terrain, snow, for_ever).size() == 2);
  }
  SECTION("no cover at all") {
    Cover<Dim> cover = cover_at<Dim>(terrain, {}, 0.2);
    CHECK(take<Dim>(options, cover, terrain, particles_at<Dim>(terrain, {place<Dim>(0.05, 0.05)}, kind), for_ever)
              .empty());
  }
}

TEMPLATE_TEST_CASE_SIG("A cover particle fails when Eq. (14) passes its own depth's threshold", "[entrainment]",
                       ((int Dim), Dim), 2, 3) {
  const double angle = 40 * M_PI / 180;
  const Terrain<Dim> terrain = incline<Dim>(angle);
  std::vector<Vec<Dim>> pile;
  for (int k = 0; k < 10; ++k) pile.push_back(place<Dim>(0.1, 0.2 + 0.1 * k));
  SnowKind<Dim> kind{.spacing = d, .first_id = 100};
  kind.velocity[0] = 5;
  const Particles<Dim> snow = particles_at<Dim>(terrain, pile, kind);
  const double mass_per_area = 10 * 300 * std::pow(d, Dim) / ground_bin_area<Dim>(2 * d);
  const double normal = mass_per_area * g * std::sin(angle) / cover_viscosity(100);
  const double vertical = normal / std::cos(angle);
  const double traction = 700;

  // A particle at half depth of a cover of 0.2 m: gamma_0 = sqrt(surface base) = 10 surface.
  const auto fails = [&](double gamma_0, const EntrainmentOptions& options, double traction = 0) {
    EntrainmentOptions all = options;
    all.threshold = {gamma_0 / 10, gamma_0 * 10};
    Cover<Dim> cover = cover_at<Dim>(terrain, {place<Dim>(0.1, 0.1)}, 0.2);
    return !take<Dim>(all, cover, terrain, snow, for_ever, traction).empty();
  };
  CHECK(fails(0.999 * normal, {}));
  CHECK_FALSE(fails(1.001 * normal, {}));
  EntrainmentOptions fig8{.column = OverburdenColumn::vertical};
  CHECK(fails(0.999 * vertical, fig8));
  CHECK_FALSE(fails(1.001 * vertical, fig8));
  const double with_friction = normal + traction / cover_viscosity(100);
  CHECK(fails(0.999 * with_friction, {}, traction));
  CHECK_FALSE(fails(1.001 * with_friction, {}, traction));
  EntrainmentOptions frictionless{.friction_factor = 0};
  CHECK_FALSE(fails(1.001 * normal, frictionless, traction));
}

TEMPLATE_TEST_CASE_SIG("Cover fails under its own weight only where asked to", "[entrainment]", ((int Dim), Dim), 2,
                       3) {
  const double angle = 40 * M_PI / 180;
  const Terrain<Dim> terrain = incline<Dim>(angle);
  std::vector<Vec<Dim>> pile;
  for (int k = 0; k < 4; ++k) pile.push_back(place<Dim>(0.1, 0.05 + 0.1 * k));
  const double one = 100 * std::pow(d, Dim) / ground_bin_area<Dim>(2 * d) * g * std::sin(angle) / cover_viscosity(100);
  EntrainmentOptions options{.rule = EntrainmentRule::bernoulli, .threshold = {1.5 * one, 1.5 * one}};
  Cover<Dim> cover = cover_at<Dim>(terrain, pile, 0.4);
  CHECK(take<Dim>(options, cover, terrain, {}, for_ever).empty());
  options.spontaneous = true;
  CHECK(take<Dim>(options, cover, terrain, {}, for_ever).id == std::vector<std::uint64_t>{0, 1});
  CHECK(take<Dim>(options, cover, terrain, {}, for_ever).empty());
}

TEMPLATE_TEST_CASE_SIG("Entrainment is the same with any number of threads, and warm columns allocate nothing",
                       "[entrainment]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(0.6);
  const double length = Dim == 2 ? 50 : 8;
  const Cover<Dim> start =
      sample_cover<Dim>(terrain, {.to = length, .y = {0, 2}, .depth = 0.5}, {.spacing = d, .density = 100});
  const Particles<Dim> snow = sliding_on<Dim>(terrain, start, length, 2, d);
  std::vector<std::uint64_t> first;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Cover<Dim> cover = start;
    Entrainment<Dim> entrainment({.rate = 50, .threshold = always});
    StandingColumns<Dim> columns;
    std::vector<std::uint64_t> ids;
    std::size_t warm = 0;
    for (int step = 0; step < 20; ++step) {
      build_columns<Dim>(columns, terrain, snow, &cover, d, 2 * d);
      const Particles<Dim>& taken = entrainment.take(cover, snow, columns, down<Dim>(), {.dt = 1e-3});
      CHECK(std::is_sorted(taken.id.begin(), taken.id.end()));
      ids.insert(ids.end(), taken.id.begin(), taken.id.end());
      if (step == 10) warm = columns.bytes();
    }
    CHECK(columns.bytes() == warm);
    CHECK(ids.size() > 10);
    if (threads > 1) CHECK(ids == first);
    first = ids;
  }
}
