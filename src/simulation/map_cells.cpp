#include "simulation/map_cells.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "simulation/ground.hpp"

namespace spindrift {
namespace {

constexpr double most_cells = 5e7;  // as of an elevation model

double cell_size(const Scene& scene) {
  if (scene.output.raster_cell > 0) return scene.output.raster_cell;
  if (scene.terrain->is_field()) return scene.terrain->cell_size;
  return scene.dense_flow ? 2 * scene.dense_flow->spacing() : scene.suspension ? scene.suspension->cell_size : 1;
}

/// What a cell of one row of cells shares with those of another.
struct Shares {
  int first = 0, end = 0;
  std::vector<double> widths;  ///< of first, first + 1, ... [m]
};

std::vector<Shares> shares_along(int axis, const MacGrid<2>& from, const MacGrid<2>& to) {
  std::vector<Shares> all(static_cast<std::size_t>(to.cells[axis]));
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double lower = to.origin[axis] + to.dx * static_cast<double>(i), upper = lower + to.dx;
    const auto bounded = [&](double x) { return static_cast<int>(std::clamp(x, 0.0, from.cells[axis] + 0.0)); };
    Shares& shares = all[i];
    shares.first = bounded(std::floor((lower - from.origin[axis]) / from.dx));
    shares.end = bounded(std::ceil((upper - from.origin[axis]) / from.dx));
    for (int j = shares.first; j < shares.end; ++j) {
      const double begin = from.origin[axis] + from.dx * j;
      shares.widths.push_back(std::max(0.0, std::min(upper, begin + from.dx) - std::max(lower, begin)));
    }
  }
  return all;
}

}  // namespace

ElevationGrid empty_map(const Scene& scene) {
  const Box<2> domain = domain_in_plan(scene);
  const Vec<2> origin(scene.origin[0], scene.origin[1]);
  ElevationGrid map;
  if (scene.elevation && scene.output.raster_cell == 0) {
    const ElevationGrid& model = *scene.elevation;
    const GridPart part = part_under({domain.lower + origin, domain.upper + origin}, model);
    map.cell = model.cell;
    map.x = model.x + model.cell * part.first[0];
    map.y = model.y + model.cell * part.first[1];
    map.columns = part.last[0] - part.first[0] + 1;
    map.rows = part.last[1] - part.first[1] + 1;
    return map;
  }
  map.cell = cell_size(scene);
  const Vec<2> n = (domain.size() / map.cell).array().ceil().max(2.0);
  if (!(n.prod() <= most_cells))
    throw Error(ExitCode::would_not_fit, fmt::format("maps would have {:.3g} cells, at most 5e7 can be: a larger "
                                                     "output.raster_cell, or output.rasters = false",
                                                     n.prod()));
  map.x = domain.lower[0] + origin[0] + map.cell / 2;
  map.y = domain.lower[1] + origin[1] + map.cell / 2;
  map.columns = static_cast<int>(n[0]);
  map.rows = static_cast<int>(n[1]);
  return map;
}

MacGrid<2> cells_of(const ElevationGrid& map, const std::array<double, 3>& origin) {
  const Vec<2> half = Vec<2>::Constant(map.cell / 2);
  return {Vec<2>(map.x - origin[0], map.y - origin[1]) - half, map.cell, {map.columns, map.rows}};
}

std::vector<double> ground_areas(const Terrain<3>& terrain, const MacGrid<2>& cells, int parts) {
  std::vector<double> areas(count<2>(cells.cells));
  const double step = cells.dx / parts;
  parallel_for(areas.size(), [&](std::size_t cell) {
    const Vec<2> lower = cells.node(unflat<2>(cell, cells.cells));
    const auto corner = [&](int i, int j) -> Vec<3> {
      const Vec<3> x(lower[0] + step * i, lower[1] + step * j, 0);
      return {x[0], x[1], terrain.height(x)};
    };
    double area = 0;
    for_each_index<2>({parts, parts}, [&](const Index<2>& part) {
      const int i = part[0], j = part[1];
      area += 0.5 * (corner(i + 1, j + 1) - corner(i, j)).cross(corner(i, j + 1) - corner(i + 1, j)).norm();
    });
    areas[cell] = area;
  });
  return areas;
}

std::vector<double> on_cells(const MacGrid<2>& from, std::span<const double> values, const MacGrid<2>& to) {
  const std::vector<Shares> along_x = shares_along(0, from, to), along_y = shares_along(1, from, to);
  std::vector<double> out(count<2>(to.cells));
  parallel_for(out.size(), [&](std::size_t cell) {
    const Index<2> at = unflat<2>(cell, to.cells);
    const Shares &x = along_x[static_cast<std::size_t>(at[0])], &y = along_y[static_cast<std::size_t>(at[1])];
    double sum = 0, area = 0;
    for (int j = y.first; j < y.end; ++j)
      for (int i = x.first; i < x.end; ++i) {
        const double shared =
            x.widths[static_cast<std::size_t>(i - x.first)] * y.widths[static_cast<std::size_t>(j - y.first)];
        sum += shared * values[flat<2>({i, j}, from.cells)];
        area += shared;
      }
    if (area > 0) out[cell] = sum / area;
  });
  return out;
}

}  // namespace spindrift
