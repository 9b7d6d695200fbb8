#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "commands.hpp"
#include "core/parallel.hpp"
#include "io/esri_grid.hpp"
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

/// To the centimetre.
std::string metres(double x) {
  return fmt::format("{}", std::round(100 * x) / 100);
}

std::string model_text(const ElevationGrid& model) {
  const auto holes = std::ranges::count_if(model.z, [](double z) { return std::isnan(z); });
  return fmt::format("{} x {} heights, {:g} m apart, {:.0f} % of them holes", model.columns, model.rows, model.cell,
                     100.0 * static_cast<double>(holes) / static_cast<double>(model.z.size()));
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
  std::string extent;
  for (std::size_t k = 0; k < scene.domain.lower.size(); ++k)
    extent += fmt::format("{}{} {} to {} m", k > 0 ? ", " : "", scene.scene.dim == 2 ? "xz"[k] : "xyz"[k],
                          metres(scene.domain.lower[k]), metres(scene.domain.upper[k]));
  row("extent", "{}", extent);
  if (scene.elevation) row("terrain", "{}", model_text(*scene.elevation));
  if (plan.release_area > 0) row("release", "{:.0f} m^2 of ground, {:.0f} m^3", plan.release_area, plan.release_volume);
  if (plan.cover_area > 0) row("cover", "{:.0f} m^2 of ground, {:g} m deep", plan.cover_area, scene.cover->depth);
  const std::string laid = plan.n_laid < plan.n_cover ? fmt::format(", {} of them laid", count_text(plan.n_laid)) : "";
  row("particles", "about {} released, {} in the cover{}", count_text(plan.n_release), count_text(plan.n_cover), laid);
  if (scene.suspension && scene.suspension->tiles)
    row("cells", "about {}, on tiles (the limit is {})", count_text(plan.n_cells), grid);
  else
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
