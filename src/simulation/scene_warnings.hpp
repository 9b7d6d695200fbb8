#pragma once
/// Scenes that can be run but hardly mean what they say.

#include <string>
#include <vector>

#include "simulation/scene_reader.hpp"

namespace spindrift {

/// One line each, with its reason: `file:line:column: warning: cover: nothing takes it up: ...`. Empty for most scenes.
/// Cost: that of placing the released snow.   Pre: the scene passed the reader's checks and fits into memory.
std::vector<std::string> scene_warnings(const Scene& scene, const Origins& origins);

}  // namespace spindrift
