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

/// The passes of a run, for a Chrome trace.
template <int Dim>
class Profile {
 public:
  Profile(Simulation<Dim>& simulation, const std::filesystem::path& path) : stages_(simulation.stages()), path_(path) {
    constexpr std::size_t most = 4'000'000;  // about 400 MB of text
    if (!path_.empty()) stages_.keep_passes(most);
  }
  void write() const {
    if (path_.empty()) return;
    std::vector<TraceSpan> spans;
    for (const Stages::Pass& pass : stages_.kept())
      spans.push_back({stages_.all()[pass.stage].name, pass.start, pass.duration});
    write_chrome_trace(path_, spans);
  }

 private:
  Stages& stages_;
  const std::filesystem::path& path_;
};

template <int Dim>
ExitCode run_in(const Scene& scene, const RunOptions& options) {
  const ThreadLimit threads(options.threads);
  Simulation<Dim> simulation(scene);
  Recorder<Dim> recorder(scene, options);
  const Profile<Dim> profile(simulation, options.profile);
  const auto record = [&] {
    const auto timed = simulation.stages().time("output");
    recorder.follow(simulation);
  };
  record();
  while (!simulation.done()) {
    if (options.stop && options.stop->load()) {
      recorder.finish(simulation, "stopped");
      profile.write();
      return ExitCode::resumable;
    }
    try {
      simulation.step();
    } catch (const Error& failure) {
      if (failure.code() != ExitCode::unstable) throw;
      recorder.finish(simulation, "unstable", failure.what());
      profile.write();
      throw;
    }
    record();
    if (options.on_progress) options.on_progress(progress_of(simulation, recorder.wall_seconds()));
  }
  recorder.finish(simulation, "done");
  profile.write();
  return ExitCode::done;
}

}  // namespace

ExitCode run_scene(const Scene& scene, const RunOptions& options) {
  return scene.scene.dim == 3 ? run_in<3>(scene, options) : run_in<2>(scene, options);
}

}  // namespace spindrift
