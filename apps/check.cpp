#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "commands.hpp"
#include "core/parallel.hpp"
#include "plain_text.hpp"
#include "simulation/plan.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/scene_warnings.hpp"

namespace spindrift {
namespace {

template <class... T>
void row(std::string_view name, fmt::format_string<T...> format, T&&... values) {
  fmt::print("{:<11} {}\n", name, fmt::format(format, std::forward<T>(values)...));
}

ExitCode check(const SceneArguments& arguments) {
  std::filesystem::path folder;
  Plan plan;
  const Scene scene =
      read_and_judge(arguments, folder, plan, [](const std::string& line) { fmt::print(stderr, "{}\n", line); });

  std::string grid = "none";
  for (std::size_t k = 0; k < plan.grid.size(); ++k)
    grid = k == 0 ? count_text(plan.grid[k]) : grid + " x " + count_text(plan.grid[k]);
  row("scene", "{}, {}D, {:g} s", scene.scene.name, scene.scene.dim, scene.scene.end_time);
  row("particles", "about {} released, {} in the cover", count_text(plan.n_release), count_text(plan.n_cover));
  row("cells", "{} ({})", count_text(plan.n_cells), grid);
  row("frames", "{}", count_text(plan.n_frames));
  row("memory", "about {}, {} available", bytes_text(plan.memory), bytes_text(memory_available()));
  row("disk", "about {}, {} left at {}", bytes_text(plan.disk), bytes_text(disk_available(folder)), folder.string());
  row("steps", "about {}", count_text(std::round(plan.n_steps / 10) * 10));
  row("time", "about {} on {} threads, up to three times more or less", duration_text(plan.seconds), n_threads());
  return ExitCode::done;
}

}  // namespace

Scene read_and_judge(const SceneArguments& arguments, std::filesystem::path& folder, Plan& plan,
                     const std::function<void(const std::string&)>& warn) {
  Origins origins;
  const Scene scene = read_scene(arguments.file, arguments.settings, &origins);
  if (folder.empty()) folder = "runs/" + scene.scene.name;
  plan = plan_scene(scene);
  require_fit(scene, plan, folder);
  for (const std::string& line : scene_warnings(scene, origins)) warn(line);
  return scene;
}

void add_scene_arguments(CLI::App& command, SceneArguments& arguments) {
  command.add_option("SCENE.toml", arguments.file, "scene file")->required()->type_name("");
  add_settings(command, arguments.settings);
}

void add_settings(CLI::App& command, std::vector<std::string>& settings) {
  command.add_option("--set", settings, "change one value of the scene, as in --set terrain.angle='40 deg'")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_check(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("check", "Check a scene without running it; prints what the run would need");
  const auto arguments = std::make_shared<SceneArguments>();
  add_scene_arguments(*command, *arguments);
  command->footer("Example:  spindrift check my_slope.toml --set suspension.cell_size=0.5");
  command->callback([arguments, &chosen] { chosen = [arguments] { return check(*arguments); }; });
}

}  // namespace spindrift
