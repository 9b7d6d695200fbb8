#include <catch2/catch.hpp>
#include <cmath>

#include "entrainment/shared_traction.hpp"
#include "sph/bed_friction.hpp"
#include "sph/sampling.hpp"
#include "sph/standing_columns.hpp"

using namespace spindrift;

namespace {

constexpr double g = 9.81, d = 0.1, dt = 0.002;
constexpr BedFriction friction{.mu = 0.2, .xi = 1000};

template <int Dim>
Terrain<Dim> level() {
  return Terrain<Dim>({{0, 0}, {100, 0}});
}

/// A slab three particles thick at `speed` along x, and its columns.
template <int Dim>
struct Slide {
  Particles<Dim> snow;
  StandingColumns<Dim> columns;
  std::vector<BedFlux<Dim>> fluxes;

  Slide(double speed, double flux) {
    SnowKind<Dim> kind{.spacing = d};
    kind.velocity = speed * Vec<Dim>::Unit(0);
    snow = sample_slab<Dim>(level<Dim>(), {.at = 1, .length = 0.4, .thickness = 0.3, .y = {0, 0.4}}, kind);
    build_columns<Dim>(columns, level<Dim>(), snow, nullptr, d, 2 * d);
    for (const Column<Dim>& column : columns.columns) fluxes.push_back({column.bin, flux});
  }
  Vec<Dim> rub() { return apply_column_friction<Dim>(snow, columns, friction, Vec<Dim>(-g * up<Dim>()), dt); }
  Vec<Dim> share() { return share_traction<Dim>(snow, columns, fluxes, dt); }
  Vec<Dim> momentum() const {
    Vec<Dim> sum = Vec<Dim>::Zero();
    for (std::size_t i = 0; i < snow.size(); ++i) sum += snow.mass[i] * snow.velocity[i];
    return sum;
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("What is given back is E v A dt, along the friction", "[entrainment]", ((int Dim), Dim), 2, 3) {
  Slide<Dim> slide(8, 10);
  const Vec<Dim> taken = slide.rub(), before = slide.momentum(), given = slide.share();
  const double area = Dim == 2 ? 0.4 : 0.16;
  CHECK(given[0] == Approx(10 * 8 * area * dt));
  CHECK(given[0] < taken[0]);
  CHECK((slide.momentum() - before - given).norm() < 1e-12 * before.norm());
}

TEMPLATE_TEST_CASE_SIG("No more is given back than friction took", "[entrainment]", ((int Dim), Dim), 2, 3) {
  const double speed = GENERATE(0.0, 0.003, 2.0), flux = GENERATE(0.0, 1e-3, 1e6);
  Slide<Dim> slide(speed, flux);
  const Vec<Dim> before = slide.momentum(), taken = slide.rub(), given = slide.share();
  CHECK(given.norm() <= taken.norm() * (1 + 1e-12));
  CHECK(slide.momentum()[0] >= 0);
  CHECK(slide.momentum()[0] <= before[0] * (1 + 1e-12));
  if (flux == 1e6 && speed > 0) CHECK((slide.momentum() - before).norm() < 1e-12 * before.norm());
}

TEMPLATE_TEST_CASE_SIG("Without friction, or over a bed that holds, nothing is given back", "[entrainment]",
                       ((int Dim), Dim), 2, 3) {
  Slide<Dim> slide(8, 10);
  CHECK(slide.share() == Vec<Dim>::Zero());
  slide.rub();
  slide.fluxes.clear();
  CHECK(slide.share() == Vec<Dim>::Zero());
  slide.fluxes.push_back({.bin = {}, .flux = 10});  // no column there
  CHECK(slide.share() == Vec<Dim>::Zero());
}

TEMPLATE_TEST_CASE_SIG("Snow that joins slows the flow only once", "[entrainment]", ((int Dim), Dim), 2, 3) {
  // d(M v)/dt = -(tau - E v) A with dM/dt = E A is M dv/dt = -tau A: as fast as over a bed that holds.
  const double flux = 10, speed = 8;
  Slide<Dim> eroding(speed, flux), holding(speed, 0);
  eroding.rub(), eroding.share(), holding.rub();
  const double area = Dim == 2 ? 0.4 : 0.16;
  double mass = 0;
  for (const double m : eroding.snow.mass) mass += m;
  const double after = eroding.momentum()[0] / (mass + flux * area * dt);
  const double alone = holding.momentum()[0] / mass;
  CHECK(speed - alone > 1e-3);
  CHECK(std::abs(after - alone) < 1e-3 * (speed - alone));
}
