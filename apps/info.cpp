#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "commands.hpp"
#include "run_folder.hpp"

namespace spindrift {
namespace {

using Json = nlohmann::ordered_json;

/// One line a value, members of members joined by dots.
void print(const std::string& path, const Json& value) {
  if (value.is_object()) {
    for (const auto& [name, inner] : value.items()) print(path.empty() ? name : path + "." + name, inner);
  } else {
    fmt::print("{:<32} {}\n", path, value.is_string() ? value.get<std::string>() : value.dump());
  }
}

ExitCode info(const std::string& folder, bool as_json) {
  const Json run = read_run_json(folder);
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
