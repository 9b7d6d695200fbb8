#pragma once
/// What the ground of a scene must be to itself, to the domain and to the snow that is released on it.

#include "simulation/scene_checks.hpp"

namespace spindrift {

/// Adds what is wrong with [terrain] to the report.   Pre: the scene has one.
void check_ground(const Scene& scene, const Places& places, SceneReport& report);

/// Adds what is wrong with the ground under a release that lies on it, "slab" or "area". Its points are looked at
/// elsewhere.
void check_ground_under(const ReleaseSection& release, const std::string& section, const Scene& scene,
                        const Places& places, SceneReport& report);

/// Adds to the report that the outline `points` at `path` lies off the elevation model, or over a hole of it.
void check_area(const std::string& path, const std::vector<std::array<double, 2>>& points, const Scene& scene,
                const Places& places, SceneReport& report);

/// Adds to the report that there is no 3D ground for what stands at `path`.
void check_area_ground(const std::string& path, const Scene& scene, const Places& places, SceneReport& report);

}  // namespace spindrift
