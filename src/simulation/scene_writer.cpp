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

/// "  # [m]"; angles also in degrees.
std::string comment(const Key& key, Slot field) {
  if (key.unit.empty()) return "";
  if (key.unit != "rad") return fmt::format("  # [{}]", key.unit);
  const double degrees = *std::get<double*>(field) * 180 / std::numbers::pi;
  return fmt::format("  # [rad], {} deg", number_text(std::round(degrees * 1e6) / 1e6));
}

/// What an empty list says is that there is no such thing: corners of a slab, vertices of a slope.
bool is_empty_list(Slot field) {
  return std::visit(
      [](const auto* value) {
        if constexpr (requires { value->empty(); }) return value->empty();
        return false;
      },
      field);
}

/// Calls f(key, field) for the keys of `section` that this scene has.
template <class F>
void for_each_value(const Section& section, Scene& scene, F&& f) {
  for (const Key& key : keys()) {
    if (key.section() != section.path) continue;
    const bool of_3d = key.path == "domain.front" || key.path == "domain.back";
    const Slot field = key.field(scene);
    if (!is_empty_list(field) && (scene.scene.dim == 3 || !of_3d)) f(key, field);
  }
}

}  // namespace

std::string write_scene(const Scene& scene) {
  Scene copy = scene;
  std::string text = "schema_version = 1\n";
  for (const Section& section : sections()) {
    if (!section.exists(copy)) continue;
    text += fmt::format("\n[{}]\n", section.path);
    for_each_value(section, copy, [&](const Key& key, Slot field) {
      text += fmt::format("{} = {}{}\n", key.name(), std::visit(TomlText{}, field), comment(key, field));
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
      if (key.path != "scene.name") text += fmt::format("{} = {}\n", key.path, std::visit(TomlText{}, field));
    });
  }
  return text;
}

}  // namespace spindrift
