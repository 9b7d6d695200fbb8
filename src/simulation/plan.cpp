#include "simulation/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <numeric>
#include <optional>
#include <string>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "grid/still_tiles.hpp"
#include "simulation/ground.hpp"
#include "simulation/map_cells.hpp"
#include "simulation/outline.hpp"
#include "simulation/setup.hpp"

namespace spindrift {
namespace {

// Bytes an item of state, scratch and files, as measured on the paper's 2D scenes.
constexpr double bytes_per_dense = 1080, bytes_per_cover = 390, bytes_per_cell = 410, bytes_of_program = 33e6;
constexpr double file_bytes_per_particle = 12, file_bytes_per_cell = 8, bytes_per_picture = 60e3;
constexpr double bytes_per_diagnostics_row = 800, bytes_per_map_cell = 250;
// Seconds of one core, as measured.
constexpr double seconds_per_dense_step = 1.9e-6, seconds_per_cell_step = 5.5e-8, seconds_per_frame = 0.05;
constexpr double seconds_per_3d_picture = 1, bytes_per_3d_picture = 600e3;  // 1380 px wide
constexpr double sweep_of_release = 12;  // ground that flow comes near, in ground under the release
constexpr double growth_by_cover = 2;    // of the number of moving particles, as a mean over a run

/// Arc length of the ground [m], without its arcs and bumps.
double ground_length(const TerrainSection& terrain, double domain_end) {
  double length = 0;
  if (terrain.shape == "polyline") {
    for (std::size_t i = 1; i < terrain.points.size(); ++i)
      length +=
          std::hypot(terrain.points[i][0] - terrain.points[i - 1][0], terrain.points[i][1] - terrain.points[i - 1][1]);
    return length;
  }
  const double run_out = domain_end - terrain.start[0] - terrain.drop / std::tan(terrain.angle);
  return terrain.drop / std::sin(terrain.angle) + std::max(0.0, run_out) / std::cos(terrain.runout_angle);
}

double box_volume(const std::vector<double>& lower, const std::vector<double>& upper) {
  double volume = 1;
  for (std::size_t k = 0; k < lower.size(); ++k) volume *= upper[k] - lower[k];
  return volume;
}

/// Ground under the area of a release [m^2]; 0 where it is of another shape.
double released_area(const ReleaseSection& release, const HeightField& ground) {
  if (release.shape != "area") return 0;
  return ground_area(ground, extent_of(release.points),
                     [&](const Vec<2>& place) { return inside(release.points, place[0], place[1]); });
}

double release_volume(const ReleaseSection& release, double width, int dim, const HeightField* ground) {
  if (release.shape == "area") return released_area(release, *ground) * release.thickness;
  if (release.shape == "slab") return release.length * release.thickness * width;
  if (release.shape == "polygon") return area_of(release.points) * width;
  if (release.shape == "box") return box_volume(release.lower, release.upper);
  return (dim == 3 ? 4.0 / 3.0 : 1.0) * std::numbers::pi * std::pow(release.radius, dim);
}

double norm(const std::vector<double>& v) {
  return std::sqrt(std::inner_product(v.begin(), v.end(), v.begin(), 0.0));
}

/// Ground under the cover [m^2].
double covered_area(const Scene& scene, const HeightField& ground) {
  Box<2> extent = domain_in_plan(scene);
  const double begin = extent.lower[0];
  if (scene.cover->to >= 0) extent.upper[0] = std::min(extent.upper[0], begin + scene.cover->to);
  extent.lower[0] += scene.cover->from;
  const std::vector<Outline>& areas = scene.cover->areas;
  if (areas.empty()) return ground_area(ground, extent, [](const Vec<2>&) { return true; });
  Box<2> around = extent_of(areas.front());
  for (const Outline& area : areas) around = hull_of(around, extent_of(area));
  return ground_area(ground, common<2>(extent, around), [&](const Vec<2>& place) { return inside_any(areas, place); });
}

/// Between the highest and the lowest ground inside the domain [m].
double drop_of(const HeightField& ground, const Box<2>& domain) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for_each_index<2>({101, 101}, [&](const Index<2>& i) {
    const double z = ground.height(domain.lower + domain.size().cwiseProduct(Vec<2>(i[0], i[1])) / 100);
    low = std::min(low, z), high = std::max(high, z);
  });
  return high - low;
}

/// How far snow falls over what is there [m]: along a slope, friction and resistance leave a quarter of the drop.
double typical_fall(const Scene& scene, const HeightField* ground) {
  const double bottom = scene.domain.lower.back(), height = scene.domain.upper.back() - bottom;
  if (ground != nullptr) return std::max(drop_of(*ground, domain_in_plan(scene)), height / 4) / 4;
  if (scene.terrain) return (scene.terrain->shape == "polyline" ? height : scene.terrain->drop) / 4;
  double top = bottom;
  for (const ReleaseSection& release : scene.release) {
    if (release.shape == "area") continue;
    if (release.shape == "box") top = std::max(top, release.upper.back());
    if (release.shape == "ball") top = std::max(top, release.center.back() + release.radius);
    for (const auto& corner : release.points) top = std::max(top, corner[1]);
  }
  return top - bottom;
}

/// Speed that sets the time step [m/s].
double typical_speed(const Scene& scene, const HeightField* ground) {
  double speed = scene.dense_flow ? std::sqrt(2 * norm(scene.domain.gravity) * typical_fall(scene, ground)) : 0;
  for (const ReleaseSection& release : scene.release) speed = std::max(speed, norm(release.velocity));
  if (scene.suspension) speed = std::max({speed, norm(scene.suspension->wind), norm(scene.suspension->lid)});
  if (scene.suspension && scene.suspension->initial_flow != "wind")
    speed = std::max(speed, std::abs(scene.suspension->initial_speed));
  return speed;
}

/// Cells of the largest box around the tiles of a cloud: measured, of Figs. 9 and 13 and of configs/slope_3d.toml.
double cells_on_tiles(const Scene& scene, double release_volume) {
  const double dim = scene.scene.dim, cloud_over_release = dim == 3 ? 5000 : 600;
  const double least = std::pow(3 * (dim == 3 ? tile_edge<3> : tile_edge<2>), dim);
  return std::max(least, std::ceil(cloud_over_release * release_volume / std::pow(scene.suspension->cell_size, dim)));
}

/// [s]
double typical_step(const Scene& scene, const HeightField* ground) {
  const double speed = typical_speed(scene, ground);
  double dt = scene.scene.max_step;
  if (scene.dense_flow) {
    const double spacing = scene.dense_flow->spacing();
    const double signal = scene.dense_flow->solver == "wcsph" ? 10 * speed : speed;
    dt = std::min(dt, scene.dense_flow->cfl * spacing / signal);
  }
  // Snow drags air along, and squeezes it out faster than it moves itself.
  if (scene.suspension) dt = std::min(dt, scene.suspension->cfl * scene.suspension->cell_size / (2 * speed));
  return dt;
}

/// A number that follows `label` in `file`; infinity where there is none.
double number_in(const char* file, const std::string& label = "") {
  std::ifstream stream(file);
  std::string word;
  while (stream >> word) {
    double number = 0;
    if (label.empty())
      return word.find_first_not_of("0123456789") == std::string::npos ? std::stod(word)
                                                                       : std::numeric_limits<double>::infinity();
    if (word == label && stream >> number) return number;
  }
  return std::numeric_limits<double>::infinity();
}

double count_of(const ElevationGrid& map) {
  return static_cast<double>(map.columns) * map.rows;
}

std::string amount(double bytes) {
  return fmt::format("{:.3g} GB", bytes / 1e9);
}

}  // namespace

