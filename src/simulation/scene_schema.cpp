#include "simulation/scene_schema.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "simulation/registry.hpp"
#include "simulation/scene_writer.hpp"

namespace spindrift {
namespace {

using Json = nlohmann::ordered_json;

std::string description(const Key& key) {
  std::string text(key.doc);
  if (!key.unit.empty()) text += fmt::format(" [{}]", key.unit);
  if (!key.condition.name.empty())
    text += fmt::format(" ({}: {})", key.condition.name, fmt::join(key.condition.values, ", "));
  if (!key.source.empty()) text += fmt::format(" ({})", key.source);
  return text;
}

/// A number, in SI or, where it has a unit, as text with one.
Json number_schema(const Key& key, const char* type) {
  Json number = {{"type", type}};
  if (std::isfinite(key.range.low)) number[key.range.above_low ? "exclusiveMinimum" : "minimum"] = key.range.low;
  if (std::isfinite(key.range.high)) number[key.range.below_high ? "exclusiveMaximum" : "maximum"] = key.range.high;
  if (key.unit.empty()) return number;
  return {{"anyOf", Json::array({number, {{"type", "string"}}})}};
}

struct TypeOf {
  const Key& key;

  Json operator()(const bool*) const { return {{"type", "boolean"}}; }
  Json operator()(const int*) const { return number_schema(key, "integer"); }
  Json operator()(const std::uint64_t*) const { return number_schema(key, "integer"); }
  Json operator()(const double*) const { return number_schema(key, "number"); }
  Json operator()(const std::string*) const {
    if (key.words.empty()) return {{"type", "string"}};
    return {{"enum", key.words}};
  }
  Json operator()(const std::vector<double>*) const {
    return list(number_schema(key, "number"), key.in_plan ? 1 : 2, key.in_plan ? 2 : 3);
  }
  Json operator()(const std::array<double, 2>*) const { return list(number_schema(key, "number"), 2, 2); }
  Json operator()(const std::vector<std::array<double, 2>>*) const {
    return {{"type", "array"}, {"items", list(number_schema(key, "number"), 2, 2)}};
  }
  Json operator()(const std::vector<std::vector<std::array<double, 2>>>*) const {
    const std::vector<std::array<double, 2>>* const outline = nullptr;
    return {{"type", "array"}, {"items", (*this)(outline)}};
  }

  static Json list(const Json& item, int least, int most) {
    return {{"type", "array"}, {"items", item}, {"minItems", least}, {"maxItems", most}};
  }
};

Json default_of(Slot field) {
  return std::visit([](const auto* value) { return Json(*value); }, field);
}

Json object_schema(std::string_view doc) {
  return {{"type", "object"}, {"description", doc}, {"additionalProperties", false}, {"properties", Json::object()}};
}

/// The properties of the section at `path`, which is made on the way where it does not exist.
Json& properties_at(Json& root, std::string_view path) {
  Json* at = &root["properties"];
  while (!path.empty()) {
    const std::size_t dot = std::min(path.find('.'), path.size());
    at = &(*at)[std::string(path.substr(0, dot))]["properties"];
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return *at;
}

}  // namespace

std::string scene_schema() {
  Scene scene = complete_scene("physical");
  Json root = {{"$schema", "http://json-schema.org/draft-07/schema#"}, {"title", "Spindrift scene"}};
  root.update(object_schema("A mixed-motion avalanche"));
  root["required"] = {"schema_version", "domain"};
  root["properties"]["schema_version"] = {{"const", 1}};
  for (const Section& section : sections()) {
    const std::size_t dot = section.path.rfind('.');
    const std::string_view parent = dot == std::string_view::npos ? "" : section.path.substr(0, dot);
    const std::string_view name = dot == std::string_view::npos ? section.path : section.path.substr(dot + 1);
    Json schema = object_schema(section.doc);
    if (section.repeats) schema["type"] = {"object", "array"};
    properties_at(root, parent)[std::string(name)] = schema;
  }
  for (const Key& key : keys()) {
    const Slot field = key.field(scene);
    Json property = {{"description", description(key)}};
    property.update(std::visit(TypeOf{key}, field));
    if (has_value(field)) property["default"] = default_of(field);
    properties_at(root, key.section())[std::string(key.name())] = property;
  }
  for (const Section& section : sections()) {
    if (!section.repeats) continue;
    Json& several = root["properties"][std::string(section.path)];
    Json one = several;
    one["type"] = "object";
    several["items"] = one;
  }
  return root.dump(2) + "\n";
}

std::string described_defaults(std::string_view preset) {
  Scene scene = complete_scene(preset);
  std::string text = "schema_version = 1\n";
  for (const Section& section : sections()) {
    // What a scene cannot have without saying where stands there as a comment.
    const auto wanted = [&](const char* name) {
      const Key* place = find_key(fmt::format("{}.{}", section.path, name));
      return place != nullptr && applies(*place, scene, 0);
    };
    const bool whole = section.repeats ? !wanted("lower") && !wanted("position") : !wanted("points");
    text += fmt::format("\n{}[{}]  # {}\n", whole ? "" : "# ", section.path, section.doc);
    for (const Key& key : keys()) {
      if (key.section() != section.path) continue;
      const Slot field = key.field(scene);
      std::string words;
      for (const std::string_view word : key.words) words += fmt::format("{}\"{}\"", words.empty() ? "" : " | ", word);
      const std::string line = fmt::format("{}{} = {}", whole && applies(key, scene, 0) && has_value(field) ? "" : "# ",
                                           key.name(), readable_text(key, field));
      text += fmt::format("{:<40} # {}{}\n", line, description(key), words.empty() ? "" : ": " + words);
    }
  }
  return text;
}

}  // namespace spindrift
