#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "core/parallel.hpp"
#include "core/random.hpp"
#include "entrainment/entrainment.hpp"
#include "sph/bed_friction.hpp"
#include "sph/sampling.hpp"
#include "sph/standing_columns.hpp"

using namespace spindrift;

namespace {

constexpr double g = 9.81, d = 0.1;
constexpr FailureThreshold always{1e-30, 1e-30};

template <int Dim>
Vec<Dim> down() {
  return -g * up<Dim>();
}

template <int Dim>
Terrain<Dim> incline(double angle) {
  return Terrain<Dim>({{0, 0}, {500, -500 * std::tan(angle)}});
}

/// One particle of `kind` at each place (arc length[, y], normal distance).
template <int Dim>
Particles<Dim> particles_at(const Terrain<Dim>& terrain, const std::vector<Vec<Dim>>& places, SnowKind<Dim> kind) {
  Particles<Dim> all;
  for (const Vec<Dim>& place : places) {
    const Vec<Dim> x = terrain.position(Vec<Dim - 1>(place.template head<Dim - 1>()), place[Dim - 1]);
    const double half = kind.spacing / 2;
    all.push_back_from(sample_box<Dim>({x.array() - half, x.array() + half}, kind), 0);
    ++kind.first_id;
  }
  return all;
}

template <int Dim>
Cover<Dim> cover_at(const Terrain<Dim>& terrain, const std::vector<Vec<Dim>>& places, double thickness) {
  Cover<Dim> cover;
  cover.spacing = d;
  cover.density = 100;
  cover.thickness = thickness;
  cover.particles = particles_at<Dim>(terrain, places, {.spacing = d, .density = 100});
  for (const Vec<Dim>& x : cover.particles.position) cover.foot.push_back(terrain.foot(x));
  cover.hazard.assign(cover.particles.size(), 0);
  index_cover(cover);
  return cover;
}

/// A row of snow, `spacing` apart, that slides at 5 m/s on the cover, or on the ground where none is left.
template <int Dim>
Particles<Dim> sliding_on(const Terrain<Dim>& terrain, const Cover<Dim>& cover, double length, double breadth,
                          double spacing) {
  Particles<Dim> snow = sample_slab<Dim>(terrain, {.length = length, .thickness = spacing, .y = {0, breadth}},
                                         {.spacing = spacing, .density = 300, .first_id = 1u << 30});
  for (std::size_t i = 0; i < snow.size(); ++i) {
    const Foot<Dim> foot = terrain.foot(snow.position[i]);
    const double surface = cover.surface(ground_bin<Dim>(foot.place, 2 * spacing));
    snow.position[i] = terrain.position(foot.place, surface + spacing / 2);
    snow.velocity[i].setConstant(5);
  }
  return snow;
}

template <int Dim>
Vec<Dim> place(double s, double distance) {
  Vec<Dim> p = Vec<Dim>::Constant(0.05);
  p[0] = s, p[Dim - 1] = distance;
  return p;
}

template <int Dim>
Particles<Dim> take(const EntrainmentOptions& options, Cover<Dim>& cover, const Terrain<Dim>& terrain,
                    const Particles<Dim>& snow, double dt, double traction = 0) {
  Entrainment<Dim> entrainment(options);
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, &cover, cover.spacing, 2 * cover.spacing);
  for (Column<Dim>& column : columns.columns) column.friction[0] = -traction * column.area * dt;
  return entrainment.take(cover, snow, columns, down<Dim>(), {.time = 3, .dt = dt});
}

constexpr double for_ever = 1e12;  ///< [s], at which every candidate goes

}  // namespace

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

