#pragma once
/// One value of a scene file into its field, checked against its row of the registry.

#include "simulation/registry.hpp"
#include "simulation/scene_report.hpp"

namespace spindrift {

/// Writes `literal` into the key's field of `scene`, whose section exists, in the one number `index` where it repeats.
/// What does not fit goes to the report under `path`, and the field keeps its value.
void assign(Scene& scene, const Key& key, std::size_t index, const TomlValue& literal, std::string_view path,
            SceneReport& report);

/// What the key takes, for `expected Y` and for the docs: "a length above 0 and at most 100 m", "slip" or "no_slip".
std::string expectation(const Key& key);

}  // namespace spindrift
