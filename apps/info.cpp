#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "run_folder.hpp"

namespace spindrift {
namespace {

using Json = nlohmann::ordered_json;

/// Of a value of run.json; masses of 2D runs are per metre of width.
std::string_view unit_of(const std::string& path, int dim) {
  const std::string_view mass = dim == 2 ? "kg/m" : "kg";
  if (path == "mass.error_relative") return "";
  if (path.starts_with("mass") || path.starts_with("smoke_")) return mass;
  if (path.starts_with("stages.") || path == "time" || path.starts_with("dt_m") || path == "wall_seconds") return "s";
  if (path == "front_speed" || path == "front_speed_max") return "m/s";
  if (path == "front_x") return "m along the ground";
  if (path == "runout_angle") return "deg";
  if (path.starts_with("runout") || path.starts_with("cloud_height") || path.starts_with("head_")) return "m";
  if (path.starts_with("memory.") || path == "peak_memory_bytes") return "B";
  return path == "ms_per_step" ? "ms" : "";
}

/// Six digits are enough for people; --json has them all.
std::string text_of(const Json& value) {
  if (value.is_string()) return value.get<std::string>();
  return value.is_number_float() ? fmt::format("{:.6g}", value.get<double>()) : value.dump();
}

/// One line a value, members of members joined by dots.
void print(const std::string& path, const Json& value, int dim) {
  if (value.is_object()) {
    for (const auto& [name, inner] : value.items()) print(path.empty() ? name : path + "." + name, inner, dim);
  } else {
    const std::string_view unit = unit_of(path, dim);
    fmt::print("{:<32} {}{}{}\n", path, text_of(value), unit.empty() ? "" : " ", unit);
  }
}

ExitCode info(const std::string& folder, bool as_json) {
  const Json run = read_run_json(folder);
  if (as_json) {
    fmt::print("{}\n", run.dump(2));
  } else {
    print("", run, run.value("dim", 2));
  }
  return ExitCode::done;
}

struct InfoArguments {
  std::string folder;
  bool as_json = false;
};

}  // namespace

void add_info(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("info", "Tell what a run folder holds: status, counts, masses, times");
  const auto arguments = std::make_shared<InfoArguments>();
  command->add_option("DIR", arguments->folder, "run folder")->required()->type_name("");
  command->add_flag("--json", arguments->as_json, "as JSON, for scripts");
  command->footer("Example:  spindrift info runs/fig09a");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return info(arguments->folder, arguments->as_json); }; });
}

}  // namespace spindrift
