#include "simulation/avaframe.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cctype>
#include <initializer_list>
#include <string>
#include <string_view>

namespace spindrift {
namespace {

namespace fs = std::filesystem;

std::string ending_of(const fs::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// Files in folder/part and folder/Inputs/part that end so, sorted.
std::vector<fs::path> files_in(const fs::path& folder, std::string_view part,
                               std::initializer_list<std::string_view> endings) {
  std::vector<fs::path> files;
  for (const fs::path& place : {folder / part, folder / "Inputs" / part}) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(place, error))
      if (entry.is_regular_file(error) && std::ranges::find(endings, ending_of(entry.path())) != endings.end())
        files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// "avaKot.asc, REL": what is there at all.
std::string listing(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error)) names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  constexpr std::size_t most = 8;
  const std::size_t more = names.size() - std::min(names.size(), most);
  names.resize(names.size() - more);
  if (names.empty()) return "it is empty";
  return fmt::format("it has {}{}", fmt::join(names, ", "), more > 0 ? fmt::format(" and {} more", more) : "");
}

}  // namespace

AvaframeFolder find_avaframe(const fs::path& folder) {
  const auto refuse = [&](const std::string& why) { throw AvaframeError(fmt::format("{}: {}", folder.string(), why)); };
  std::error_code error;
  if (!fs::is_directory(folder, error)) refuse("there is no such folder");
  const std::vector<fs::path> models = files_in(folder, "", {".asc", ".tif", ".tiff"});
  if (models.empty()) refuse("no elevation model, an .asc or .tif, in it or in Inputs/; " + listing(folder));
  if (models.size() > 1) {
    std::vector<std::string> names;
    for (const fs::path& model : models) names.push_back(model.lexically_relative(folder).string());
    refuse(fmt::format("{} elevation models, {}, expected one", models.size(), fmt::join(names, ", ")));
  }
  AvaframeFolder found{models[0], files_in(folder, "REL", {".shp"}), files_in(folder, "ENT", {".shp"}),
                       files_in(folder, "LINES", {".shp"})};
  // Split points and other lines stand in the same folder.
  std::erase_if(found.paths,
                [](const fs::path& file) { return file.stem().string().find("aimec") == std::string::npos; });
  if (found.release.empty()) refuse("no areas of release, a .shp in REL/ or Inputs/REL/; " + listing(folder));
  return found;
}

}  // namespace spindrift
