#pragma once
/// Running a scene from its begin to its end into a run folder.

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

#include "core/error.hpp"
#include "simulation/scene.hpp"

namespace spindrift {

/// Where a run stands after a step.
struct Progress {
  double time = 0, end_time = 0, dt = 0;  ///< [s], simulated
  std::string_view limiter;               ///< what bounded dt
  std::uint64_t step = 0;
  std::size_t n_dense = 0, n_entrained = 0;
  double smoke_mass = 0;    ///< [kg]
  double wall_seconds = 0;  ///< since the run began
};

struct RunOptions {
  std::filesystem::path folder;
  int threads = 0;                                   ///< 0: all of the machine's
  std::string scene_file;                            ///< as the user named it, for run.json
  std::function<void(const Progress&)> on_progress;  ///< after every step; may be empty
  std::function<void(const std::string&)> on_note;   ///< a line worth telling, as why there is no film; may be empty
  std::filesystem::path profile;            ///< where the time of every pass goes, as a Chrome trace; may be empty
  const std::atomic<bool>* stop = nullptr;  ///< once true, the run ends after its step, status "stopped"
};

/// Runs a scene to its end, writing the run folder. Returns done, unstable, or resumable where it was stopped.
/// Throws Error: input/output, memory, numbers that describe no scene.
ExitCode run_scene(const Scene& scene, const RunOptions& options);

}  // namespace spindrift
