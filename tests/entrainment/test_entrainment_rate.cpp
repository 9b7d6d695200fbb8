// How much snow is taken: the share that is left over time, and the flux per area of ground.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "core/random.hpp"
#include "resting_snow.hpp"
#include "sph/bed_friction.hpp"

using namespace spindrift;

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
