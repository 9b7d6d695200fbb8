#pragma once
/// What a run will need, told from its scene alone before anything is built.

#include <filesystem>
#include <vector>

#include "simulation/scene.hpp"

namespace spindrift {

/// Counts are doubles, so that the absurd stays a number.
struct Plan {
  double n_release = 0;       ///< dense particles at the start
  double n_cover = 0;         ///< cover particles, were all of them laid
  double n_laid = 0;          ///< those that flow and air come near, within a factor of some
  double release_area = 0;    ///< ground under areas of release [m^2]
  double release_volume = 0;  ///< of all releases, in 2D a metre broad [m^3]
  double cover_area = 0;      ///< ground under the cover, in 2D a metre broad [m^2]
  std::vector<double> grid;   ///< cells along each axis; empty without a suspension
  double n_cells = 0;         ///< of the grid; on tiles of the largest box around them, within a factor of some
  double n_frames = 0;
  double memory = 0;   ///< peak [B], within about a factor of two
  double disk = 0;     ///< run folder [B], within about a factor of two
  double n_steps = 0;  ///< within about a factor of two
  double seconds = 0;  ///< of the whole run on all of this machine's cores [s], within about a factor of three
};

/// Throws Error(would_not_fit): more cells of maps or of ground than can be.
Plan plan_scene(const Scene& scene);

/// Memory that this process may still use [B]: the machine's, or its control group's if that is less.
double memory_available();

/// Space left where `folder` is or will be [B].
double disk_available(const std::filesystem::path& folder);

/// Throws Error(would_not_fit): more cells or particles than can be counted, more memory than four fifths of what is
/// available, more disk than there is.
void require_fit(const Scene& scene, const Plan& plan, const std::filesystem::path& folder);

}  // namespace spindrift
