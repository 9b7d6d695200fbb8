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
std::string comment(const Key& key, Slot field, const Origins* origins) {
  std::string text = unit_text(key, field);
  if (origins != nullptr) {
    const auto origin = origins->find(key.path);
    text += text.empty() ? "" : ", ";
    text += origin != origins->end() ? origin->second : "default";
  }
  return text.empty() ? "" : "  # " + text;
}

/// Calls f(key, field) for the keys of `section` that this scene has.
template <class F>
void for_each_value(const Section& section, Scene& scene, F&& f) {
  for (const Key& key : keys()) {
    if (key.section() != section.path) continue;
    const Slot field = key.field(scene);
    if (has_value(key, field, scene.scene.dim)) f(key, field);
  }
}

}  // namespace

bool has_value(const Key& key, Slot field, int dim) {
  if (dim == 2 && (key.path == "domain.front" || key.path == "domain.back")) return false;
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

std::string write_scene(const Scene& scene, const Origins* origins) {
  Scene copy = scene;
  std::string text = "schema_version = 1\n";
  for (const Section& section : sections()) {
    if (!section.exists(copy)) continue;
    text += fmt::format("\n[{}]\n", section.path);
    for_each_value(section, copy, [&](const Key& key, Slot field) {
      text += fmt::format("{} = {}{}\n", key.name(), value_text(field), comment(key, field, origins));
    });
  }
  return text;
}

std::string canonical_scene(const Scene& scene) {
  Scene copy = scene;
  std::string text = "schema_version = 1\n";
  for (const Section& section : sections()) {
    if (!section.exists(copy)) continue;
    text += fmt::format("[{}]\n", section.path);
    for_each_value(section, copy, [&](const Key& key, Slot field) {
      if (key.path != "scene.name") text += fmt::format("{} = {}\n", key.path, value_text(field));
    });
  }
  return text;
}

}  // namespace spindrift
