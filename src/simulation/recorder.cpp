#include "simulation/recorder.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "core/parallel.hpp"
#include "io/commit.hpp"
#include "io/esri_grid.hpp"
#include "io/film.hpp"
#include "io/frame_files.hpp"
#include "io/system.hpp"
#include "simulation/diagnostics.hpp"
#include "simulation/frame.hpp"
#include "simulation/local_origin.hpp"
#include "simulation/preview.hpp"
#include "simulation/scene_writer.hpp"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

/// The run folder with its parts, cleared of an earlier run's results. Nothing else in it is touched.
void prepare_folder(const RunOptions& options, const OutputSection& output) {
  const auto try_io = [&](auto&& f) {
    try {
      f();
    } catch (const fs::filesystem_error& failure) {
      throw Error(ExitCode::io_failed,
                  fmt::format("cannot prepare {}: {}", failure.path1().string(), failure.code().message()));
    }
  };
  try_io([&] {
    fs::create_directories(options.folder);
    for (const char* part : {"frames", "preview", "peaks"}) fs::remove_all(options.folder / part);
    for (const char* part : {"run.json", "particles.hdf.series", "smoke.hdf.series", "preview.mp4", "pylons.csv"})
      fs::remove(options.folder / part);
    if (output.particles || output.smoke) fs::create_directories(options.folder / "frames");
    if (output.preview) fs::create_directories(options.folder / "preview");
  });
  remove_stale_temporaries(options.folder);
}

template <int Dim>
std::size_t open_cells(const Suspension<Dim>& suspension) {
  const auto volume = suspension.ground().volume().values();
  return volume.size() - static_cast<std::size_t>(std::count(volume.begin(), volume.end(), 0.0));
}

}  // namespace

template <int Dim>
Recorder<Dim>::Recorder(const Scene& scene, const RunOptions& options)
    : options_(options), output_(scene.output), start_(std::chrono::steady_clock::now()) {
  prepare_folder(options, scene.output);
  Scene kept = scene;
  if (scene.elevation) {
    kept.terrain->file = "terrain.asc";
    commit(options_.folder / kept.terrain->file, esri_grid_text(*scene.elevation));
  }
  commit(options_.folder / "scene.toml", write_scene(kept));
  if (Dim == 3 && scene.output.preview) scenery_.emplace(around_local_origin(scene), preview_view(scene));
}

template <int Dim>
double Recorder<Dim>::wall_seconds() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

template <int Dim>
void Recorder<Dim>::follow(const Simulation<Dim>& simulation) {
  instruments_.follow(simulation);
  write_diagnostics(simulation);
  follow_pylons(simulation);
  follow_rasters(simulation);
  if (simulation.n_steps() > 0) {
    ++limiters_[std::string(simulation.report().limiter)];
    dt_min_ = simulation.n_steps() == 1 ? simulation.report().dt : std::min(dt_min_, simulation.report().dt);
  }
  if (output_.frames_per_second <= 0) return;
  const double frames_due = simulation.time() * output_.frames_per_second;
  if (frames_due < static_cast<double>(next_frame_)) return;
  write_frame(simulation);
  next_frame_ = static_cast<std::uint64_t>(std::floor(frames_due)) + 1;
}

template <int Dim>
void Recorder<Dim>::write_diagnostics(const Simulation<Dim>& simulation) {
  const std::vector<Diagnostic> row = diagnostics(simulation, instruments_);
  if (!diagnostics_) {
    std::vector<std::string> columns;
    for (const Diagnostic& d : row) columns.push_back(heading<Dim>(d));
    columns.push_back("limiter");
    diagnostics_.emplace(options_.folder / "diagnostics.csv", columns);
  }
  if (simulation.n_steps() == 0) return;
  numbers_.clear();
  for (const Diagnostic& d : row) numbers_.push_back(d.value);
  diagnostics_->row(numbers_, simulation.report().limiter);
}

template <int Dim>
void Recorder<Dim>::follow_pylons(const Simulation<Dim>& simulation) {
  if (simulation.scene().pylon.empty()) return;
  if (!pylons_) {
    pylons_.emplace(simulation);
    pylon_table_.emplace(options_.folder / "pylons.csv", pylons_->headings());
  }
  if (const std::vector<double>* row = pylons_->follow(simulation)) pylon_table_->row(*row);
}

