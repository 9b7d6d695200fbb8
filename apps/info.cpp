#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"

namespace spindrift {
namespace {

using Json = nlohmann::ordered_json;

Json read_run(const std::filesystem::path& folder) {
  const std::filesystem::path file = folder / "run.json";
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw Error(ExitCode::bad_input, folder.string() + ": not a run folder, it has no run.json");
  std::ifstream stream(file);
  if (!stream) throw Error(ExitCode::io_failed, file.string() + ": cannot be read");
  try {
    Json run = Json::parse(stream);
    if (run.is_object()) return run;
  } catch (const Json::exception& problem) {
    throw Error(ExitCode::incompatible_file, file.string() + ": " + problem.what());
  }
  throw Error(ExitCode::incompatible_file, file.string() + ": expected an object");
}

/// One line a value, members of members joined by dots.
void print(const std::string& path, const Json& value) {
  if (value.is_object()) {
    for (const auto& [name, inner] : value.items()) print(path.empty() ? name : path + "." + name, inner);
  } else {
    fmt::print("{:<32} {}\n", path, value.is_string() ? value.get<std::string>() : value.dump());
  }
}

ExitCode info(const std::string& folder, bool as_json) {
  const Json run = read_run(folder);
  if (as_json) {
    fmt::print("{}\n", run.dump(2));
  } else {
    print("", run);
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
