#include "simulation/scene_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "simulation/spelling.hpp"

namespace spindrift {
namespace {

[[noreturn]] void refuse(const std::string& file, std::string_view why) {
  throw Error(ExitCode::bad_input, fmt::format("{}: {}", file, why));
}

/// The scene beside it whose name is nearest.
std::string suggest_scene(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::path folder = file.has_parent_path() ? file.parent_path() : ".";
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().filename().string());
  std::sort(names.begin(), names.end());
  return did_you_mean(file.filename().string(), std::vector<std::string_view>(names.begin(), names.end()));
}

}  // namespace

std::string scene_name(const std::string& file) {
  std::string name = std::filesystem::path(file).stem().string().substr(0, 64);
  for (char& c : name)
    if (!(c >= 'a' && c <= 'z') && !(c >= 'A' && c <= 'Z') && !(c >= '0' && c <= '9') && c != '.' && c != '_') c = '-';
  return name.empty() || name == "." || name == ".." ? "scene" : name;
}

std::string scene_text(const std::filesystem::path& file) {
  constexpr std::size_t most = 4 * 1024 * 1024;
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) refuse(file.string(), "there is no such file" + suggest_scene(file));
  if (!std::filesystem::is_regular_file(status)) refuse(file.string(), "not a regular file");
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> stream(std::fopen(file.c_str(), "rb"), &std::fclose);
  if (!stream) refuse(file.string(), "cannot be opened for reading");
  std::string text(most + 1, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), stream.get()));
  if (text.size() > most) refuse(file.string(), "longer than the 4 MB that a scene may have");
  if (std::ferror(stream.get()) != 0) refuse(file.string(), "cannot be read");
  return text;
}

}  // namespace spindrift
