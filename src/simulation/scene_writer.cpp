#include "simulation/scene_writer.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "simulation/registry.hpp"
#include "simulation/units.hpp"

namespace spindrift {
namespace {

struct TomlText {
  std::string operator()(const bool* b) const { return *b ? "true" : "false"; }
  std::string operator()(const int* n) const { return std::to_string(*n); }
  std::string operator()(const std::uint64_t* n) const { return std::to_string(*n); }
  std::string operator()(const double* x) const { return number_text(*x); }
  std::string operator()(const std::string* s) const {
    std::string text = "\"";
    for (const char c : *s) text += c == '"' || c == '\\' ? std::string{'\\', c} : std::string(1, c);
    return text + "\"";
  }
  template <class Items>
  std::string operator()(const Items* items) const {
    std::string text = "[";
    for (const auto& item : *items) text += (text.size() > 1 ? ", " : "") + (*this)(&item);
    return text + "]";
  }
};

/// "[m]"; angles also in degrees.
std::string unit_text(const Key& key, Slot field) {
  if (key.unit.empty()) return "";
  return key.unit == "rad" ? "[rad], " + degrees_text(*std::get<double*>(field)) : fmt::format("[{}]", key.unit);
}

/// "  # [m], my.toml:12:9"
std::string comment(const Key& key, const std::string& path, Slot field, const Origins* origins) {
  std::string text = unit_text(key, field);
  if (origins != nullptr) {
    const auto origin = origins->find(path);
    text += text.empty() ? "" : ", ";
    text += origin != origins->end() ? origin->second : "default";
  }
  return text.empty() ? "" : "  # " + text;
}

/// Calls begin(section, index, count) for every section that this scene has, one after the other where it repeats, and
/// value(key, index, count, field) for its keys.
template <class Begin, class Value>
void for_each_value(Scene& scene, Begin&& begin, Value&& value) {
  for (const Section& section : sections()) {
    const std::size_t count = section.count(scene);
    for (std::size_t index = 0; index < count; ++index) {
      begin(section, index, count);
      for (const Key& key : keys()) {
        if (key.section() != section.path) continue;
        const Slot field = key.field(scene, index);
        if (applies(key, scene, index) && has_value(field)) value(key, index, count, field);
      }
    }
  }
}

}  // namespace

bool has_value(Slot field) {
  return std::visit(
      [](const auto* value) {
        if constexpr (requires { value->empty(); }) return !value->empty();
        return true;
      },
      field);
}

std::string degrees_text(double angle) {
  return number_text(std::round(angle * 180 / std::numbers::pi * 1e6) / 1e6) + " deg";
}

std::string value_text(Slot field) {
  return std::visit(TomlText{}, field);
}

std::string readable_text(const Key& key, Slot field) {
  return key.unit == "rad" ? '"' + degrees_text(*std::get<double*>(field)) + '"' : value_text(field);
}

std::string write_scene(const Scene& scene, const Origins* origins) {
  Scene copy = scene;
  std::string text = "schema_version = 1\n";
  for_each_value(
      copy,
      [&](const Section& section, std::size_t, std::size_t count) {
        text += count > 1 ? fmt::format("\n[[{}]]\n", section.path) : fmt::format("\n[{}]\n", section.path);
      },
      [&](const Key& key, std::size_t index, std::size_t count, Slot field) {
        text += fmt::format("{} = {}{}\n", key.name(), value_text(field),
                            comment(key, numbered(key, index, count), field, origins));
      });
  return text;
}

std::string canonical_scene(const Scene& scene) {
  Scene copy = scene;
  std::string text = "schema_version = 1\n";
  for_each_value(
      copy,
      [&](const Section& section, std::size_t index, std::size_t count) {
        text += fmt::format("[{}]\n", numbered(section.path, index, count));
      },
      [&](const Key& key, std::size_t index, std::size_t count, Slot field) {
        if (key.path != "scene.name") text += fmt::format("{} = {}\n", numbered(key, index, count), value_text(field));
      });
  return text;
}

}  // namespace spindrift
