#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <utility>

#include "commands.hpp"
#include "core/parallel.hpp"
#include "io/commit.hpp"
#include "plain_text.hpp"
#include "simulation/spelling.hpp"
#include "verification/cases.hpp"
#include "verification/refinement.hpp"
#include "verification/stability.hpp"
#include "verification/study_page.hpp"

namespace spindrift {
namespace {

struct VerifyArguments {
  std::vector<std::string> what, settings;
  std::string folder = "verification";
  int threads = 0, repeats = 3;
  bool list = false, quick = false, stability = false;
};

void say(const std::string& line) {
  fmt::print(stderr, "{}\n", line);
}

ExitCode list_cases() {
  for (const Case& one : verification_cases())
    fmt::print("{:<22} {}{}\n", one.name, one.title, one.quick ? " (quick)" : "");
  return ExitCode::done;
}

/// The cases of those names, in the order of the page; all, or the quick ones, where none is named.
std::vector<Case> chosen_cases(const VerifyArguments& arguments) {
  std::vector<Case> all = verification_cases();
  std::vector<std::string_view> names;
  for (const Case& one : all) names.push_back(one.name);
  for (const std::string& name : arguments.what)
    if (std::ranges::find(names, name) == names.end())
      throw Error(ExitCode::bad_input,
                  fmt::format("there is no verification case \"{}\"{}; --list names them, and a scene of your own ends "
                              "with .toml",
                              name, did_you_mean(name, names)));
  std::erase_if(all, [&](const Case& one) {
    return arguments.what.empty() ? arguments.quick && !one.quick
                                  : std::ranges::find(arguments.what, one.name) == arguments.what.end();
  });
  return all;
}

void tell_point(const Case& what, const Point& point) {
  const std::string head =
      fmt::format("{:<20} {:<12} {:<28} {:<16}", what.name, point.factor, point.series, point.level);
  if (!point.failure.empty()) return say(head + " failed: " + point.failure);
  say(fmt::format("{} error {:<10.3g} {:>8.2f} s{}", head, point.outcome.l2, point.cost.seconds,
                  point.inside() ? "" : "  outside its gates"));
}

ExitCode verify_cases(const VerifyArguments& arguments) {
  const std::vector<Case> cases = chosen_cases(arguments);
  make_folder(arguments.folder);
  StudyOptions options;
  options.quick = arguments.quick;
  options.repeats = arguments.repeats;
  options.on_point = tell_point;
  std::vector<CaseResult> results;
  std::size_t n_outside = 0;
  for (const Case& one : cases) {
    results.push_back(run_case(one, options));
    write_points(arguments.folder, results);
    const bool passed = results.back().passed();
    if (!passed) ++n_outside;
    say(fmt::format("{}/{} {}: {} its gates", results.size(), cases.size(), one.name, passed ? "inside" : "outside"));
  }
  write_study(arguments.folder, results, say);
  say(fmt::format("{} cases, {} outside their gates", results.size(), n_outside));
  fmt::print("{}/verification.md\n", arguments.folder);
  return ExitCode::done;
}

ExitCode refine_scene(const VerifyArguments& arguments) {
  if (arguments.what.size() > 1)
    throw Error(ExitCode::bad_input,
                fmt::format("{} is a scene, and a scene is refined alone", arguments.what.front()));
  std::filesystem::path folder = arguments.folder;
  Plan plan;
  const Scene scene = read_and_judge({arguments.what.front(), arguments.settings}, folder, plan, say);
  double seconds = 0;
  std::vector<RefinedRun> runs = planned_runs(scene, arguments.quick);
  for (const RefinedRun& run : runs) {
    const Scene finer = scaled(scene, run.factor, run.scale);
    const Plan its_plan = plan_scene(finer);
    require_fit(finer, its_plan, folder);
    seconds += its_plan.seconds;
  }
  say(fmt::format("{} runs, about {}, up to three times more or less", runs.size(), duration_text(seconds)));
  make_folder(folder);
  const Refinement refinement = refine(scene, std::move(runs), [](const RefinedRun& run) {
    if (!run.failure.empty())
      return say(fmt::format("{:<12} x {:<6.3g} failed: {}", run.factor, run.scale, run.failure));
    std::string line = fmt::format("{:<12} x {:<6.3g} {:>8.2f} s", run.factor, run.scale, run.cost.seconds);
    for (const Reading& reading : run.readings) line += fmt::format("  {} {:.5g}", reading.name, reading.value);
    say(line);
  });
  write_refinement(folder, refinement, say);
  fmt::print("{}\n", (folder / "refinement.md").string());
  return ExitCode::done;
}

ExitCode verify_stability(const VerifyArguments& arguments) {
  make_folder(arguments.folder);
  std::vector<Trial> trials = extreme_trials();
  for (Trial& point : map_trials(arguments.quick ? 100 : 300)) trials.push_back(std::move(point));
  std::vector<TrialResult> results;
  std::size_t n_bad = 0;
  for (const Trial& trial : trials) {
    results.push_back(run_trial(trial));
    const TrialResult& r = results.back();
    if (!r.good()) ++n_bad;
    if (!r.good() || trial.set != "map" || results.size() % 20 == 0)
      say(fmt::format("{:>3}/{} {:<4} {:<44} {}{}", results.size(), trials.size(), trial.set, trial.name,
                      name_of(r.verdict), r.good() ? "" : ", not as it should: " + r.reason));
  }
  write_stability(arguments.folder, results, say);
  say(fmt::format("{} trials, {} not as they should", results.size(), n_bad));
  fmt::print("{}/stability.md\n", arguments.folder);
  return ExitCode::done;
}

ExitCode verify(const VerifyArguments& arguments) {
  if (arguments.list) return list_cases();
  const ThreadLimit threads(arguments.threads);
  if (arguments.stability && !(arguments.what.empty() && arguments.settings.empty()))
    throw Error(ExitCode::bad_input, "--stability has scenes and settings of its own, and takes none");
  if (arguments.stability) return verify_stability(arguments);
  const bool scene = std::ranges::any_of(arguments.what, [](const std::string& w) { return w.ends_with(".toml"); });
  if (scene) return refine_scene(arguments);
  if (!arguments.settings.empty())
    throw Error(ExitCode::bad_input, "--set changes a scene of your own; the cases bring their settings");
  return verify_cases(arguments);
}

}  // namespace

void add_verify(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("verify", "Measure errors against run time, of known cases or of your scene");
  const auto arguments = std::make_shared<VerifyArguments>();
  command->add_option("CASE|SCENE.toml", arguments->what, "cases to run (default: all), or one scene to refine")
      ->type_name("");
  command->add_option("-o,--output", arguments->folder, "folder of the pages, tables and pictures")
      ->type_name("DIR")
      ->capture_default_str();
  command->add_flag("--list", arguments->list, "name the cases, with a line each");
  command->add_flag("--stability", arguments->stability, "try extreme scenes and a map of stiff ones instead");
  command->add_flag("--quick", arguments->quick,
                    "the cases marked quick at two levels, once each; a map of 100 points");
  command->add_option("--repeats", arguments->repeats, "of every run, for the median of its time")
      ->check(CLI::Range(1, 100))
      ->type_name("N")
      ->capture_default_str();
  command->add_option("--threads", arguments->threads, "threads to use, 0: all")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
  add_settings(*command, arguments->settings);
  command->footer("Example:  spindrift verify dam_break cavity -o verification");
  command->callback([arguments, &chosen] { chosen = [arguments] { return verify(*arguments); }; });
}

}  // namespace spindrift
