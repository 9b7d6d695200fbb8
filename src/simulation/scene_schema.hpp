#pragma once
/// What a scene may say, told from the registry: for editors as a JSON Schema, for people as a commented scene.

#include <string>
#include <string_view>

namespace spindrift {

/// JSON Schema (draft 7) of scene files: types, ranges, words, defaults of the `physical` preset, one description a
/// key. A number with a unit may also be a string, "40 deg".
std::string scene_schema();

/// Every section and key with the preset's default, its unit, what it means and where it comes from, as TOML. Keys
/// without a default are commented out.
std::string described_defaults(std::string_view preset);

}  // namespace spindrift
