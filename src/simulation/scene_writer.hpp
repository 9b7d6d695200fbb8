#pragma once
/// A scene as text: resolved TOML that reads back as the same scene, and a canonical form to be hashed.

#include <string>

#include "simulation/registry.hpp"
#include "simulation/scene.hpp"
#include "simulation/scene_reader.hpp"

namespace spindrift {

/// Every value of every section that exists, in SI, the unit as a comment. parse_scene of it gives the same scene, bit
/// by bit.
/// origins   null, or where each value comes from, written behind its unit; what has none is a default
std::string write_scene(const Scene& scene, const Origins* origins = nullptr);

/// `path = value` lines in the order of the registry, without comments, for a hash: equal for equal scenes whatever
/// their files look like. The name, which changes no result, is left out.
std::string canonical_scene(const Scene& scene);

/// A value as TOML, in SI.
std::string value_text(Slot field);
/// The same as people write it: angles as "38 deg".
std::string readable_text(const Key& key, Slot field);
/// "38 deg" of an angle in radians, to six digits after the point.
std::string degrees_text(double angle);
/// Whether there is anything to say: an empty list or name is no value.
bool has_value(Slot field);

}  // namespace spindrift
