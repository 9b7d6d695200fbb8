#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <vector>

#include "core/parallel.hpp"
#include "sph/bed_friction.hpp"
#include "sph/sampling.hpp"
#include "sph/standing_columns.hpp"

using namespace spindrift;

namespace {

constexpr double g = 9.81, d = 0.1, h = 0.2;

template <int Dim>
Vec<Dim> down() {
  return -g * up<Dim>();
}

template <int Dim>
Terrain<Dim> incline(double angle) {
  return Terrain<Dim>({{0, 0}, {500, -500 * std::tan(angle)}});
}

/// A single row of snow at rest on the incline.
template <int Dim>
Particles<Dim> row(const Terrain<Dim>& terrain) {
  return sample_slab<Dim>(terrain, {.at = 1, .length = 1, .thickness = d, .y = {0, 0.5}}, {.spacing = d});
}

/// Gravity, friction, a rigid bed, motion; returns what the bed took from friction over all steps.
template <int Dim>
Vec<Dim> slide(Particles<Dim>& snow, const Terrain<Dim>& terrain, const BedFriction& friction, double dt, int steps) {
  StandingColumns<Dim> columns;
  Vec<Dim> impulse = Vec<Dim>::Zero();
  for (int step = 0; step < steps; ++step) {
    build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
    for (Vec<Dim>& v : snow.velocity) v += dt * down<Dim>();
    for (std::size_t i = 0; i < snow.size(); ++i) {
      const Vec<Dim>& n = columns.foot[i].normal;
      snow.velocity[i] -= std::min(0.0, snow.velocity[i].dot(n)) * n;
    }
    impulse += apply_column_friction<Dim>(snow, columns, friction, down<Dim>(), dt);
    for (std::size_t i = 0; i < snow.size(); ++i) snow.position[i] += dt * snow.velocity[i];
  }
  return impulse;
}

}  // namespace