template <int Dim>
void Recorder<Dim>::follow_rasters(const Simulation<Dim>& simulation) {
  if constexpr (Dim == 3) {
    if (!output_.rasters || !simulation.walls().terrain) return;
    if (!rasters_) {
      make_folder(options_.folder / "peaks");
      rasters_.emplace(simulation);
    }
    rasters_->follow(simulation);
  }
}

template <int Dim>
void Recorder<Dim>::write_rasters(const Simulation<Dim>& simulation) {
  if constexpr (Dim == 3) {
    if (!rasters_) return;
    writer_.submit([folder = options_.folder / "peaks", rasters = rasters_->maps(simulation)] {
      for (const Raster& raster : rasters) commit(folder / (raster.name + ".asc"), esri_grid_text(raster.map));
    });
  }
}

template <int Dim>
void Recorder<Dim>::write_frame(const Simulation<Dim>& simulation) {
  const std::uint64_t number = n_frames_++;
  last_frame_at_ = simulation.n_steps();
  const fs::path folder = options_.folder;
  const auto write = [&](const std::string& layer, std::vector<SeriesEntry>& series, auto frame) {
    const std::string name = frame_path(layer, number).string();
    series.push_back({name, simulation.time()});
    writer_.submit([path = folder / name, index = folder / (layer + ".hdf.series"), series, frame = std::move(frame)] {
      commit(path, frame->file());
      commit_series(index, series);
    });
  };
  // Pictures of 3D runs show frames, also where these are not to be written.
  const bool needed = scenery_.has_value();
  std::shared_ptr<const ParticleFrame> snow;
  std::shared_ptr<const SmokeFrame> smoke;
  if (simulation.dense() && (output_.particles || needed))
    snow = std::make_shared<ParticleFrame>(particle_frame(simulation));
  if (simulation.suspension() && (output_.smoke || needed))
    smoke = std::make_shared<SmokeFrame>(smoke_frame(simulation));
  if (output_.particles && snow) write("particles", particle_series_, snow);
  if (output_.smoke && smoke) write("smoke", smoke_series_, smoke);
  if (output_.preview) draw_preview(simulation, number, std::move(snow), std::move(smoke));
  write_rasters(simulation);
  writer_.submit([this] { ++n_committed_; });
  diagnostics_->flush();
  if (pylon_table_) pylon_table_->flush();
  write_summary(simulation, "running", {});
}

template <int Dim>
void Recorder<Dim>::draw_preview(const Simulation<Dim>& simulation, std::uint64_t number,
                                 std::shared_ptr<const ParticleFrame> snow, std::shared_ptr<const SmokeFrame> smoke) {
  const fs::path path = options_.folder / "preview" / fmt::format("{:06}.png", number);
  if constexpr (Dim == 2) {
    writer_.submit([path, frame = preview_frame(simulation)] { commit(path, frame.png()); });
  } else {
    writer_.submit([path, time = simulation.time(), origin = simulation.scene().origin, snow, smoke, this] {
      commit(path, scenery_->png(picture_frame(time, snow.get(), smoke.get(), origin)));
    });
  }
}

template <int Dim>
void Recorder<Dim>::keep(const Simulation<Dim>& simulation) {
  if (output_.frames_per_second > 0 && last_frame_at_ != simulation.n_steps()) write_frame(simulation);
}

template <int Dim>
void Recorder<Dim>::finish(const Simulation<Dim>& simulation, const std::string& status, const std::string& message) {
  write_rasters(simulation);
  writer_.finish();
  if (diagnostics_) diagnostics_->close();
  if (pylon_table_) pylon_table_->close();
  write_summary(simulation, status, message);
  write_film();
}

template <int Dim>
void Recorder<Dim>::give_up(const Simulation<Dim>& simulation, const std::string& message) noexcept {
  const auto tried = [](auto&& f) {
    try {
      f();
    } catch (const std::exception&) {
      // The first failure is the one that is told.
    }
  };
  tried([&] { writer_.finish(); });
  tried([&] { write_summary(simulation, "failed", message); });
}