Plan plan_scene(const Scene& scene) {
  Plan plan;
  const auto& lower = scene.domain.lower;
  const auto& upper = scene.domain.upper;
  const double width = scene.scene.dim == 3 ? upper[1] - lower[1] : 1;
  std::optional<Terrain<3>> ground;
  if (scene.terrain && scene.terrain->is_field()) ground.emplace(make_terrain<3>(scene));
  const HeightField* const field = ground ? ground->height_field() : nullptr;
  if (scene.dense_flow) {
    const double particle = std::pow(scene.dense_flow->spacing(), scene.scene.dim);
    for (const ReleaseSection& release : scene.release) {
      const double volume = release_volume(release, width, scene.scene.dim, field);
      if (field != nullptr) plan.release_area += released_area(release, *field);
      plan.release_volume += volume;
      plan.n_release += std::round(volume / particle);
    }
    if (scene.cover && field != nullptr) {
      plan.cover_area = covered_area(scene, *field);
    } else if (scene.cover && scene.terrain) {
      const double end = scene.cover->to >= 0 ? scene.cover->to : ground_length(*scene.terrain, upper[0]);
      plan.cover_area = std::max(0.0, end - scene.cover->from) * width;
    }
    if (scene.cover) {
      plan.n_laid = plan.n_cover = std::ceil(plan.cover_area * scene.cover->depth / particle);
      if (field != nullptr && cover_sleeps(scene)) {
        const double footprint = std::max(plan.release_area, std::pow(plan.release_volume, 2.0 / 3));
        plan.n_laid = std::min(plan.n_cover, std::ceil(sweep_of_release * footprint * scene.cover->depth / particle));
      }
    }
  }
  if (scene.suspension) {
    plan.n_cells = 1;
    for (std::size_t k = 0; k < lower.size(); ++k) {
      plan.grid.push_back(std::max(1.0, std::round((upper[k] - lower[k]) / scene.suspension->cell_size)));
      plan.n_cells *= plan.grid.back();
    }
    if (scene.suspension->tiles) plan.n_cells = std::min(plan.n_cells, cells_on_tiles(scene, plan.release_volume));
  }
  plan.n_steps = std::ceil(scene.scene.end_time / typical_step(scene, field));
  const OutputSection& output = scene.output;
  const double n_particles = plan.n_release + plan.n_laid;
  plan.n_frames = std::floor(scene.scene.end_time * output.frames_per_second) + 1;
  plan.memory = bytes_of_program + (ground ? 2.0 * static_cast<double>(ground->bytes()) : 0) +
                bytes_per_dense * plan.n_release + bytes_per_cover * plan.n_laid + bytes_per_cell * plan.n_cells;
  const bool deep = scene.scene.dim == 3;
  if (deep && scene.terrain && output.rasters) plan.memory += bytes_per_map_cell * count_of(empty_map(scene));
  const double picture_bytes = !output.preview ? 0 : deep ? bytes_per_3d_picture : bytes_per_picture;
  const double picture_seconds = output.preview && deep ? seconds_per_3d_picture : 0;
  plan.disk = plan.n_frames * ((output.particles ? file_bytes_per_particle * n_particles : 0) +
                               (output.smoke ? file_bytes_per_cell * plan.n_cells : 0) + picture_bytes) +
              bytes_per_diagnostics_row * plan.n_steps;
  const double n_moving = plan.n_release * (scene.entrainment ? growth_by_cover : 1);
  const double work = n_moving * seconds_per_dense_step + plan.n_cells * seconds_per_cell_step;
  const double n_cores = n_threads();
  const double drawn = plan.n_frames * (seconds_per_frame + picture_seconds);
  plan.seconds = (plan.n_steps * work + drawn) / (n_cores > 1 ? 0.85 * n_cores : 1);
  return plan;
}

