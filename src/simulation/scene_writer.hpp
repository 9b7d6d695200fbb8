#pragma once
/// A scene as text: resolved TOML that reads back as the same scene, and a canonical form to be hashed.

#include <string>

#include "simulation/scene.hpp"

namespace spindrift {

/// Every value of every section that exists, in SI, the unit as a comment. parse_scene of it gives the same scene, bit
/// by bit.
std::string write_scene(const Scene& scene);

/// `path = value` lines in the order of the registry, without comments, for a hash: equal for equal scenes whatever
/// their files look like. The name, which changes no result, is left out.
std::string canonical_scene(const Scene& scene);

}  // namespace spindrift
