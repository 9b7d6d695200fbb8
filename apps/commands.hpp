#pragma once
/// The commands of the program, one file each.

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "core/error.hpp"
#include "simulation/plan.hpp"

namespace spindrift {

/// What the command line asked for: filled by the parser, called by main.
using Command = std::function<ExitCode()>;

void add_run(CLI::App& app, Command& chosen);
void add_check(CLI::App& app, Command& chosen);
void add_scene(CLI::App& app, Command& chosen);
void add_info(CLI::App& app, Command& chosen);
void add_completion(CLI::App& app, Command& chosen);
void add_export(CLI::App& app, Command& chosen);
void add_render(CLI::App& app, Command& chosen);
void add_verify(CLI::App& app, Command& chosen);

/// Calls f for every option of the command that has a long name, those of its groups too.
void for_each_option(const CLI::App& command, const std::function<void(const CLI::Option&)>& f);

/// A scene file and what the command line changes in it.
struct SceneArguments {
  std::string file;
  std::vector<std::string> settings;
};

/// Reads the scene, refuses one that does not fit into this machine, and warns of what hardly makes sense in it.
/// folder   where its results will go; empty: runs/ and the scene's name
Scene read_and_judge(const SceneArguments& arguments, std::filesystem::path& folder, Plan& plan,
                     const std::function<void(const std::string&)>& warn);

void add_scene_arguments(CLI::App& command, SceneArguments& arguments);
/// The option --set alone.
void add_settings(CLI::App& command, std::vector<std::string>& settings);

}  // namespace spindrift
