#include "simulation/run.hpp"

#include "core/parallel.hpp"
#include "io/chrome_trace.hpp"
#include "simulation/recorder.hpp"

namespace spindrift {
namespace {

template <int Dim>
Progress progress_of(const Simulation<Dim>& s, double wall_seconds) {
  Progress progress;
  progress.time = s.time();
  progress.end_time = s.scene().scene.end_time;
  progress.dt = s.report().dt;
  progress.limiter = s.report().limiter;
  progress.step = s.n_steps();
  progress.n_dense = s.dense() ? s.dense()->particles.size() : 0;
  progress.n_entrained = s.masses().n_entrained;
  progress.smoke_mass = s.smoke_mass();
  progress.wall_seconds = wall_seconds;
  return progress;
}

constexpr std::size_t most_passes = 4'000'000;  // about 400 MB of text

void write_profile(const std::filesystem::path& path, const Stages& stages) {
  std::vector<TraceSpan> spans;
  for (const Stages::Pass& pass : stages.kept())
    spans.push_back({stages.all()[pass.stage].name, pass.start, pass.duration});
  write_chrome_trace(path, spans);
}

/// Steps until the end, or until asked to stop.
template <int Dim>
ExitCode step_to_end(Simulation<Dim>& simulation, Recorder<Dim>& recorder, const RunOptions& options) {
  const auto record = [&] {
    const auto timed = simulation.stages().time("output");
    recorder.follow(simulation);
  };
  record();
  while (!simulation.done()) {
    if (options.stop && options.stop->load()) {
      recorder.finish(simulation, "stopped");
      return ExitCode::resumable;
    }
    try {
      simulation.step();
    } catch (const Error& failure) {
      if (failure.code() != ExitCode::unstable) throw;
      recorder.keep(simulation);
      recorder.finish(simulation, "unstable", failure.what());
      throw;
    }
    record();
    if (options.on_progress) options.on_progress(progress_of(simulation, recorder.wall_seconds()));
  }
  recorder.finish(simulation, "done");
  return ExitCode::done;
}

template <int Dim>
ExitCode run_in(const Scene& scene, const RunOptions& options) {
  const ThreadLimit threads(options.threads);
  Simulation<Dim> simulation(scene);
  Recorder<Dim> recorder(scene, options);
  if (!options.profile.empty()) simulation.stages().keep_passes(most_passes);
  try {
    const ExitCode code = step_to_end(simulation, recorder, options);
    if (!options.profile.empty()) write_profile(options.profile, simulation.stages());
    return code;
  } catch (const Error& failure) {
    if (failure.code() == ExitCode::io_failed) recorder.give_up(simulation, failure.what());
    throw;
  }
}

}  // namespace

ExitCode run_scene(const Scene& scene, const RunOptions& options) {
  return scene.scene.dim == 3 ? run_in<3>(scene, options) : run_in<2>(scene, options);
}

}  // namespace spindrift
