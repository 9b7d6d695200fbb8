#include "simulation/ground.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <vector>

#include "core/error.hpp"
#include "io/esri_grid.hpp"
#include "simulation/raised_ground.hpp"
#include "terrain/height_shapes.hpp"
#include "terrain/profiles.hpp"

namespace spindrift {
namespace {

/// The ground goes on beyond the domain, so that open sides have ground to leave over.
constexpr double beyond_the_domain = 50;    // [m]
constexpr double ground_resolution = 0.25;  // of curved ground [m]
constexpr double rim = 20;                  // of height fields, and four cells [m]

SlopeProfile slope_of(const TerrainSection& terrain) {
  SlopeProfile slope;
  slope.start = {terrain.start[0], terrain.start[1]};
  slope.angle = terrain.angle;
  slope.drop = terrain.drop;
  slope.runout_angle = terrain.runout_angle;
  slope.transition_radius = terrain.transition_radius;
  slope.bump_length = terrain.bump_length;
  if (terrain.shape == "bumps") slope.bump_height = terrain.bump_height;
  if (terrain.shape == "cliff" || terrain.shape == "cliff_band") {
    slope.cliff_at = terrain.cliff_at;
    slope.cliff_height = terrain.cliff_height;
  }
  return slope;
}

std::vector<Vec<2>> ground_vertices(const TerrainSection& terrain, double domain_right) {
  if (terrain.shape == "polyline") {
    std::vector<Vec<2>> vertices;
    for (const auto& point : terrain.points) vertices.emplace_back(point[0], point[1]);
    return vertices;
  }
  return slope_profile(slope_of(terrain), domain_right + beyond_the_domain, ground_resolution);
}

HeightFunction shape_of(const TerrainSection& t, const Box<2>& domain) {
  const Vec<3> start(t.start[0], (domain.lower[1] + domain.upper[1]) / 2, t.start[1]);
  const double end_x = domain.upper[0] + beyond_the_domain;
  if (t.shape == "plane") return tilted_plane(start, t.angle, t.side_angle);
  if (t.shape == "parabola") return parabola(start, t.angle, t.drop);
  if (t.shape == "bowl") return bowl(start, t.angle, t.drop);
  if (t.shape == "helix") return helix({start, t.angle, t.drop, t.bend_radius, t.channel_depth, t.channel_width});
  if (t.shape == "ridge")
    return ridge(slope_of(t), start, end_x, t.ridge_height, t.ridge_width,
                 t.ridge_runs == "along" ? std::numeric_limits<double>::quiet_NaN() : t.ridge_at);
  if (t.shape == "cliff_band") return cliff_band(slope_of(t), end_x, t.cliff_angle);
  SPINDRIFT_CHECK(t.shape == "valley");
  return valley(start, t.angle, t.floor_width, t.wall_angle, t.transition_radius);
}

/// Every hole gets the height of a nearest point that has one, by steps along the axes.
void fill_holes(HeightGrid& grid) {
  std::deque<Index<2>> front;
  for_each_index<2>(grid.points, [&](const Index<2>& i) {
    if (!std::isnan(grid.z[flat<2>(i, grid.points)])) front.push_back(i);
  });
  for (; !front.empty(); front.pop_front())
    for (const int axis : {0, 1})
      for (const int step : {-1, 1}) {
        const Index<2> next = shifted<2>(front.front(), axis, step);
        if (!inside<2>(next, grid.points) || !std::isnan(grid.z[flat<2>(next, grid.points)])) continue;
        grid.z[flat<2>(next, grid.points)] = grid.z[flat<2>(front.front(), grid.points)];
        front.push_back(next);
      }
}

/// Of the model's part under the domain and a rim, holes included.
/// origin: of the domain's coordinates in those of the model [m].
HeightGrid heights_under(const Box<2>& domain, const ElevationGrid& model, const Vec<2>& origin) {
  const Vec<2> around = Vec<2>::Constant(rim + 4 * model.cell);
  const GridPart part = part_under({domain.lower + origin - around, domain.upper + origin + around}, model);
  HeightGrid grid;
  grid.cell = model.cell;
  grid.first = Vec<2>(model.x, model.y) - origin + model.cell * Vec<2>(part.first[0], part.first[1]);
  for (int k = 0; k < 2; ++k) grid.points[k] = part.last[k] - part.first[k] + 1;
  for_each_index<2>(grid.points,
                    [&](const Index<2>& i) { grid.z.push_back(model.at(part.first[0] + i[0], part.first[1] + i[1])); });
  return grid;
}

}  // namespace

GridPart part_under(const Box<2>& domain, const ElevationGrid& grid) {
  const Vec<2> origin(grid.x, grid.y);
  const Index<2> end{grid.columns - 1, grid.rows - 1};
  GridPart part;
  for (int k = 0; k < 2; ++k) {
    const double first = std::floor((domain.lower[k] - origin[k]) / grid.cell);
    const double last = std::ceil((domain.upper[k] - origin[k]) / grid.cell);
    part.first[k] = static_cast<int>(std::clamp(first, 0.0, end[k] - 1.0));
    part.last[k] = static_cast<int>(std::clamp(last, part.first[k] + 1.0, end[k] + 0.0));
  }
  return part;
}

Box<2> domain_in_plan(const Scene& scene) {
  const auto& lower = scene.domain.lower;
  const auto& upper = scene.domain.upper;
  return {{lower[0], lower[1]}, {upper[0], upper[1]}};
}

HeightGrid ground_heights(const Scene& scene) {
  const TerrainSection& terrain = *scene.terrain;
  const Box<2> domain = domain_in_plan(scene);
  HeightGrid grid;
  if (terrain.shape == "grid") {
    SPINDRIFT_CHECK(scene.elevation != nullptr);
    grid = heights_under(domain, *scene.elevation, {scene.origin[0], scene.origin[1]});
    fill_holes(grid);
  } else {
    grid = sampled(shape_of(terrain, domain), domain, rim + 4 * terrain.cell_size, terrain.cell_size);
  }
  raise_obstacles(grid, scene.obstacle);
  return grid;
}

KnownGround known_ground(const Scene& scene) {
  const HeightGrid grid = heights_under(domain_in_plan(scene), *scene.elevation, {scene.origin[0], scene.origin[1]});
  if (std::ranges::none_of(grid.z, [](double z) { return std::isnan(z); })) return {};
  std::vector<std::uint8_t> known(grid.z.size());
  std::ranges::transform(grid.z, known.begin(), [](double z) { return !std::isnan(z); });
  return {grid.first, grid.cell, grid.points, std::move(known)};
}

double ground_area(const HeightField& ground, const Box<2>& extent, const std::function<bool(const Vec<2>&)>& counts) {
  constexpr double samples = 1e5;
  const Vec<2> size = extent.size();
  if (!(size.minCoeff() > 0)) return 0;
  const double edge = std::sqrt(size.prod() / samples);
  Index<2> n;
  for (int k = 0; k < 2; ++k) n[k] = static_cast<int>(std::clamp(std::ceil(size[k] / edge), 1.0, samples));
  double area = 0;
  for_each_index<2>(n, [&](const Index<2>& i) {
    const Vec<2> place = extent.lower + Vec<2>(size[0] * (i[0] + 0.5) / n[0], size[1] * (i[1] + 0.5) / n[1]);
    if (counts(place)) area += 1 / cos_slope<3>(ground.normal(place));
  });
  return area * size.prod() / static_cast<double>(count<2>(n));
}

template <int Dim>
Terrain<Dim> make_terrain(const Scene& scene) {
  if constexpr (Dim == 3)
    if (scene.terrain->is_field()) return Terrain<Dim>(HeightField(ground_heights(scene)));
  return Terrain<Dim>(ground_vertices(*scene.terrain, scene.domain.upper[0]));
}

template Terrain<2> make_terrain<2>(const Scene&);
template Terrain<3> make_terrain<3>(const Scene&);

}  // namespace spindrift
