#include <algorithm>
#include <cmath>
#include <numbers>

#include "verification/case_groups.hpp"
#include "verification/grid_series.hpp"

namespace spindrift {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// The wind on all faces that let air through, over its speed; what the ground takes of its momentum.
template <int Dim>
Comparison<Dim> compare_wind(const Simulation<Dim>&) {
  return {{}, [](const Simulation<Dim>& end) {
            const Suspension<Dim>& air = *end.suspension();
            const Vec<Dim> wind = air.options().wind;
            ErrorNorms errors;
            double whole = 0, lost = 0;
            for (int axis = 0; axis < Dim; ++axis) {
              const auto k = static_cast<std::size_t>(axis);
              for (std::size_t face = 0; face < air.velocity()[k].size(); ++face) {
                if (!air.active_faces()[k][face]) continue;
                const double u = air.velocity()[k][face], mass = air.face_mass(axis, face);
                errors.add(u, wind[axis], mass);
                whole += mass * wind[axis] * wind[axis];
                lost += mass * wind[axis] * (wind[axis] - u);
              }
            }
            return Outcome{errors.l2(),
                           errors.max(),
                           {{"share of the momentum lost to the ground", std::abs(lost) / whole, 1e-6}}};
          }};
}

template <int Dim>
Case wind_along_slope(std::string name, const Series& refined) {
  Case what;
  what.name = std::move(name);
  what.title = Dim == 2 ? "Wind along a slope that cuts through the cells"
                        : "Wind along a slope that cuts through the cells along all axes";
  what.reference = "u = wind";
  what.source = "exact: ground without friction";
  what.quantity = "velocity after two passages";
  what.scene = "verification/" + what.name + ".toml";
  what.series = {refined};
  what.quick = Dim == 3;
  what.remark = "A uniform stream is kept exactly, whatever the angle: the open parts of faces add up on a plane.";
  what.compare = Compare<Dim>(compare_wind<Dim>);
  return what;
}

/// A slope in 2D, and the wind along it.
std::vector<std::string> slope_and_wind(double angle) {
  return {fmt::format("terrain.points=[[-10, {}], [10, {}]]", -1 + 10 * std::tan(angle), -1 - 10 * std::tan(angle)),
          fmt::format("suspension.wind=[{}, {}]", 10 * std::cos(angle), -10 * std::sin(angle))};
}

/// A slope in 3D that falls `aside` of the first axis, and the wind down it.
std::vector<std::string> slope_and_wind(double angle, double aside) {
  const double fall = std::tan(angle), level = 10 * std::cos(angle);
  return {fmt::format("terrain.angle={}", std::atan(fall * std::cos(aside))),
          fmt::format("terrain.side_angle={}", std::atan(fall * std::sin(aside))),
          fmt::format("suspension.wind=[{}, {}, {}]", level * std::cos(aside), level * std::sin(aside),
                      -10 * std::sin(angle))};
}

/// The angle by which the plane ground of a scene falls along the first axis.
double angle_of(const Scene& scene) {
  const auto& points = scene.terrain->points;
  return std::atan2(points.front()[1] - points.back()[1], points.back()[0] - points.front()[0]);
}

/// The scene turned about the origin until its ground is level; the domain stays.
Scene levelled(Scene scene) {
  const double angle = angle_of(scene), c = std::cos(angle), s = std::sin(angle);
  const auto turn = [&](std::vector<double>& v) {
    const double x = v.front(), z = v.back();
    v.front() = c * x - s * z, v.back() = s * x + c * z;
  };
  turn(scene.domain.gravity);
  turn(scene.smoke[0].center);
  for (auto& point : scene.terrain->points) point[1] = 0;
  return scene;
}

/// How far down the slope 99 % of the smoke are not [m from the origin].
template <int Dim>
double front(const Simulation<Dim>& simulation) {
  const Suspension<Dim>& air = *simulation.suspension();
  const double angle = angle_of(simulation.scene());
  std::vector<std::pair<double, double>> smoke;  // place along the slope, mass
  double all = 0;
  for_each_index<Dim>(air.grid().cells, [&](const Index<Dim>& cell) {
    const Vec<Dim> x = air.grid().cell_centre(cell);
    const double mass = air.smoke_mass()[cell];
    all += mass;
    if (mass > 0) smoke.emplace_back(x[0] * std::cos(angle) - x[up_axis<Dim>] * std::sin(angle), mass);
  });
  std::sort(smoke.begin(), smoke.end());
  double left = 0.01 * all;
  auto last = smoke.end();
  while (left > 0) left -= (--last)->second;
  return last->first;
}

/// Against the same cloud in cells that the ground does not cut.
template <int Dim>
Comparison<Dim> compare_front(const Simulation<Dim>& start) {
  return {
      {}, [begin = front(start)](const Simulation<Dim>& end) {
        Simulation<Dim> level(levelled(end.scene()));
        while (!level.done()) level.step();
        const double way = front(end) - begin, level_way = front(level) - begin, dx = end.suspension()->grid().dx;
        ErrorNorms ways;
        ways.add(way, level_way);
        return Outcome{ways.l2(), ways.max(), {{"distance of the fronts in cells", std::abs(way - level_way) / dx, 1}}};
      }};
}

template <int Dim>
Case cloud_down_slope(std::string name, const Series& refined) {
  Case what;
  what.name = std::move(name);
  what.title = fmt::format("A cloud runs down a slope whichever way the cells lie, in {}D", Dim);
  what.reference = "the same cloud over level ground under inclined gravity, in the same cells";
  what.source = "rotation changes nothing";
  what.quantity = "way of the front in 1 s";
  what.scene = "verification/" + what.name + ".toml";
  what.series = {refined};
  for (const int degrees : {15, 45}) {
    const double angle = degrees * degree, fall = 40 * std::tan(angle);
    const double x = -3 * std::cos(angle) + std::sin(angle), z = 3 * std::sin(angle) + std::cos(angle);
    what.series.push_back(with_settings(
        refined, "slope", fmt::format("{} degrees", degrees),
        {fmt::format("terrain.points=[[-40, {}], [40, {}]]", fall, -fall),
         Dim == 2 ? fmt::format("smoke[0].center=[{}, {}]", x, z) : fmt::format("smoke[0].center=[{}, 0, {}]", x, z)}));
  }
  what.remark =
      "The gate is one cell. In 2D the ways come together, as 6, 4 and 3 % at 30 degrees, but not as fast as the cells "
      "shrink. After 2 s, in a domain half as wide, they were 1 to 10 % apart and did not come together: by eddies or "
      "by the open sides, which of them was not looked into.";
  what.compare = Compare<Dim>(compare_front<Dim>);
  return what;
}

}  // namespace

