#include <algorithm>
#include <cmath>
#include <memory>

#include "verification/case_groups.hpp"
#include "verification/curve.hpp"
#include "verification/grid_series.hpp"

namespace spindrift {
namespace {

/// Where the smoke of the bottom row of cells falls below half of `density`, linear between cells [m].
double gas_front(const Suspension<2>& air, double density) {
  const int n = air.grid().cells[0];
  for (int i = n - 1; i > 0; --i) {
    const double here = air.smoke_density(static_cast<std::size_t>(i));
    const double left = air.smoke_density(static_cast<std::size_t>(i - 1));
    if (left >= density / 2 && here < density / 2)
      return air.grid().origin[0] + air.grid().dx * (i - 0.5 + (left - density / 2) / (left - here));
  }
  return 0;
}

/// Froude number of the front between one and three depths from the gate, against sqrt(delta (2 - delta)) / 2.
Comparison<2> compare_benjamin(const Simulation<2>& start) {
  const auto front = std::make_shared<Curve>();
  const SmokeSection smoke = start.scene().smoke[0];
  return {
      [front, smoke](const Simulation<2>& now) {
        front->push_back({gas_front(*now.suspension(), smoke.density), now.time()});
      },
      [front, smoke](const Simulation<2>& end) {
        const double depth = end.walls().domain.size()[1], gate = smoke.upper[0];
        const double delta = smoke.upper[1] / depth;
        const double reduced_gravity = 9.81 * smoke.density / (end.scene().suspension->air_density + smoke.density / 2);
        const double speed = 2 * depth / (interpolated(*front, gate + 3 * depth) - interpolated(*front, gate + depth));
        ErrorNorms froude;
        froude.add(speed / std::sqrt(reduced_gravity * depth), std::sqrt(delta * (2 - delta)) / 2);
        return Outcome{froude.l2(), froude.max(), {{"mass error", std::abs(end.mass_error()), 1e-12}}};
      }};
}

Case lock_exchange(std::string name, std::string depth, std::vector<std::string> settings) {
  Case what;
  what.name = std::move(name);
  what.title = "A heavy gas front in a channel, " + depth;
  what.reference = "front speed over sqrt(g' H) = sqrt(delta (2 - delta)) / 2";
  what.source = "Benjamin 1968, energy-conserving front; Shin, Dalziel and Linden 2004";
  what.quantity = "Froude number";
  what.scene = "heavy_gas_front.toml";
  const Series refined{"resolution",
                       "maccormack",
                       std::move(settings),
                       {cells_of(1.0 / 16, 0.12), cells_of(1.0 / 32, 0.08), cells_of(1.0 / 64, 0.05)}};
  what.series = air_series(refined, 1);
  what.compare = Compare<2>(compare_benjamin);
  return what;
}

/// The smoke against itself at the start, sum |difference| / sum: L1, which is what others give.
Comparison<2> compare_start(const Simulation<2>& start) {
  const Field<2> first = start.suspension()->smoke_mass();
  return {{}, [first](const Simulation<2>& end) {
            const Field<2>& smoke = end.suspension()->smoke_mass();
            double difference = 0, total = 0, largest = 0, peak = 0;
            for (std::size_t cell = 0; cell < smoke.size(); ++cell) {
              difference += std::abs(smoke[cell] - first[cell]);
              total += first[cell];
              largest = std::max(largest, std::abs(smoke[cell] - first[cell]));
              peak = std::max(peak, first[cell]);
            }
            return Outcome{difference / total, largest / peak, {{"mass error", std::abs(end.mass_error()), 1e-12}}};
          }};
}

Case slotted_disc() {
  Case what;
  what.name = "slotted_disc";
  what.title = "A slotted disc of smoke after a turn";
  what.reference = "the disc as it was, radius 15, slot 5 wide and 25 deep in a square of 100";
  what.source = "Zalesak 1979";
  what.quantity = "density, in L1";
  what.scene = "verification/slotted_disc.toml";
  const Series refined{"resolution",
                       "limited third-order fluxes",
                       {},
                       {cells_of(1.0 / 100, 0.5), cells_of(1.0 / 200, 0.33), cells_of(1.0 / 400, 0.21)}};
  what.series = {refined, over_values(refined, 0, "time step", "suspension.cfl", {"8", "4", "2", "1", "0.5", "0.25"})};
  what.compare = Compare<2>(compare_start);
  return what;
}

}  // namespace

std::vector<Case> smoke_cases() {
  Case full = lock_exchange("lock_exchange", "full depth", {"scene.max_step=1 s"});
  full.quick = true;
  Case half = lock_exchange("half_lock_exchange", "half depth", {"scene.max_step=1 s", "smoke[0].upper=[8, 0.5]"});
  return {full, half, slotted_disc()};
}

}  // namespace spindrift
