#pragma once
/// Sections of a scene from the polygons and lines of map files.

#include <filesystem>

#include "simulation/avaframe.hpp"
#include "simulation/scene_checks.hpp"

namespace spindrift {

/// Puts in place of every release and every obstacle that names a file, one of shape "area" for each of its polygons,
/// in place of cover.file its polygons and of path.file its line; thickness and depth from the file where the scene
/// does not say them. Places of sections and keys follow the new numbers. folder  of the scene file, from which its
/// paths are seen found   the areas of terrain.avaframe, which are those of the only release, its line, which is the
/// path of a scene
///         that tells none, and its model; else the model alone
/// Adds what is wrong to the report, with file and polygon: a file that cannot be read, other coordinates than the
/// model's, polygons off model or domain or over a hole, no thickness or one that is not above 0 and at most 100 m.
void read_maps(Scene& scene, Places& places, SceneReport& report, const std::filesystem::path& folder,
               const AvaframeFolder& found);

}  // namespace spindrift
