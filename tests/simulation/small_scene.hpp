#pragma once
/// A small avalanche with everything in it, whose sections tests leave out.

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/scene_reader.hpp"

namespace spindrift::testing {

inline constexpr std::string_view small_avalanche = R"(
schema_version = 1
[scene]
name = "small"
end_time = 1.0
[domain]
lower = [0, 0]
upper = [20, 14]
[terrain]
start = [0, 11]
angle = "38 deg"
drop = 9
transition_radius = 4
[release]
at = 1
length = 2.5
thickness = 1.05
velocity = [4, -3]
[dense_flow]
support_radius = 0.21
[cover]
depth = 0.42
[suspension]
cell_size = 0.33
[suspension.confinement]
[coupling.drag]
[coupling.lift]
[coupling.generation]
threshold_speed = 0
[coupling.adhesion]
[entrainment]
[output]
frames_per_second = 5
preview_width = 200
)";

/// The same snow in 3D, a slice a metre wide.
inline constexpr std::string_view small_avalanche_3d = R"(
schema_version = 1
[scene]
name = "slice"
dim = 3
end_time = 0.2
[domain]
lower = [0, 0, 0]
upper = [8, 1, 6]
[terrain]
start = [0, 5]
angle = "38 deg"
drop = 4
transition_radius = 1
[release]
at = 0.5
length = 1.5
thickness = 0.6
velocity = [4, 0, -3]
[dense_flow]
support_radius = 0.3
[cover]
depth = 0.3
[suspension]
cell_size = 0.5
[suspension.confinement]
[coupling.drag]
[coupling.lift]
[coupling.generation]
threshold_speed = 0
[coupling.adhesion]
[entrainment]
)";

/// Snow far lighter than the smoke around it, which throws it about: a runaway whatever the step.
inline constexpr std::string_view runaway = R"(
schema_version = 1
[scene]
name = "runaway"
end_time = 1
[domain]
lower = [0, 0]
upper = [12, 9]
[release]
shape = "ball"
center = [5, 5]
radius = 1
[dense_flow]
support_radius = 0.3
density = 0.02
friction_acts_on = "none"
[suspension]
cell_size = 0.5
[smoke]
shape = "ball"
center = [5, 5.5]
radius = 2
density = 5000
[coupling.drag]
[output]
frames_per_second = 350
preview_width = 200
)";

/// The text without the named sections, each with its keys.
inline std::string without(std::string_view text, const std::vector<std::string>& sections) {
  std::string kept;
  bool drop = false;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size() - 1) + 1;
    const std::string line(text.substr(0, end));
    text.remove_prefix(end);
    if (line.front() == '[')
      drop = std::any_of(sections.begin(), sections.end(),
                         [&](const std::string& s) { return line.starts_with("[" + s + "]"); });
    if (!drop) kept += line;
  }
  return kept;
}

inline Scene scene_of(std::string_view text, const std::vector<std::string>& settings = {}) {
  return parse_scene(text, "test.toml", settings);
}

}  // namespace spindrift::testing
