#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include "verification/case_groups.hpp"
#include "verification/grid_series.hpp"

namespace spindrift {
namespace {

/// Mean acceleration since the start of what is smoke through and through, along gravity [m s^-2]. At its rim, where a
/// face's cells hold smoke and air, the air already flows the other way.
template <int Dim>
double acceleration_of_smoke(const Simulation<Dim>& end) {
  const Suspension<Dim>& air = *end.suspension();
  const double whole = 0.99 * end.scene().smoke[0].density * std::pow(air.grid().dx, Dim);
  Vec<Dim> acceleration = Vec<Dim>::Zero();
  for (int axis = 0; axis < Dim; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    double n = 0, sum = 0;
    for_each_index<Dim>(air.grid().cells, [&](const Index<Dim>& cell) {
      if (cell[k] == 0 || air.smoke_mass()[cell] < whole) return;
      if (air.smoke_mass()[shifted<Dim>(cell, axis, -1)] < whole) return;
      n += 1;
      sum += air.velocity()[k][cell];
    });
    acceleration[axis] = sum / n / end.time();
  }
  return acceleration.dot(end.gravity().normalized());
}

/// a_0 / g = r_s / (2 - r_s) in 2D, 2 r_s / (3 - r_s) in 3D, of a cylinder or ball with the added mass of the air.
template <int Dim>
Comparison<Dim> compare_added_mass(const Simulation<Dim>&) {
  return {{}, [](const Simulation<Dim>& end) {
            const double smoke = end.scene().smoke[0].density;
            const double share = smoke / (smoke + end.scene().suspension->air_density);
            ErrorNorms fall;
            fall.add(acceleration_of_smoke<Dim>(end) / end.gravity().norm(),
                     Dim == 2 ? share / (2 - share) : 2 * share / (3 - share));
            return Outcome{fall.l2(), fall.max(), {}};
          }};
}

/// A plane through the middle, and gravity along it: by symmetry the half above it falls as the whole does.
template <int Dim>
std::vector<std::string> halved(int degrees) {
  const double angle = degrees * std::numbers::pi / 180, fall = 40 * std::tan(angle);
  const double x = 9.81 * std::cos(angle), z = -9.81 * std::sin(angle);
  return {"terrain.shape=polyline", fmt::format("terrain.points=[[-40, {}], [40, {}]]", fall, -fall),
          Dim == 2 ? fmt::format("domain.gravity=[{}, {}]", x, z) : fmt::format("domain.gravity=[{}, 0, {}]", x, z)};
}

template <int Dim>
Case heavy_ball(std::string name, const Series& refined, const std::string& radii) {
  Case what;
  what.name = std::move(name);
  what.title = Dim == 2 ? "A heavy cylinder of smoke begins to fall" : "A heavy ball of smoke begins to fall";
  what.reference = Dim == 2 ? "a / g = r / (2 - r), r = rho_smoke / rho" : "a / g = 2 r / (3 - r), r = rho_smoke / rho";
  what.source = "potential flow: the added mass of a cylinder is that of its volume of air, of a sphere half of it";
  what.quantity = "first acceleration";
  what.scene = "verification/" + what.name + ".toml";
  const auto with_density = [](const char* density) { return fmt::format("smoke[0].density={}", density); };
  what.series = {refined};
  for (const char* density : {"0.0012", "1.2", "120", "10000"})
    what.series.push_back(
        with_settings(refined, "density", fmt::format("{} kg/m^3", density), {with_density(density)}));
  for (const int degrees : {0, 15, 30, 45})
    what.series.push_back(
        with_settings(refined, "half on a slope", fmt::format("slope of {} degrees", degrees), halved<Dim>(degrees)));
  what.series.push_back(
      over_values(refined, 1, "tolerance", "suspension.tolerance", {"1e-1", "1e-2", "1e-3", "1e-4", "1e-6", "1e-8"}));
  what.remark = fmt::format(
      "The walls, {} radii away, hold up the air that flows back: {} % of the acceleration are missing for that. What "
      "is left is the rim, a cell thick, where a face takes the mean density of smoke and air; of first order, and "
      "gone for light smoke. "
      "Half of it on a slope through the cells, under gravity along the slope, falls as the whole does to 3e-4 (B13).",
      radii, Dim == 2 ? "0.3" : "0.5");
  what.quick = Dim == 3;
  what.compare = Compare<Dim>(compare_added_mass<Dim>);
  return what;
}

/// Speed of the air against rest, in sqrt(g H).
Comparison<2> compare_balance(const Simulation<2>&) {
  const auto largest = std::make_shared<double>(0);
  return {[largest](const Simulation<2>& now) { *largest = std::max(*largest, now.suspension()->max_speed()); },
          [largest](const Simulation<2>& end) {
            ErrorNorms speed;
            speed.add(*largest / std::sqrt(end.gravity().norm() * end.walls().domain.size()[1]), 0);
            return Outcome{speed.l2(), speed.max(), {{"mass error", std::abs(end.mass_error()), 1e-12}}};
          }};
}

Case well_balanced() {
  Case what;
  what.name = "layered_smoke";
  what.title = "Layers of smoke stay at rest";
  what.reference = "u = 0: the pressure carries the layers";
  what.source = "hydrostatics";
  what.quantity = "largest speed, in sqrt(g H)";
  what.scene = "verification/layered_smoke.toml";
  const Series refined{"resolution",
                       "maccormack",
                       {},
                       {{"16 cells", {"suspension.cell_size=0.0625"}, 0, 1e-9},
                        {"32 cells", {"suspension.cell_size=0.03125"}, 0, 1e-9},
                        {"64 cells", {"suspension.cell_size=0.015625"}, 0, 1e-9}}};
  what.series = air_series(refined, 1);
  what.series.pop_back();
  what.remark =
      "What moves is what the pressure solve leaves: the speed follows the tolerance, 4e-5 at that of the default.";
  what.compare = Compare<2>(compare_balance);
  return what;
}

/// rho / rho_0 = (erf((x - a) / s) - erf((x - b) / s)) / 2, s = sqrt(4 kappa t), of smoke that was between a and b.
Comparison<2> compare_erf(const Simulation<2>&) {
  return {{}, [](const Simulation<2>& end) {
            const Suspension<2>& air = *end.suspension();
            const SmokeSection& smoke = end.scene().smoke[0];
            const double spread = std::sqrt(4 * air.options().diffusivity * end.time());
            ErrorNorms density;
            for_each_index<2>(air.grid().cells, [&](const Index<2>& cell) {
              const double x = air.grid().cell_centre(cell)[0];
              const double exact =
                  (std::erf((x - smoke.lower[0]) / spread) - std::erf((x - smoke.upper[0]) / spread)) / 2;
              density.add(air.smoke_density(flat<2>(cell, air.grid().cells)), smoke.density * exact);
            });
            return Outcome{density.l2(), density.max(), {{"mass error", std::abs(end.mass_error()), 1e-12}}};
          }};
}

Case diffusion() {
  Case what;
  what.name = "smoke_diffusion";
  what.title = "A slab of smoke spreads in still air";
  what.reference = "rho / rho_0 = (erf((x - a) / s) - erf((x - b) / s)) / 2, s = sqrt(4 kappa t)";
  what.source = "Crank, The Mathematics of Diffusion";
  what.quantity = "density of the smoke after 0.5 s";
  what.scene = "verification/smoke_diffusion.toml";
  const Series refined{
      "resolution",
      "dt = 2.56 s (dx / m)^2",
      {},
      {cells_of(1.0 / 16, 0.01, {"scene.max_step=10 ms"}), cells_of(1.0 / 32, 0.0025, {"scene.max_step=2.5 ms"}),
       cells_of(1.0 / 64, 0.000625, {"scene.max_step=0.625 ms"})}};
  what.series = {refined, over_values(refined, 2, "time step", "scene.max_step",
                                      {"100 ms", "50 ms", "20 ms", "10 ms", "5 ms", "2.5 ms"})};
  what.least_order = 1.9;
  what.quick = true;
  what.remark = "Diffusion is implicit, stable at any step, and of first order in time: the steps shrink as dx^2.";
  what.compare = Compare<2>(compare_erf);
  return what;
}

}  // namespace

std::vector<Case> cloud_cases() {
  Case cylinder = heavy_ball<2>(
      "heavy_cylinder",
      {"resolution",
       "maccormack",
       {},
       {cells_of(1.0 / 4, 0.03), cells_of(1.0 / 8, 0.02), cells_of(1.0 / 16, 0.02), cells_of(1.0 / 24, 0.02)}},
      "16");
  Case sphere = heavy_ball<3>(
      "heavy_sphere",
      {"resolution", "maccormack", {}, {cells_of(1.0 / 4, 0.02), cells_of(1.0 / 8, 0.02), cells_of(1.0 / 12, 0.02)}},
      "5");
  return {cylinder, sphere, well_balanced(), diffusion()};
}

}  // namespace spindrift