/// Last of all, so that whoever is ended meanwhile has everything else.
template <int Dim>
void Recorder<Dim>::write_film() {
  if (!output_.preview || n_frames_ == 0) return;
  Film film;
  film.folder = options_.folder;
  film.frames_per_second = output_.frames_per_second;
  film.threads = options_.threads;
  if (const auto why_not = make_film(film); why_not && options_.on_note) options_.on_note(*why_not);
}

template <int Dim>
void Recorder<Dim>::write_summary(const Simulation<Dim>& s, const std::string& status, const std::string& message) {
  using nlohmann::ordered_json;
  const MassLedger& m = s.masses();
  ordered_json run;
  run["status"] = status;
  if (!message.empty()) run["message"] = message;
  run["scene"] = s.scene().scene.name;
  run["scene_file"] = options_.scene_file;
  run["dim"] = Dim;
  run["seed"] = s.scene().scene.seed;
  run["version"] = SPINDRIFT_VERSION;
  run["time"] = s.time();
  run["steps"] = s.n_steps();
  run["n_dense_initial"] = s.n_dense_initial();
  run["n_dense"] = s.dense() ? s.dense()->particles.size() : 0;
  run["n_entrained"] = m.n_entrained;
  run["n_cover"] = s.cover() ? s.cover()->particles.size() - s.cover()->n_dead : 0;
  run["n_vanished"] = m.n_vanished;
  run["n_outflow"] = m.n_outflow;
  run["grid_cells"] = s.suspension() ? s.suspension()->smoke_mass().size() : 0;
  run["active_cells"] = s.suspension() ? open_cells(*s.suspension()) : 0;
  run["mass"] = {{"initial", m.initial},     {"laid", m.laid},          {"injected", m.injected},
                 {"dense", s.dense_mass()},  {"cover", s.cover_mass()}, {"smoke", s.smoke_mass()},
                 {"deposited", m.deposited}, {"outflow", m.outflow()},  {"error_relative", s.mass_error()}};
  run["mass_entrained"] = m.entrained;
  run["smoke_generated"] = m.generated;
  run["smoke_adhered"] = m.adhered;
  run["front_x"] = instruments_.front;
  run["front_speed"] = instruments_.front_speed;
  run["front_speed_max"] = instruments_.front_speed_max;
  run["cloud_height"] = instruments_.cloud_height;
  run["cloud_height_max"] = instruments_.cloud_height_max;
  const RunOut run_out = instruments_.run_out(s);
  run["runout"] = run_out.distance;
  run["runout_drop"] = run_out.drop;
  run["runout_angle"] = run_out.angle * 180 / std::numbers::pi;
  run["head_depth"] = instruments_.head_depth;
  run["head_cloud_height"] = instruments_.head_cloud;
  run["dt_min"] = dt_min_;
  run["dt_mean"] = s.n_steps() > 0 ? s.time() / static_cast<double>(s.n_steps()) : 0;
  run["dt_limiters"] = limiters_;
  run["steps_rejected"] = s.back_off().n_rejected_in_all;
  run["halvings"] = s.back_off().halvings;
  run["wall_seconds"] = wall_seconds();
  double step_seconds = 0;
  ordered_json stages = ordered_json::object();
  for (const Stages::Stage& stage : s.stages().all()) {
    stages[stage.name] = stage.seconds;
    if (stage.name == "step") step_seconds = stage.seconds;
  }
  run["ms_per_step"] = s.n_steps() > 0 ? 1000 * step_seconds / static_cast<double>(s.n_steps()) : 0;
  run["stages"] = stages;
  ordered_json memory = ordered_json::object();
  for (const auto& [part, bytes] : s.memory()) memory[part] = bytes;
  if (rasters_) memory["rasters"] = rasters_->bytes();
  run["memory"] = memory;
  run["threads"] = n_threads();
  run["peak_memory_bytes"] = peak_memory_bytes();
  run["frames"] = n_committed_.load();
  if (status != "running") run["digest"] = state_digest(s);
  commit(options_.folder / "run.json", run.dump(2) + "\n");
}

template class Recorder<2>;
template class Recorder<3>;

}  // namespace spindrift
