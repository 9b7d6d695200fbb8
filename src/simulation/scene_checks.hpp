#pragma once
/// What the values of a scene must be to each other: sections that need others, corners in order, profiles that rise.

#include <map>
#include <string>

#include "simulation/scene.hpp"
#include "simulation/scene_report.hpp"

namespace spindrift {

/// Where each section and key of the file stands.
using Places = std::map<std::string, Place, std::less<>>;

/// The place of `path`, or of the section around it, or the file's begin.
Place place_of(const Places& places, std::string_view path);

/// Adds what is wrong to the report; leaves alone keys that are wrong already.
void check_scene(const Scene& scene, const Places& places, SceneReport& report);

}  // namespace spindrift
