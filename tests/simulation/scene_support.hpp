#pragma once
/// Scenes for tests: one with every section, comparison by the registry, and the text of a refusal.

#include <string>
#include <vector>

#include "core/error.hpp"
#include "simulation/registry.hpp"
#include "simulation/scene_reader.hpp"

namespace spindrift {

/// Every section that any scene may have, at the defaults of `preset`, in a domain of 100 m; all that the reader would
/// fill in is filled in. No [path], which needs a height field.
inline Scene scene_with_everything(int dim, std::string_view preset = "physical") {
  Scene scene = complete_scene(preset);
  const auto n = static_cast<std::size_t>(dim);
  scene.scene.dim = dim;
  scene.scene.name = "everything";
  scene.domain.lower.assign(n, -100);
  scene.domain.upper.assign(n, 100);
  scene.domain.gravity.assign(n, 0);
  scene.domain.gravity.back() = -9.81;
  scene.release[0].velocity.assign(n, 0);
  scene.suspension->wind.assign(n, 0);
  scene.suspension->lid.assign(n, 0);
  scene.smoke[0].lower.assign(n, 1);
  scene.smoke[0].upper.assign(n, 2);
  scene.path.reset();
  scene.pylon[0].position.assign(n - 1, 3);
  scene.pylon[0].name = "pylon1";
  scene.obstacle[0].lower.assign(n, -2);
  scene.obstacle[0].upper.assign(n, -1);
  return scene;
}

/// The same sections, and the same bits in every value that means something there.
inline bool same(Scene a, Scene b) {
  for (const Section& section : sections())
    if (section.count(a) != section.count(b)) return false;
  for (const Key& key : keys())
    for (std::size_t i = 0; i < find_section(key.section())->count(a); ++i) {
      if (!applies(key, a, i)) continue;
      const Slot slot_a = key.field(a, i), slot_b = key.field(b, i);
      if (!std::visit([&](auto* value) { return *value == *std::get<decltype(value)>(slot_b); }, slot_a)) return false;
    }
  return true;
}

/// What the reader says against a text; empty if it takes it.
inline std::string refusal(std::string_view text, const std::vector<std::string>& settings = {}) {
  try {
    parse_scene(text, "a.toml", settings);
  } catch (const Error& error) {
    return error.code() == ExitCode::bad_input ? error.what() : "wrong exit code";
  }
  return "";
}

}  // namespace spindrift
