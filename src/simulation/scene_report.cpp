#include "simulation/scene_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "core/error.hpp"
#include "simulation/units.hpp"

namespace spindrift {
namespace {

/// In quotes, on one line, at most about 40 bytes, cut between characters.
std::string quoted(std::string_view text) {
  constexpr std::size_t longest = 40;
  std::string out = "\"";
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (i >= longest && (c & 0xC0U) != 0x80U) return out + "...\"";
    out += c < 0x20 || c == 0x7F ? fmt::format("\\x{:02x}", c) : std::string(1, text[i]);
  }
  return out + "\"";
}

struct Describe {
  std::string operator()(bool b) const { return b ? "true" : "false"; }
  std::string operator()(std::int64_t n) const { return std::to_string(n); }
  std::string operator()(double x) const { return number_text(x); }
  std::string operator()(const std::string& s) const { return quoted(s); }
  std::string operator()(TomlDate) const { return "a date"; }
  std::string operator()(const TomlList& l) const { return fmt::format("a list of {}", l.size()); }
  std::string operator()(const TomlTable&) const { return "a section"; }
};

}  // namespace

void SceneReport::add(const Place& place, std::string_view path, std::string_view what) {
  lines_.push_back({place, fmt::format("{}: {}: {}", text_of(place), path, what)});
  bad_paths_.emplace(path);
}

bool SceneReport::good(std::initializer_list<std::string_view> paths) const {
  for (std::string_view path : paths) {
    while (!bad_paths_.contains(path)) {
      const std::size_t dot = path.rfind('.');
      if (dot == std::string_view::npos) break;
      path = path.substr(0, dot);
    }
    if (bad_paths_.contains(path)) return false;
  }
  return true;
}

std::string SceneReport::text_of(const Place& place) const {
  return place.line == 0 ? "--set" : fmt::format("{}:{}:{}", file_, place.line, place.column);
}

void SceneReport::throw_if_bad() const {
  if (lines_.empty()) return;
  constexpr std::size_t most = 20;
  std::vector<const Line*> sorted;
  for (const Line& line : lines_) sorted.push_back(&line);
  std::stable_sort(sorted.begin(), sorted.end(), [](const Line* a, const Line* b) {
    return std::tuple(a->place.line == 0, a->place.line, a->place.column) <
           std::tuple(b->place.line == 0, b->place.line, b->place.column);
  });
  std::string text;
  for (std::size_t i = 0; i < std::min(most, sorted.size()); ++i) text += (i > 0 ? "\n" : "") + sorted[i]->text;
  if (sorted.size() > most) text += fmt::format("\n{} more errors", sorted.size() - most);
  throw Error(ExitCode::bad_input, text);
}

std::string text_of(const TomlValue& literal) {
  return std::visit(Describe{}, literal.value);
}

}  // namespace spindrift
