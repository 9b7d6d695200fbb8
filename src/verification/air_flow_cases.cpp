#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/case_groups.hpp"
#include "verification/curve.hpp"
#include "verification/grid_series.hpp"

namespace spindrift {
namespace {

/// Through the three nearest values of a row of cell centres, `dx` apart, the first at dx / 2.
double quadratic(const std::vector<double>& row, double dx, double x) {
  const double s = x / dx - 0.5;
  const int i = std::clamp(static_cast<int>(std::lround(s)), 1, static_cast<int>(row.size()) - 2);
  const double f = s - i;
  const auto at = [&](int k) { return row[static_cast<std::size_t>(k)]; };
  return at(i) + f * (at(i + 1) - at(i - 1)) / 2 + f * f * (at(i + 1) - 2 * at(i) + at(i - 1)) / 2;
}

Comparison<2> compare_marchi(const Simulation<2>&) {
  static const Curve u_of_z{{0.0625, -0.041974991}, {0.125, -0.077125399}, {0.1875, -0.109816214}, {0.25, -0.141930064},
                            {0.3125, -0.172712391}, {0.375, -0.198470859}, {0.4375, -0.212962392}, {0.5, -0.2091491418},
                            {0.5625, -0.182080595}, {0.625, -0.131256301}, {0.6875, -0.060245594}, {0.75, 0.027874448},
                            {0.8125, 0.140425325},  {0.875, 0.31055709},   {0.9375, 0.597466694}};
  static const Curve w_of_x{{0.0625, 0.094807616},  {0.125, 0.1492430},    {0.1875, 0.174342933},  {0.25, 0.179243328},
                            {0.3125, 0.169132064},  {0.375, 0.145730201},  {0.4375, 0.1087758646}, {0.5, 0.057536559},
                            {0.5625, -0.007748504}, {0.625, -0.084066715}, {0.6875, -0.163010143}, {0.75, -0.227827313},
                            {0.8125, -0.253768577}, {0.875, -0.218690812}, {0.9375, -0.12331817}};
  return {{}, [](const Simulation<2>& end) {
            const Suspension<2>& air = *end.suspension();
            const int n = air.grid().cells[0];
            std::vector<double> u, w;
            for (int i = 0; i < n; ++i) {
              u.push_back(air.velocity()[0][Index<2>{n / 2, i}]);
              w.push_back(air.velocity()[1][Index<2>{i, n / 2}]);
            }
            ErrorNorms errors;
            for (const auto& [z, reference] : u_of_z) errors.add(quadratic(u, air.grid().dx, z), reference);
            for (const auto& [x, reference] : w_of_x) errors.add(quadratic(w, air.grid().dx, x), reference);
            return Outcome{errors.l2(), errors.max(), {}};
          }};
}

/// The velocity of all faces against `share` of the one it began with.
template <int Dim>
ErrorNorms error_of_velocity(const FaceField<Dim>& now, const FaceField<Dim>& start, double share) {
  ErrorNorms errors;
  for (std::size_t axis = 0; axis < Dim; ++axis)
    for (std::size_t face = 0; face < now[axis].size(); ++face) errors.add(now[axis][face], share * start[axis][face]);
  return errors;
}

double energy(const FaceField<2>& u) {
  double sum = 0;
  for (const auto& component : u)
    for (const double value : component.values()) sum += value * value;
  return sum;
}

/// The vortices keep their form, and lose speed at the rate 2 pi^2 nu / L^2.
Comparison<2> compare_taylor_green(const Simulation<2>& start) {
  const FaceField<2> first = start.suspension()->velocity();
  return {{}, [first](const Simulation<2>& end) {
            const Suspension<2>& air = *end.suspension();
            const double rate = 2 * std::pow(std::numbers::pi / end.walls().domain.size()[0], 2);
            const ErrorNorms errors =
                error_of_velocity<2>(air.velocity(), first, std::exp(-rate * air.options().viscosity * end.time()));
            const double decay = -std::log(energy(air.velocity()) / energy(first)) / (2 * rate * end.time());
            return Outcome{
                errors.l2(), errors.max(), {{"numerical viscosity [m^2/s]", decay - air.options().viscosity, 2e-3}}};
          }};
}

/// Nothing is left of the first velocity; errors in its units.
template <int Dim>
Comparison<Dim> compare_rest(const Simulation<Dim>& start) {
  const FaceField<Dim> first = start.suspension()->velocity();
  return {{}, [first](const Simulation<Dim>& end) {
            const Suspension<Dim>& air = *end.suspension();
            ErrorNorms left;
            for (std::size_t axis = 0; axis < Dim; ++axis)
              for (std::size_t face = 0; face < first[axis].size(); ++face)
                left.add(first[axis][face] + air.velocity()[axis][face], first[axis][face]);
            const auto net_outflow = [](const FaceField<Dim>& u, const Index<Dim>& cell) {
              double sum = 0;
              for (int axis = 0; axis < Dim; ++axis) sum += u[axis][shifted<Dim>(cell, axis, 1)] - u[axis][cell];
              return sum;
            };
            double before = 0, after = 0;
            for_each_index<Dim>(air.grid().cells, [&](const Index<Dim>& cell) {
              before = std::max(before, std::abs(net_outflow(first, cell)));
              after = std::max(after, std::abs(net_outflow(air.velocity(), cell)));
            });
            return Outcome{left.l2(),
                           left.max(),
                           {{"divergence left / before", after / before, 10 * air.options().pressure.tolerance}}};
          }};
}

Case cavity() {
  Case what;
  what.name = "cavity";
  what.title = "Air in a closed box under a sliding lid, Re = 100";
  what.reference = "u along the vertical and w along the horizontal middle line, at 15 places each";
  what.source = "Marchi, Suero and Araki 2009, extrapolated from 1024 x 1024 cells";
  what.quantity = "u and w on the middle lines";
  what.scene = "lid_driven_box.toml";
  const Series refined{
      "resolution",
      "maccormack",
      {},
      {cells_of(1.0 / 32, 0.05, {"scene.max_step=6.25 ms"}), cells_of(1.0 / 64, 0.02, {"scene.max_step=3.125 ms"}),
       cells_of(1.0 / 96, 0.01, {"scene.max_step=2.08 ms"})}};
  what.series = air_series(refined, 0);
  what.series.back() =
      over_values(refined, 0, "time step", "scene.max_step", {"40 ms", "20 ms", "10 ms", "5 ms", "2.5 ms"});
  what.least_order = 1.5;
  what.quick = true;
  what.remark =
      "After 20 s the air is steady to a hundredth of its error. The splitting of the step costs an error of first "
      "order in time, so the steps shrink with the cells; at a fixed step the order is lower. It still lies below 2: "
      "probably by the lid's ends, which are singular, and by MacCormack's clamp at extrema. The table of Ghia, Ghia "
      "and Shin (1982), more often used, differs from this one by 1.5 to 3 % at the extrema.";
  what.compare = Compare<2>(compare_marchi);
  return what;
}

Case taylor_green() {
  Case what;
  what.name = "vortices";
  what.title = "A Taylor-Green vortex without viscosity keeps turning";
  what.reference = "u = sin(pi x) cos(pi z), w = -cos(pi x) sin(pi z), steady";
  what.source = "Taylor and Green 1937; Euler equations";
  what.quantity = "velocity after 2 s";
  what.scene = "verification/vortices.toml";
  const Series refined{"resolution",
                       "reflection",
                       {},
                       {cells_of(1.0 / 32, 0.005), cells_of(1.0 / 64, 0.00125), cells_of(1.0 / 128, 0.0003)}};
  what.series = air_series(refined, 1);
  what.series.push_back({"time step",
                         "scene.max_step, dx = 1/128 m, any CFL number",
                         {"suspension.cell_size=0.0078125", "suspension.cfl=100"},
                         {{"200 ms", {"scene.max_step=0.2"}, 0.2},
                          {"100 ms", {"scene.max_step=0.1"}, 0.1},
                          {"50 ms", {"scene.max_step=0.05"}, 0.05}}});
  what.least_order = 1.9;
  what.quick = true;
  what.compare = Compare<2>(compare_taylor_green);
  return what;
}

Case viscous_taylor_green() {
  Case what;
  what.name = "viscous_vortices";
  what.title = "A Taylor-Green vortex dies by viscosity, Re = 100";
  what.reference = "u = U sin(pi x) cos(pi z) exp(-2 pi^2 nu t), w alike";
  what.source = "Taylor and Green 1937";
  what.quantity = "velocity after 2 s";
  what.scene = "verification/viscous_vortices.toml";
  const Series refined{"resolution",
                       "reflection",
                       {},
                       {cells_of(1.0 / 32, 0.003), cells_of(1.0 / 64, 0.001), cells_of(1.0 / 128, 0.0003)}};
  what.series = air_series(refined, 1);
  what.least_order = 1.5;
  what.remark =
      "Viscosity is implicit and of first order in time, with a small factor: it shows at the finest level only.";
  what.compare = Compare<2>(compare_taylor_green);
  return what;
}

template <int Dim>
Case projection(std::string name, std::string scene, const Series& refined) {
  Case what;
  what.name = std::move(name);
  what.title = "Projection of a potential flow, in " + std::to_string(Dim) + "D";
  what.reference = "rest: u = grad(phi), phi = X(x) X(z), X(s) = s^2 (1 - s)^2, is all pressure";
  what.source = "manufactured";
  what.quantity = "velocity that is left, over the first";
  what.scene = std::move(scene);
  what.series = {refined, over_values(refined, 1, "tolerance", "suspension.tolerance",
                                      {"1e-1", "1e-2", "1e-3", "1e-4", "1e-6", "1e-8"})};
  what.least_order = 1.9;
  what.quick = Dim == 2;
  what.compare = Compare<Dim>(compare_rest<Dim>);
  return what;
}

}  // namespace

std::vector<Case> air_flow_cases() {
  const auto by_cells = [](std::vector<Level> levels) {
    return Series{"resolution", "maccormack", {}, std::move(levels)};
  };
  return {cavity(), taylor_green(), viscous_taylor_green(),
          projection<2>("projection", "verification/potential_flow.toml",
                        by_cells({cells_of(1.0 / 32, 0.01), cells_of(1.0 / 64, 0.0025), cells_of(1.0 / 128, 6.25e-4)})),
          projection<3>("projection_3d", "verification/potential_flow_3d.toml",
                        by_cells({cells_of(1.0 / 16, 0.04), cells_of(1.0 / 32, 0.01), cells_of(1.0 / 64, 0.0025)}))};
}

}  // namespace spindrift