TEST_CASE("Friction formula: hand-computed values, limits, never negative", "[friction]") {
  CHECK(slowed_by_bed(3, 1, 0) == 2);
  CHECK(slowed_by_bed(1, 3, 0) == 0);
  CHECK(slowed_by_bed(1, 3, 10) == 0);
  CHECK(slowed_by_bed(0, 0, 10) == 0);
  CHECK(slowed_by_bed(2, 0, 1) == Approx(1).epsilon(1e-15));  // 1 + 1 * 1^2 = 2
  CHECK(slowed_by_bed(7, 1, 0.5) == Approx(std::sqrt(13.0) - 1).epsilon(1e-14));
  const double speed = GENERATE(1e-300, 1e-9, 1.0, 1e9), turbulent = GENERATE(0.0, 1e-9, 1.0, 1e9);
  const double after = slowed_by_bed(speed, 0.1, turbulent);
  CHECK(after >= 0);
  CHECK(after <= speed);
  CHECK(after + turbulent * after * after == Approx(std::max(0.0, speed - 0.1)).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("A11: a Coulomb block slides as g (sin - mu cos) t^2 / 2", "[friction]", ((int Dim), Dim), 2,
                       3) {
  const double angle = 24 * M_PI / 180, mu = std::tan(15 * M_PI / 180), dt = 1e-3;
  const Terrain<Dim> terrain = incline<Dim>(angle);
  Particles<Dim> snow = row<Dim>(terrain);
  const Vec<Dim> start = snow.position.front();
  const Vec<Dim> impulse = slide<Dim>(snow, terrain, {.mu = mu, .xi = 0}, dt, 5000);
  const double expected = 0.5 * g * (std::sin(angle) - mu * std::cos(angle)) * 25;
  CHECK((snow.position.front() - start).norm() == Approx(expected).epsilon(1e-3));
  for (const Vec<Dim>& v : snow.velocity) REQUIRE((v - snow.velocity.front()).norm() < 1e-9);

  double mass = 0;
  for (const double m : snow.mass) mass += m;
  CHECK(impulse.norm() == Approx(mass * mu * g * std::cos(angle) * 5).epsilon(1e-9));
  CHECK(impulse[0] > 0);
}

TEMPLATE_TEST_CASE_SIG("F1: friction goes with the normal part of gravity, to nothing at 90 degrees", "[friction]",
                       ((int Dim), Dim), 2, 3) {
  const double angle = GENERATE(0.0, 60.0, 89.0, 89.9) * M_PI / 180, mu = 0.4, dt = 1e-4;
  const Terrain<Dim> terrain = incline<Dim>(angle);
  Particles<Dim> snow = row<Dim>(terrain);
  const Vec<Dim> downhill = terrain.position(Vec<Dim - 1>::Unit(0), 0) - terrain.position(Vec<Dim - 1>::Zero(), 0);
  for (Vec<Dim>& v : snow.velocity) v = 3 * downhill;
  slide<Dim>(snow, terrain, {.mu = mu, .xi = 0}, dt, 10);
  const double gained = snow.velocity.front().dot(downhill) - 3;
  CHECK(gained == Approx(10 * dt * g * (std::sin(angle) - mu * std::cos(angle))).epsilon(1e-9));
}

TEMPLATE_TEST_CASE_SIG("A11: below its angle of friction snow at rest does not creep in 60 s", "[friction]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(14 * M_PI / 180);
  Particles<Dim> snow = row<Dim>(terrain);
  const std::vector<Vec<Dim>> start = snow.position;
  slide<Dim>(snow, terrain, {.mu = std::tan(15 * M_PI / 180), .xi = GENERATE(0.0, 4000.0)}, 0.01, 6000);
  double drift = 0;
  for (std::size_t i = 0; i < snow.size(); ++i) drift = std::max(drift, (snow.position[i] - start[i]).norm());
  CHECK(drift < 1e-10);
}

TEMPLATE_TEST_CASE_SIG("Moving snow stops and stays, never reversed, at any dt", "[friction]", ((int Dim), Dim), 2, 3) {
  const double dt = GENERATE(1e-3, 0.1, 10.0);
  const Terrain<Dim> terrain = incline<Dim>(5 * M_PI / 180);
  Particles<Dim> snow = row<Dim>(terrain);
  const Vec<Dim> downhill = terrain.position(Vec<Dim - 1>::Unit(0), 0) - terrain.position(Vec<Dim - 1>::Zero(), 0);
  for (Vec<Dim>& v : snow.velocity) v = 3 * downhill;
  const double rounding = 1e-13;
  double last = 3;
  for (int step = 0; step < 4000 && last > rounding; ++step) {
    slide<Dim>(snow, terrain, {.mu = 0.3, .xi = 1000}, dt, 1);
    for (const Vec<Dim>& v : snow.velocity) REQUIRE(v.dot(downhill) >= -rounding);
    REQUIRE(snow.velocity[0].dot(downhill) < last);
    last = snow.velocity[0].dot(downhill);
  }
  CHECK(last <= rounding);
}

TEMPLATE_TEST_CASE_SIG("A17: Voellmy terminal speed to 1e-6 at any dt", "[friction]", ((int Dim), Dim), 2, 3) {
  const double dt = GENERATE(1e-3, 0.02, 1.0, 100.0), xi = GENERATE(1120.0, 4000.0);
  const double angle = 30 * M_PI / 180, mu = 0.155;
  const Terrain<Dim> terrain = incline<Dim>(angle);
  Particles<Dim> snow =
      sample_slab<Dim>(terrain, {.at = 100, .length = 0.2, .thickness = 1, .y = {0, 0.2}}, {.spacing = d});
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
  REQUIRE(columns.columns.size() == 1);
  const Vec<Dim> normal = columns.foot[0].normal;
  const Vec<Dim> along = down<Dim>() - down<Dim>().dot(normal) * normal;
  for (int step = 0; step < 20 + 150 / dt; ++step) {
    for (Vec<Dim>& v : snow.velocity) v += dt * along;
    apply_column_friction<Dim>(snow, columns, {.mu = mu, .xi = xi}, down<Dim>(), dt);
  }
  const double terminal = std::sqrt(xi * (std::sin(angle) - mu * std::cos(angle)));
  CHECK(terminal == Approx(xi == 4000 ? 38.3 : 20.2).epsilon(2e-3));
  for (const Vec<Dim>& v : snow.velocity) CHECK(v.norm() == Approx(terminal).epsilon(1e-6));
}

TEMPLATE_TEST_CASE_SIG("Airborne snow, cliff faces and overhangs feel no friction", "[friction]", ((int Dim), Dim), 2,
                       3) {
  const Terrain<Dim> terrain({{0, 0}, {10, 0}, {10, -20}, {40, -20}});
  Particles<Dim> snow = row<Dim>(incline<Dim>(0));
  snow.resize(3);
  for (Vec<Dim>& x : snow.position) x.setConstant(0.05);
  snow.position[0][0] = 5, snow.position[0][Dim - 1] = 0.4;      // 0.35 m of air
  snow.position[1][0] = 10.05, snow.position[1][Dim - 1] = -10;  // beside the face
  snow.position[2][0] = 5, snow.position[2][Dim - 1] = 0.05;     // on the ground
  for (Vec<Dim>& v : snow.velocity) v.setConstant(-2);
  const std::vector<Vec<Dim>> before = snow.velocity;
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
  apply_column_friction<Dim>(snow, columns, {}, down<Dim>(), 0.01);
  CHECK(snow.velocity[0] == before[0]);
  CHECK(snow.velocity[1] == before[1]);
  CHECK(snow.velocity[2].norm() < before[2].norm());
  CHECK(snow.velocity[2][Dim - 1] == Approx(-2).epsilon(1e-14));

  const std::vector<Vec<Dim>> slowed = snow.velocity;
  CHECK(apply_column_friction<Dim>(snow, columns, {}, Vec<Dim>::Zero(), 0.01) == Vec<Dim>::Zero());
  CHECK(apply_column_friction<Dim>(snow, columns, {}, Vec<Dim>(-down<Dim>()), 0.01) == Vec<Dim>::Zero());
  CHECK(snow.velocity == slowed);
}

TEMPLATE_TEST_CASE_SIG("Friction of the base acts on the basal row, with the solver's normal impulse", "[friction]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain = incline<Dim>(0);
  Particles<Dim> snow =
      sample_slab<Dim>(terrain, {.at = 1, .length = 0.4, .thickness = 0.3, .y = {0, 0.2}}, {.spacing = d});
  for (Vec<Dim>& v : snow.velocity) v[0] = 4;
  std::vector<double> normal_impulse(snow.size(), 0);
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
  const double m = snow.mass[0], dt = 0.05;
  for (std::size_t i = 0; i < snow.size(); ++i)
    if (columns.foot[i].distance < d) normal_impulse[i] = 3 * m * g * dt;

  const Vec<Dim> impulse =
      apply_base_friction<Dim>(snow, columns, {.mu = 0.2, .xi = 0}, down<Dim>(), normal_impulse, dt);
  double lost = 0;
  for (std::size_t i = 0; i < snow.size(); ++i) {
    const bool basal = columns.foot[i].distance < d;
    CHECK(snow.velocity[i][0] == Approx(basal ? 4 - 0.2 * 3 * g * dt : 4));
    lost += m * (4 - snow.velocity[i][0]);
  }
  CHECK(impulse[0] == Approx(lost).epsilon(1e-12));
  // A rigid slab of the same weight loses as much in all by the depth-averaged law.
  CHECK(lost == Approx(static_cast<double>(snow.size()) * m * 0.2 * g * dt).epsilon(1e-12));

  for (Vec<Dim>& v : snow.velocity) v = 4 * Vec<Dim>::Unit(0);
  std::fill(normal_impulse.begin(), normal_impulse.end(), 0);
  apply_base_friction<Dim>(snow, columns, {.mu = 0.2, .xi = 1000}, down<Dim>(), normal_impulse, dt);
  for (std::size_t i = 0; i < snow.size(); ++i)
    CHECK(snow.velocity[i][0] ==
          Approx(columns.foot[i].distance < d ? slowed_by_bed(4, 0, g * dt / (1000 * d)) : 4).epsilon(1e-12));
}

TEMPLATE_TEST_CASE_SIG("The impulse that a column gives its bed is its traction, and noise cancels in it", "[friction]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain({{0, 0}, {20, 0}});
  const BedFriction friction{.mu = 0.2, .xi = 1000};
  Particles<Dim> snow =
      sample_cover<Dim>(terrain, {.from = 4, .to = 8, .y = {0, 2}, .depth = 0.5}, {.spacing = d, .density = 300})
          .particles;
  for (Vec<Dim>& v : snow.velocity) v[0] = 20, v[Dim - 1] = -7;
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
  const double dt = 1e-7;
  apply_column_friction<Dim>(snow, columns, friction, down<Dim>(), dt);
  for (const Column<Dim>& column : columns.columns) {
    // tau_f = mu W g + (W / h_flow) g v^2 / xi
    const double w = column.mass_per_area;
    CHECK(column.friction.norm() / (column.area * dt) ==
          Approx(0.2 * w * g + w / column.thickness * g * 400 / 1000).epsilon(1e-6));
    CHECK(column.friction[0] > 0);
  }
  // To and fro by turns: every second particle the other way.
  for (const Column<Dim>& column : columns.columns) {
    const auto standing = columns.standing(column);
    for (std::size_t k = 0; k < standing.size(); ++k) snow.velocity[standing[k]][0] = k % 2 == 0 ? 20 : -20;
  }
  apply_column_friction<Dim>(snow, columns, friction, down<Dim>(), dt);
  for (const Column<Dim>& column : columns.columns) {
    const auto n = columns.standing(column).size();
    const double share = static_cast<double>(n % 2) / static_cast<double>(n);
    const double sliding = column.mass_per_area * (0.2 * g + g * 400 / 1000 / column.thickness);
    CHECK(column.friction.norm() / (column.area * dt) <= (share + 1e-6) * sliding);
  }
}

TEMPLATE_TEST_CASE_SIG("What the snow loses is what the bed gets, the same with any number of threads", "[friction]",
                       ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> terrain({{0, 0}, {20, -12}, {60, -20}});
  const Particles<Dim> start =
      sample_cover<Dim>(terrain, {.to = 40, .y = {0, 2}, .depth = 0.5}, {.spacing = d, .density = 300}).particles;
  Vec<Dim> first = Vec<Dim>::Zero();
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Particles<Dim> snow = start;
    for (std::size_t i = 0; i < snow.size(); ++i) snow.velocity[i][0] = 3 + std::sin(static_cast<double>(i));
    Vec<Dim> before = Vec<Dim>::Zero(), after = Vec<Dim>::Zero();
    for (std::size_t i = 0; i < snow.size(); ++i) before += snow.mass[i] * snow.velocity[i];
    StandingColumns<Dim> columns;
    build_columns<Dim>(columns, terrain, snow, nullptr, d, h);
    const Vec<Dim> impulse = apply_column_friction<Dim>(snow, columns, {}, down<Dim>(), 0.01);
    for (std::size_t i = 0; i < snow.size(); ++i) after += snow.mass[i] * snow.velocity[i];
    CHECK((before - after - impulse).norm() < 1e-12 * before.norm());
    if (threads > 1) CHECK(impulse == first);
    first = impulse;
  }
}