TEMPLATE_TEST_CASE_SIG("D1: the share that is left is exp(-lambda t) at any dt, and the same particles go",
                       "[entrainment]", ((int Dim), Dim), 2, 3) {
  const double dt = GENERATE(1e-3, 0.01, 0.1, 1.0), lambda = 0.785, time = 2;
  const int n = dt < 5e-3 ? 400 : 4000;
  const Terrain<Dim> terrain = incline<Dim>(0.6);
  std::vector<Vec<Dim>> places;
  for (int k = 0; k < n; ++k) places.push_back(place<Dim>((k + 0.5) * 2 * d, d / 2));
  Cover<Dim> cover = cover_at<Dim>(terrain, places, d);
  for (Vec<Dim>& p : places) p[Dim - 1] += d;
  SnowKind<Dim> kind{.spacing = d, .first_id = 1u << 30};
  kind.velocity[0] = 5;
  const Particles<Dim> snow = particles_at<Dim>(terrain, places, kind);
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, &cover, d, 2 * d);

  const double m = 100 * std::pow(d, Dim);
  Entrainment<Dim> entrainment({.rate = lambda * m / ground_bin_area<Dim>(2 * d), .threshold = always});
  int taken = 0, expected = 0;
  double mass = 0;
  for (int step = 0; step < std::lround(time / dt); ++step) {
    taken += static_cast<int>(
        entrainment.take(cover, snow, columns, down<Dim>(), {.time = step * dt, .dt = dt, .seed = 9}).size());
    mass += entrainment.mass_taken();
  }
  for (int k = 0; k < n; ++k)
    expected += exponential(9, RandomStream::entrainment_clock, static_cast<std::uint64_t>(k)) <= lambda * time;
  CHECK(taken == expected);
  CHECK(mass == Approx(taken * m).epsilon(1e-12));
  const double left = std::exp(-lambda * time);
  CHECK(std::abs((n - taken) - n * left) < 4 * std::sqrt(n * left * (1 - left)));
}

TEMPLATE_TEST_CASE_SIG("D1: Eq. (16) literally depends on dt as (1 - P)^n", "[entrainment]", ((int Dim), Dim), 2, 3) {
  const double dt = GENERATE(1.0, 0.1, 0.01), per_second = 0.785;
  const int n = 2000, steps = static_cast<int>(std::lround(2 / dt));
  const Terrain<Dim> terrain = incline<Dim>(0.6);
  std::vector<Vec<Dim>> places;
  for (int k = 0; k < n; ++k) places.push_back(place<Dim>((k + 0.5) * 2 * d, d / 2));
  Cover<Dim> cover = cover_at<Dim>(terrain, places, d);
  for (Vec<Dim>& p : places) p[Dim - 1] += d;
  SnowKind<Dim> kind{.spacing = d};
  kind.velocity[0] = 5;
  const Particles<Dim> snow = particles_at<Dim>(terrain, places, kind);
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, &cover, d, 2 * d);
  const double section = Dim == 2 ? d : std::numbers::pi * d * d / 4;
  Entrainment<Dim> entrainment(
      {.rule = EntrainmentRule::bernoulli, .rate = per_second * 100 * std::pow(d, Dim) / section, .threshold = always});
  std::size_t taken = 0;
  for (int step = 0; step < steps; ++step)
    taken += entrainment.take(cover, snow, columns, down<Dim>(), {.dt = dt, .number = static_cast<std::uint32_t>(step)})
                 .size();
  const double left = std::pow(1 - per_second * dt, steps);
  if (dt == 0.1) CHECK(left == Approx(0.1949).epsilon(1e-3));
  CHECK(std::abs(n - static_cast<double>(taken) - n * left) < 4 * std::sqrt(n * left * (1 - left)));
}