std::vector<Case> embedded_ground_cases() {
  const auto by_cells = [](std::vector<Level> levels) {
    return Series{"resolution", "30 degrees", {}, std::move(levels)};
  };
  Case wind = wind_along_slope<2>("wind_along_slope",
                                  by_cells({cells_of(0.5, 1e-6), cells_of(0.25, 1e-6), cells_of(0.125, 1e-6)}));
  for (const int degrees : {0, 15, 45})
    wind.series.push_back(with_settings(wind.series.front(), "slope", fmt::format("{} degrees", degrees),
                                        slope_and_wind(degrees * degree)));
  Case wind_3d = wind_along_slope<3>("wind_along_slope_3d",
                                     by_cells({cells_of(1, 1e-6), cells_of(0.5, 1e-6), cells_of(0.25, 1e-6)}));
  for (const int degrees : {0, 15, 45})
    wind_3d.series.push_back(with_settings(wind_3d.series.front(), "slope", fmt::format("{} degrees", degrees),
                                           slope_and_wind(degrees * degree, 30 * degree)));
  return {wind, wind_3d,
          cloud_down_slope<2>("cloud_down_slope", by_cells({cells_of(0.25), cells_of(0.125), cells_of(0.0625)})),
          cloud_down_slope<3>("cloud_down_slope_3d", by_cells({cells_of(0.5), cells_of(0.25)}))};
}

}  // namespace spindrift
