#include "simulation/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <tuple>
#include <utility>

namespace {
struct PackageAssertion {};
constexpr void package_requires(bool condition) {
  if (!condition) throw PackageAssertion{};
}
}  // namespace

// The package asserts what some malformed texts break, and with NDEBUG takes it for granted: make it an error instead.
#undef NDEBUG
#define TOML_ASSERT(condition) package_requires(static_cast<bool>(condition))
#define TOML_MAX_NESTED_VALUES 16
#include <toml++/toml.h>

namespace spindrift {
namespace {

Place place_of(const toml::source_region& region) {
  return {region.begin.line, region.begin.column};
}

TomlValue literal_of(const toml::node& node);

TomlTable table_of(const toml::table& source) {
  TomlTable table;
  for (const auto& [key, node] : source)
    table.push_back({std::string(key.str()), place_of(key.source()), {literal_of(node)}});
  std::sort(table.begin(), table.end(), [](const TomlMember& a, const TomlMember& b) {
    return std::tie(a.place.line, a.place.column) < std::tie(b.place.line, b.place.column);
  });
  return table;
}

TomlValue literal_of(const toml::node& node) {
  const Place place = place_of(node.source());
  if (const auto* table = node.as_table()) return {table_of(*table), place};
  if (const auto* boolean = node.as_boolean()) return {boolean->get(), place};
  if (const auto* integer = node.as_integer()) return {integer->get(), place};
  if (const auto* number = node.as_floating_point()) return {number->get(), place};
  if (const auto* string = node.as_string()) return {string->get(), place};
  const auto* array = node.as_array();
  if (array == nullptr) return {TomlDate{}, place};
  TomlList list;
  for (const toml::node& item : *array) list.push_back(literal_of(item));
  return {std::move(list), place};
}

/// The TOML package bounds how deep values nest, but not how often a name is dotted, and frees nested tables
/// recursively. Strings over several lines, which no scene needs, would blur where names begin.
void refuse_deep_names(std::string_view text) {
  constexpr int most = 16;
  int dots = 0;
  const auto refuse = [&](std::size_t at, const char* why) {
    const std::string_view before = text.substr(0, at);
    const auto line = static_cast<std::uint32_t>(std::count(before.begin(), before.end(), '\n'));
    const std::size_t line_start = before.rfind('\n') + 1;
    throw SyntaxError{{line + 1, static_cast<std::uint32_t>(at - line_start + 1)}, why};
  };
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size());
      dots = 0;
    } else if (c == '"' || c == '\'') {
      if (text.substr(i, 3) == std::string(3, c)) refuse(i, "strings over several lines are not allowed");
      for (++i; i < text.size() && text[i] != c && text[i] != '\n'; ++i)
        if (c == '"' && text[i] == '\\') ++i;
    } else if (c == '.') {
      if (++dots > most) refuse(i, "a name may have at most 16 parts");
    } else if (std::string_view("\n,[]{}=").find(c) != std::string_view::npos) {
      dots = 0;
    }
  }
}

TomlValue literal_or_word(std::string_view text) {
  try {
    const TomlTable table = parse_toml("v = " + std::string(text));
    if (table.size() == 1 && table[0].name == "v") return table[0].value[0];
  } catch (const SyntaxError&) {
    return {std::string(text), {}};
  }
  return {std::string(text), {}};
}

void mark_as_given(TomlValue& literal) {
  literal.place = {0, 0};
  if (auto* list = std::get_if<TomlList>(&literal.value)) std::for_each(list->begin(), list->end(), mark_as_given);
  if (auto* table = std::get_if<TomlTable>(&literal.value)) {
    for (TomlMember& member : *table) {
      member.place = {0, 0};
      mark_as_given(member.value[0]);
    }
  }
}

TomlMember& member_of(TomlTable& table, std::string_view name) {
  const auto found = std::find_if(table.begin(), table.end(), [&](const TomlMember& m) { return m.name == name; });
  if (found != table.end()) return *found;
  table.push_back({std::string(name), {0, 0}, {TomlValue{TomlTable{}, {0, 0}}}});
  return table.back();
}

struct IndexedName {
  std::string_view name;
  std::optional<std::size_t> index;
};

/// "release[1]" as release, 1.
IndexedName indexed_name(std::string_view text) {
  const std::size_t bracket = text.find('[');
  if (bracket == std::string_view::npos || text.back() != ']') return {text, std::nullopt};
  std::size_t index = 0;
  const char* end = text.data() + text.size() - 1;
  const auto read = std::from_chars(text.data() + bracket + 1, end, index);
  if (read.ec != std::errc() || read.ptr != end) return {text, std::nullopt};
  return {text.substr(0, bracket), index};
}

}  // namespace

TomlTable parse_toml(std::string_view text) {
  refuse_deep_names(text);
  try {
    return table_of(toml::parse(text, std::string_view{}));
  } catch (const toml::parse_error& error) {
    throw SyntaxError{place_of(error.source()), std::string(error.description())};
  } catch (const PackageAssertion&) {
    throw SyntaxError{{}, "somewhere in this file something is not TOML"};
  }
}

std::optional<std::string> set_member(TomlTable& table, std::string_view path, std::string_view text) {
  const std::size_t dot = path.find('.');
  const IndexedName part = indexed_name(path.substr(0, dot));
  TomlMember& member = member_of(table, part.name);
  TomlValue* value = &member.value[0];
  if (dot == std::string_view::npos) {
    *value = literal_or_word(text);
    mark_as_given(*value);
    member.place = {0, 0};
    return std::nullopt;
  }
  std::size_t count = 1;
  if (auto* list = std::get_if<TomlList>(&value->value)) {
    count = list->size();
    if (part.index.value_or(0) < count) value = &(*list)[part.index.value_or(0)];
  }
  if (count > 1 && !part.index)
    return fmt::format("which of the {}? {}[0] to {}[{}]", count, part.name, part.name, count - 1);
  if (part.index.value_or(0) >= count)
    return fmt::format("there is no {}[{}]; the scene has {}, counted from 0", part.name, *part.index, count);
  if (!std::holds_alternative<TomlTable>(value->value)) *value = {TomlTable{}, {0, 0}};
  return set_member(std::get<TomlTable>(value->value), path.substr(dot + 1), text);
}

}  // namespace spindrift
