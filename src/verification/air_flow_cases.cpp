#include <cmath>
#include <memory>

#include "verification/case_groups.hpp"
#include "verification/curve.hpp"

namespace spindrift {
namespace {

/// u of the air along the vertical middle line at height z [m/s].
double u_on_middle_line(const Suspension<2>& air, double z) {
  const MacGrid<2>& grid = air.grid();
  const double k = z / grid.dx - 0.5;
  const int low = static_cast<int>(std::floor(k));
  const Field<2>& u = air.velocity()[0];
  const int middle = grid.cells[0] / 2;
  return u[Index<2>{middle, low}] + (k - low) * (u[Index<2>{middle, low + 1}] - u[Index<2>{middle, low}]);
}

Comparison<2> compare_ghia(const Simulation<2>&) {
  static const Curve u_of_z{{0.0547, -0.03717}, {0.0625, -0.04192}, {0.0703, -0.04775}, {0.1016, -0.06434},
                            {0.1719, -0.10150}, {0.2813, -0.15662}, {0.4531, -0.21090}, {0.5000, -0.20581},
                            {0.6172, -0.13641}, {0.7344, 0.00332},  {0.8516, 0.23151},  {0.9531, 0.68717}};
  return {{}, [](const Simulation<2>& end) {
            ErrorNorms u;
            for (const auto& [z, reference] : u_of_z) u.add(u_on_middle_line(*end.suspension(), z), reference);
            return Outcome{u.l2(), u.max(), {}};
          }};
}

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
  return {[front, smoke](const Simulation<2>& now) {
            front->push_back({gas_front(*now.suspension(), smoke.density), now.time()});
          },
          [front, smoke](const Simulation<2>& end) {
            const double depth = end.walls().domain.size()[1], gate = smoke.upper[0];
            const double delta = smoke.upper[1] / depth;
            const double reduced_gravity =
                9.81 * smoke.density / (end.scene().suspension->air_density + smoke.density / 2);
            const auto passed = [&](double place) {
              std::size_t i = 1;
              while (i + 1 < front->size() && (*front)[i][0] < place) ++i;
              const auto& [x0, t0] = (*front)[i - 1];
              const auto& [x1, t1] = (*front)[i];
              return t0 + (t1 - t0) * (place - x0) / (x1 - x0);
            };
            const double speed = 2 * depth / (passed(gate + 3 * depth) - passed(gate + depth));
            ErrorNorms froude;
            froude.add(speed / std::sqrt(reduced_gravity * depth), std::sqrt(delta * (2 - delta)) / 2);
            return Outcome{froude.l2(), froude.max(), {{"mass error", std::abs(end.mass_error()), 1e-12}}};
          }};
}

}  // namespace

std::vector<Case> air_flow_cases() {
  Case cavity;
  cavity.name = "cavity";
  cavity.title = "Air in a closed box under a sliding lid, Re = 100";
  cavity.reference = "u along the vertical middle line at 12 heights";
  cavity.source = "Ghia, Ghia and Shin 1982";
  cavity.quantity = "u on the middle line";
  cavity.scene = "lid_driven_box.toml";
  const Series refined{"resolution",
                       "maccormack",
                       {},
                       {{"16 cells", {"suspension.cell_size=0.0625"}, 1.0 / 16, 0.15},
                        {"32 cells", {"suspension.cell_size=0.03125"}, 1.0 / 32, 0.05},
                        {"64 cells", {"suspension.cell_size=0.015625"}, 1.0 / 64, 0.02}}};
  cavity.series = {refined, with_settings(refined, "scheme", "semi_lagrangian", {"suspension.scheme=semi_lagrangian"}),
                   with_settings(refined, "scheme", "reflection", {"suspension.scheme=reflection"}),
                   over_values(refined, 1, "tolerance", "suspension.tolerance", {"1e-2", "1e-3", "1e-4", "1e-6"}),
                   over_values(refined, 1, "time step", "suspension.cfl", {"4", "2", "1", "0.5"})};
  cavity.least_order = 1.5;
  cavity.quick = true;
  cavity.compare = Compare<2>(compare_ghia);

  Case full;
  full.name = "lock_exchange";
  full.title = "A heavy gas front in a channel, full depth";
  full.reference = "front speed over sqrt(g' H) = sqrt(delta (2 - delta)) / 2, delta = 1";
  full.source = "Benjamin 1968, energy-conserving front";
  full.quantity = "Froude number";
  full.scene = "heavy_gas_front.toml";
  const Series channel{"resolution",
                       "maccormack",
                       {},
                       {{"16 cells", {"suspension.cell_size=0.0625"}, 1.0 / 16, 0.12},
                        {"32 cells", {"suspension.cell_size=0.03125"}, 1.0 / 32, 0.08},
                        {"64 cells", {"suspension.cell_size=0.015625"}, 1.0 / 64, 0.05}}};
  full.series = {channel, with_settings(channel, "scheme", "semi_lagrangian", {"suspension.scheme=semi_lagrangian"}),
                 with_settings(channel, "scheme", "reflection", {"suspension.scheme=reflection"}),
                 over_values(channel, 1, "tolerance", "suspension.tolerance", {"1e-2", "1e-3", "1e-4", "1e-6"}),
                 over_values(channel, 1, "time step", "suspension.cfl", {"4", "2", "1", "0.5"})};
  full.quick = true;
  full.compare = Compare<2>(compare_benjamin);
  return {cavity, full};
}

}  // namespace spindrift
