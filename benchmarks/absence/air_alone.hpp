#pragma once
/// The step of air and smoke, put together from src/grid: what it costs where nothing else was ever written.

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "absence/bits.hpp"
#include "core/parallel.hpp"
#include "grid/suspension.hpp"

namespace spindrift::absence {

struct AirAlone {
  static constexpr double max_step = 0.01, cfl = 1;
  static constexpr double fastest = 300;  ///< a speed above is a runaway [m s^-1]
  static constexpr int steps_between_copies = 16;

  Vec<2> gravity{0, -9.81};
  Suspension<2> air{
      {Vec<2>::Zero(), 0.5, {80, 48}}, {{{Side::open, Side::open}, {Side::closed, Side::open}}}, options()};
  SuspensionState<2> saved;  ///< to go back to from a step that fails
  int n_steps = 0;
  double time = 0;  ///< [s]
  double outflow = 0, deposited = 0;
  Vec<2> from_gravity{0, 0};  ///< impulse of the last step [kg m s^-1]
  SuspensionBudget<2> budget;
  Stages stages;

  static SuspensionOptions<2> options() {
    SuspensionOptions<2> options;
    options.settling_speed = 0.5;
    return options;
  }

  AirAlone() {
    const MacGrid<2>& grid = air.grid();
    Field<2> smoke(grid.cells);
    for (int j = 4; j < 16; ++j)
      for (int i = 20; i < 40; ++i) smoke[Index<2>{i, j}] = 3 * grid.cell_volume();
    air.set_smoke_mass(smoke);
  }

  void step() {
    const auto timed = stages.time("step");
    if (n_steps++ % steps_between_copies == 0) air.save(saved);
    const double way = cfl * air.grid().dx, speed = air.max_speed();
    double dt = max_step;
    if (speed > 0) dt = std::min(dt, way / speed);
    dt = std::min(dt, std::sqrt(way / gravity.norm()));
    from_gravity = air.add_gravity(dt);
    air.advance(dt, {}, stages);
    budget = air.budget();
    outflow += budget.outflow;
    deposited += budget.deposited;
    time += dt;
    check();
  }

  /// As the simulation's check of air and smoke (state_check.hpp): a step that does not look at its result costs less.
  void check() const {
    const Field<2>& smoke = air.smoke_mass();
    const double total = parallel_sum(smoke.size(), 0.0, [&](std::size_t cell) {
      return smoke[cell] >= 0 ? smoke[cell] : std::numeric_limits<double>::quiet_NaN();
    });
    if (!(air.max_speed() <= fastest && std::isfinite(total))) throw std::runtime_error("unstable");
  }
};

inline std::uint64_t bits_of(const Suspension<2>& air) {
  std::uint64_t hash = bits_of(std::span<const double>{});
  for (const auto& u : air.velocity()) hash = bits_of(u.values(), hash);
  hash = bits_of(air.smoke_mass().values(), hash);
  const Field<2> pressure = air.pressure();
  return bits_of(pressure.values(), hash);
}

}  // namespace spindrift::absence
