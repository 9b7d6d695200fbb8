#include "simulation/run.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "plain_text.hpp"
#include "run_folder.hpp"
#include "run_talk.hpp"
#include "simulation/plan.hpp"
#include "simulation/scene_reader.hpp"

namespace spindrift {
namespace {

struct RunArguments {
  SceneArguments scene;
  std::string folder, until, seed, frames_per_second;
  int threads = 0;
  std::string profile;
  bool no_preview = false, quiet = false, log_json = false, overwrite = false;
};

std::atomic<bool> stop_asked = false, speak_on_signals = false;
static_assert(std::atomic<bool>::is_always_lock_free);

/// The first signal asks the run to stop after its step; a second one ends the program at once.
void stop_on_signals() {
  struct sigaction action {};
  action.sa_handler = [](int) {
    stop_asked = true;
    constexpr std::string_view text = "\nstopping after this step; once more ends at once\n";
    if (speak_on_signals && write(STDERR_FILENO, text.data(), text.size()) < 0) return;
  };
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

TalkStyle style_of(const RunArguments& arguments) {
  if (arguments.log_json) return TalkStyle::json;
  return arguments.quiet ? TalkStyle::quiet : TalkStyle::text;
}

/// Results of another scene, or files that are no run's, are not replaced unasked.
void guard_folder(const std::filesystem::path& folder, const RunArguments& arguments, RunTalk& talk) {
  std::error_code error;
  if (!std::filesystem::is_directory(folder, error) || std::filesystem::is_empty(folder, error)) return;
  constexpr std::string_view ways_out = "choose another folder with -o, or replace it with --overwrite";
  const auto refuse = [&](const std::string& what) {
    if (!arguments.overwrite)
      throw Error(ExitCode::bad_input, fmt::format("{} {}; {}", folder.string(), what, ways_out));
  };
  if (!std::filesystem::exists(folder / "run.json", error)) return refuse("is not empty and holds no run");
  try {
    const auto run = read_run_json(folder);
    const std::string other = run.value("scene_file", ""), status = run.value("status", "");
    const std::string text = fmt::format("the run of {} ({}, {:g} s)", other, status, run.value("time", 0.0));
    if (other != arguments.scene.file) refuse("holds " + text);
    talk.warn(fmt::format("{}: replacing {}", folder.string(), text));
  } catch (const nlohmann::json::exception&) {
    refuse("holds a run.json that is not ours");
  } catch (const Error& failure) {
    if (failure.code() != ExitCode::incompatible_file) throw;
    refuse("holds a run.json that cannot be read");
  }
}

/// That the profile can be written is found out before the run, not after it.
void require_writable(const std::string& file) {
  if (file.empty() || std::ofstream(file, std::ios::app)) return;
  throw Error(ExitCode::io_failed, fmt::format("{}: cannot be written: {}", file, std::strerror(errno)));
}

ExitCode run(const RunArguments& arguments) {
  std::filesystem::path folder = arguments.folder;
  Plan plan;
  RunTalk talk(style_of(arguments));
  const auto warn = [&talk](const std::string& line) { talk.warn(line); };
  const Scene scene = read_and_judge({arguments.scene.file, settings(arguments)}, folder, plan, warn);
  guard_folder(folder, arguments, talk);
  require_writable(arguments.profile);
  talk.start(scene, plan, folder);
  speak_on_signals = style_of(arguments) == TalkStyle::text;
  stop_on_signals();

  RunOptions options;
  options.folder = folder;
  options.threads = arguments.threads;
  options.scene_file = arguments.scene.file;
  options.stop = &stop_asked;
  options.profile = arguments.profile;
  options.on_progress = [&talk](const Progress& progress) { talk.progress(progress); };
  options.on_note = [&talk](const std::string& note) { talk.note(note); };
  try {
    const ExitCode code = run_scene(scene, options);
    talk.end(code == ExitCode::resumable ? "stopped" : "done");
    fmt::print("{}\n", folder.string());
    return code;
  } catch (const Error& error) {
    talk.fail(error);
    if (!arguments.log_json) throw;
    return error.code();
  }
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
  command->add_flag("--overwrite", arguments->overwrite, "replace what the folder holds, whatever it is");
  command->add_flag("--quiet", arguments->quiet, "say nothing unless it fails");
  command->add_flag("--log-json", arguments->log_json,
                    "tell progress on stderr as JSON, one object a line, for programs");
  command->add_option("--profile", arguments->profile, "write the time of every pass, for ui.perfetto.dev")
      ->type_name("FILE");
  command->footer(
      "Example:  spindrift run configs/paper/fig09a_bumpy.toml -o runs/long --until 20 --set cover.depth=0.8\n"
      "Ctrl-C ends the run cleanly after the step at hand.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace spindrift
