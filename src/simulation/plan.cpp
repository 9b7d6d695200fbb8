#include "simulation/plan.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include "core/error.hpp"

namespace spindrift {
namespace {

// Bytes an item of state, scratch and files, as measured on the paper's 2D scenes.
constexpr double bytes_per_dense = 1000, bytes_per_cover = 200, bytes_per_cell = 360, bytes_of_program = 33e6;
constexpr double file_bytes_per_particle = 12, file_bytes_per_cell = 8, bytes_per_picture = 60e3;
constexpr double bytes_per_diagnostics_row = 800, typical_step = 5e-3;

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

double release_volume(const ReleaseSection& release, double width) {
  if (release.shape == "slab") return release.length * release.thickness * width;
  double volume = 1;
  for (std::size_t k = 0; k < release.lower.size(); ++k) volume *= release.upper[k] - release.lower[k];
  return volume;
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

std::string amount(double bytes) {
  return fmt::format("{:.3g} GB", bytes / 1e9);
}

}  // namespace

Plan plan_scene(const Scene& scene) {
  Plan plan;
  const auto& lower = scene.domain.lower;
  const auto& upper = scene.domain.upper;
  const double width = scene.scene.dim == 3 ? upper[1] - lower[1] : 1;
  if (scene.dense_flow) {
    const double particle = std::pow(scene.dense_flow->support_radius / 2, scene.scene.dim);
    if (scene.release) plan.n_release = std::ceil(release_volume(*scene.release, width) / particle);
    if (scene.cover && scene.terrain) {
      const double end = scene.cover->to >= 0 ? scene.cover->to : ground_length(*scene.terrain, upper[0]);
      plan.n_cover = std::ceil(std::max(0.0, end - scene.cover->from) * scene.cover->depth * width / particle);
    }
  }
  if (scene.suspension) {
    plan.n_cells = 1;
    for (std::size_t k = 0; k < lower.size(); ++k) {
      plan.grid.push_back(std::max(1.0, std::round((upper[k] - lower[k]) / scene.suspension->cell_size)));
      plan.n_cells *= plan.grid.back();
    }
  }
  const OutputSection& output = scene.output;
  const double n_particles = plan.n_release + plan.n_cover;
  plan.n_frames = std::floor(scene.scene.end_time * output.frames_per_second) + 1;
  plan.memory = bytes_of_program + bytes_per_dense * plan.n_release + bytes_per_cover * plan.n_cover +
                bytes_per_cell * plan.n_cells;
  plan.disk = plan.n_frames *
                  ((output.particles ? file_bytes_per_particle * n_particles : 0) +
                   (output.smoke ? file_bytes_per_cell * plan.n_cells : 0) + (output.preview ? bytes_per_picture : 0)) +
              bytes_per_diagnostics_row * scene.scene.end_time / typical_step;
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
  return error ? std::numeric_limits<double>::infinity() : static_cast<double>(space.available);
}

void require_fit(const Scene& scene, const Plan& plan, const std::filesystem::path& folder) {
  const auto refuse = [](const std::string& why) { throw Error(ExitCode::would_not_fit, why); };
  constexpr double countable = 1e9;
  const double n_particles = plan.n_release + plan.n_cover;
  if (!(plan.n_cells <= countable))
    refuse(
        fmt::format("the grid would have {:.3g} cells, at most 1e9 can be: domain.lower to domain.upper in cells of "
                    "suspension.cell_size = {} m",
                    plan.n_cells, scene.suspension->cell_size));
  if (!(n_particles <= countable))
    refuse(
        fmt::format("there would be {:.3g} released and {:.3g} cover particles, at most 1e9 can be: their spacing is "
                    "half of dense_flow.support_radius = {} m",
                    plan.n_release, plan.n_cover, scene.dense_flow->support_radius));
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
