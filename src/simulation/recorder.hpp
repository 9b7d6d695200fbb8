#pragma once
/// The run folder: what a simulation leaves on disk (docs/results.md). Writing goes on beside the
/// simulation; a frame stands on disk whole or not at all.

#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string>

#include "io/background_writer.hpp"
#include "io/csv.hpp"
#include "io/series.hpp"
#include "simulation/instruments.hpp"
#include "simulation/pylons.hpp"
#include "simulation/rasters.hpp"
#include "simulation/run.hpp"
#include "simulation/scenery.hpp"

namespace spindrift {

template <int Dim>
class Recorder {
 public:
  /// Makes the folder, removes what an earlier run left in it, and writes scene.toml.
  /// Throws Error(io_failed), also from all calls below.
  Recorder(const Scene& scene, const RunOptions& options);

  /// Follows the simulation after its construction and after every step: a row of diagnostics, and a frame at the first
  /// step at or after each frame time. Steps are never cut to hit a frame time.
  void follow(const Simulation<Dim>& simulation);

  /// A frame of where the simulation stands, unless it has one or the scene wants none.
  void keep(const Simulation<Dim>& simulation);

  /// Waits for the frames, writes run.json and makes a film of the pictures.
  /// status   "done" | "stopped" | "unstable"
  void finish(const Simulation<Dim>& simulation, const std::string& status, const std::string& message = {});

  /// After a failed write: waits for what is still being written, then leaves run.json with the status "failed" and the
  /// message where that can still be written. Throws nothing.
  void give_up(const Simulation<Dim>& simulation, const std::string& message) noexcept;

  const Instruments<Dim>& instruments() const { return instruments_; }
  double wall_seconds() const;

 private:
  void write_frame(const Simulation<Dim>& simulation);
  void draw_preview(const Simulation<Dim>& simulation, std::uint64_t number, std::shared_ptr<const ParticleFrame> snow,
                    std::shared_ptr<const SmokeFrame> smoke);
  void write_diagnostics(const Simulation<Dim>& simulation);
  void follow_pylons(const Simulation<Dim>& simulation);
  void follow_rasters(const Simulation<Dim>& simulation);
  void write_rasters(const Simulation<Dim>& simulation);
  void write_summary(const Simulation<Dim>& simulation, const std::string& status, const std::string& message);
  void write_film();

  RunOptions options_;
  OutputSection output_;
  std::optional<Scenery> scenery_;  ///< of pictures in 3D
  std::chrono::steady_clock::time_point start_;
  Instruments<Dim> instruments_;
  std::uint64_t next_frame_ = 0, n_frames_ = 0;
  std::uint64_t last_frame_at_ = 0;             ///< number of steps
  std::atomic<std::uint64_t> n_committed_ = 0;  ///< frames that stand on disk
  std::vector<SeriesEntry> particle_series_, smoke_series_;
  std::map<std::string, std::uint64_t> limiters_;
  double dt_min_ = 0;
  std::optional<CsvWriter> diagnostics_;
  std::vector<double> numbers_;
  std::optional<Pylons<Dim>> pylons_;
  std::optional<CsvWriter> pylon_table_;
  std::optional<Rasters> rasters_;  ///< of 3D runs
  BackgroundWriter writer_;
};

}  // namespace spindrift
