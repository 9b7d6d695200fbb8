#include "run_folder.hpp"

#include <fstream>
#include <nlohmann/json.hpp>

#include "core/error.hpp"

namespace spindrift {

nlohmann::ordered_json read_run_json(const std::filesystem::path& folder) {
  using Json = nlohmann::ordered_json;
  const std::filesystem::path file = folder / "run.json";
  std::error_code error;
  if (!std::filesystem::exists(folder, error))
    throw Error(ExitCode::bad_input, folder.string() + ": there is no such folder, expected a run folder");
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

}  // namespace spindrift