TEMPLATE_TEST_CASE_SIG("D2: the flux is Er whatever the spacing and the packing", "[entrainment][slow]",
                       ((int Dim), Dim), 2, 3) {
  const bool relaxed = GENERATE(true, false);
  const double spacing = relaxed ? GENERATE(0.05, 0.2) : 0.1;
  CAPTURE(spacing, relaxed);
  const Terrain<Dim> terrain = incline<Dim>(0.6);
  const double length = (Dim == 2 ? 4000 : 60) * spacing, breadth = Dim == 2 ? 1 : 40 * spacing;
  const double depth = 8 * spacing, dt = 0.05 * spacing;
  Cover<Dim> cover = sample_cover<Dim>(terrain, {.to = length, .y = {0, breadth}, .depth = depth},
                                       {.spacing = spacing, .density = 100});
  if (!relaxed) {
    cover.particles = sample_slab<Dim>(terrain, {.length = length, .thickness = depth, .y = {0, breadth}},
                                       {.spacing = spacing, .density = 100});
    cover.foot.clear();
    for (const Vec<Dim>& x : cover.particles.position) cover.foot.push_back(terrain.foot(x));
    cover.hazard.assign(cover.particles.size(), 0);
    index_cover(cover);
  }
  const double rate = 10, time = 0.3 * depth * 100 / rate;
  const Cover<Dim> start = cover;
  constexpr int n_seeds = 3;
  double taken = 0, before = 0;
  for (const double m : start.particles.mass) before += m;
  for (std::uint64_t seed = 1; seed <= n_seeds; ++seed) {
    cover = start;
    Entrainment<Dim> entrainment({.rate = rate, .threshold = always});
    StandingColumns<Dim> columns;
    double of_seed = 0, left = 0;
    for (int step = 0; step < std::lround(time / dt); ++step) {
      const Particles<Dim> snow = sliding_on<Dim>(terrain, cover, length, breadth, spacing);
      build_columns<Dim>(columns, terrain, snow, &cover, spacing, 2 * spacing);
      entrainment.take(cover, snow, columns, down<Dim>(), {.dt = dt, .seed = seed});
      of_seed += entrainment.mass_taken();
    }
    for (const double m : cover.particles.mass) left += m;
    CHECK(of_seed + left == Approx(before).epsilon(1e-12));
    taken += of_seed / n_seeds;
  }
  const double expected = rate * length * (Dim == 3 ? breadth : 1) * time;
  const double standard_error = std::sqrt(100 * std::pow(spacing, Dim) / (n_seeds * expected));
  CAPTURE(taken / expected, standard_error);
  CHECK(std::abs(taken / expected - 1) < std::max(0.02, 2 * standard_error));
}

TEST_CASE("D2 on a height field: the flux is Er per area of ground, whatever the slope",
          "[entrainment][height_field]") {
  // Gravity alone does not strain the cover of level ground: the snow has to drag at it.
  const double slope = GENERATE(0.0, 0.8), spacing = 0.1, size = 6, depth = 0.8, dt = 0.01, rate = 10;
  HeightGrid grid{{-4, -4}, 1, {12, 12}, {}};
  for_each_index<2>(grid.points, [&](const Index<2>& i) { grid.z.push_back(-std::tan(slope) * i[0]); });
  const Terrain<3> terrain{HeightField(grid)};
  Cover<3> cover =
      sample_cover<3>(terrain, {.to = size, .y = {0, size}, .depth = depth}, {.spacing = spacing, .density = 100});
  Entrainment<3> entrainment({.rate = rate, .threshold = always, .spontaneous = GENERATE(false, true)});
  StandingColumns<3> columns;
  double taken = 0;
  const int steps = 200;
  for (int step = 0; step < steps; ++step) {
    Particles<3> snow;
    for (double x = spacing / 2; x < size; x += spacing)
      for (double y = spacing / 2; y < size; y += spacing) {
        const double surface = cover.surface(ground_bin<3>(Vec<2>(x, y), 2 * spacing));
        snow.id.push_back((1u << 30) + snow.id.size());
        snow.position.push_back(terrain.position({x, y}, surface + spacing / 2));
        snow.velocity.push_back(Vec<3>::Constant(5));
        snow.mass.push_back(0.3), snow.volume.push_back(1e-3), snow.pressure.push_back(0);
        snow.entrained_at.push_back(-1);
      }
    build_columns<3>(columns, terrain, snow, &cover, spacing, 2 * spacing);
    apply_column_friction<3>(snow, columns, {.mu = 0.2, .xi = 0}, down<3>(), dt);
    entrainment.take(cover, snow, columns, down<3>(), {.dt = dt, .seed = 5});
    taken += entrainment.mass_taken();
  }
  CHECK(taken / (rate * size * size / std::cos(slope) * dt * steps) == Approx(1).epsilon(0.03));
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
