#include "simulation/run.hpp"

#include <fmt/format.h>

#include <atomic>
#include <csignal>
#include <memory>

#include "commands.hpp"
#include "plain_text.hpp"
#include "progress_line.hpp"
#include "simulation/plan.hpp"
#include "simulation/scene_reader.hpp"

namespace spindrift {
namespace {

struct RunArguments {
  SceneArguments scene;
  std::string folder, until, seed, frames_per_second;
  int threads = 0;
  bool no_preview = false, quiet = false;
};

std::atomic<bool> stop_asked = false;
static_assert(std::atomic<bool>::is_always_lock_free);

/// The first signal asks the run to stop after its step; a second one ends the program at once.
void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) { stop_asked = true; };
  action.sa_flags = SA_RESETHAND;
  sigaction(SIGINT, &action, nullptr);
  sigaction(SIGTERM, &action, nullptr);
}

/// The options that are short for a --set come after all of them.
std::vector<std::string> settings(const RunArguments& arguments) {
  std::vector<std::string> all = arguments.scene.settings;
  if (!arguments.until.empty()) all.push_back("scene.end_time=" + arguments.until);
  if (!arguments.seed.empty()) all.push_back("scene.seed=" + arguments.seed);
  if (!arguments.frames_per_second.empty()) all.push_back("output.frames_per_second=" + arguments.frames_per_second);
  if (arguments.no_preview) all.emplace_back("output.preview=false");
  return all;
}

std::string_view outcome(ExitCode code) {
  switch (code) {
    case ExitCode::done:
      return "done";
    case ExitCode::resumable:
      return "stopped";
    case ExitCode::unstable:
      return "unstable";
    default:
      return "failed";
  }
}

ExitCode run(const RunArguments& arguments) {
  const Scene scene = read_scene(arguments.scene.file, settings(arguments));
  const std::filesystem::path folder = arguments.folder.empty() ? "runs/" + scene.scene.name : arguments.folder;
  require_fit(scene, plan_scene(scene), folder);
  stop_on_signals();

  ProgressLine line;
  RunOptions options;
  options.folder = folder;
  options.quiet = arguments.quiet;
  options.threads = arguments.threads;
  options.scene_file = arguments.scene.file;
  options.stop = &stop_asked;
  if (!arguments.quiet) options.on_progress = [&line](const Progress& progress) { line.show(progress); };
  std::vector<std::string> notes;
  options.on_note = [&notes](const std::string& note) { notes.push_back(note); };
  const ExitCode code = run_scene(scene, options);

  if (!arguments.quiet) {
    line.end();
    fmt::print(stderr, "{}: {:.6g} s simulated in {} steps and {}\n", outcome(code), line.last().time,
               count_text(static_cast<double>(line.last().step)), duration_text(line.last().wall_seconds));
    for (const std::string& note : notes) fmt::print(stderr, "{}\n", note);
  }
  fmt::print("{}\n", folder.string());
  return code;
}

}  // namespace

void add_run(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("run", "Simulate a scene and write a run folder; prints the folder's name");
  const auto arguments = std::make_shared<RunArguments>();
  add_scene_arguments(*command, arguments->scene);
  command->add_option("-o,--output", arguments->folder, "run folder (default: runs/ and the scene's name)")
      ->type_name("DIR");
  command->add_option("--until", arguments->until, "simulated time at which to end")->type_name("SECONDS");
  command->add_option("--threads", arguments->threads, "threads to use, 0: all (the result does not depend on it)")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
  command->add_option("--seed", arguments->seed, "of all random numbers")->type_name("N");
  command->add_option("--frames-per-second", arguments->frames_per_second, "frames written per simulated second")
      ->type_name("F");
  command->add_flag("--no-preview", arguments->no_preview, "draw no pictures, make no film");
  command->add_flag("--quiet", arguments->quiet, "say nothing unless it fails");
  command->footer(
      "Example:  spindrift run configs/paper/fig09a_bumpy.toml -o runs/long --until 20 --set cover.depth=0.8\n"
      "Ctrl-C ends the run cleanly after the step at hand.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace spindrift