double memory_available() {
  const double machine = number_in("/proc/meminfo", "MemAvailable:") * 1024;
  const double group = number_in("/sys/fs/cgroup/memory.max") - number_in("/sys/fs/cgroup/memory.current");
  return std::isnan(group) ? machine : std::min(machine, group);
}

double disk_available(const std::filesystem::path& folder) {
  std::error_code error;
  std::filesystem::path place = std::filesystem::absolute(folder, error);
  while (!std::filesystem::exists(place, error) && place.has_relative_path()) place = place.parent_path();
  const auto space = std::filesystem::space(place, error);
  return error || space.capacity == 0 ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

void require_fit(const Scene& scene, const Plan& plan, const std::filesystem::path& folder) {
  const auto refuse = [](const std::string& why) { throw Error(ExitCode::would_not_fit, why); };
  constexpr double countable = 1e9;
  const double n_particles = plan.n_release + plan.n_laid;
  if (!(plan.n_cells <= countable))
    refuse(
        fmt::format("the grid would have {:.3g} cells, at most 1e9 can be: domain.lower to domain.upper in cells of "
                    "suspension.cell_size = {} m",
                    plan.n_cells, scene.suspension->cell_size));
  if (!(n_particles <= countable))
    refuse(
        fmt::format("there would be {:.3g} released and {:.3g} cover particles, at most 1e9 can be: their spacing is "
                    "{} m, dense_flow.support_radius over dense_flow.support_ratio",
                    plan.n_release, plan.n_laid, scene.dense_flow->spacing()));
  const double memory = 0.8 * memory_available(), disk = disk_available(folder);
  if (!(plan.memory <= memory))
    refuse(
        fmt::format("the run would need about {} of memory ({:.3g} particles, {:.3g} cells), four fifths of what is "
                    "available are {}",
                    amount(plan.memory), n_particles, plan.n_cells, amount(memory)));
  if (!(plan.disk <= disk))
    refuse(
        fmt::format("the run folder {} would need about {} ({:.3g} frames of {:.3g} particles and {:.3g} cells), there "
                    "are {} left; output.frames_per_second = {}",
                    folder.string(), amount(plan.disk), plan.n_frames, n_particles, plan.n_cells, amount(disk),
                    scene.output.frames_per_second));
}

}  // namespace spindrift
