#pragma once
/// Far from zero, as in the coordinates of elevation models, places lose their digits: the solver works around an
/// origin of its own, and what is written is in the scene's coordinates again.

#include "simulation/scene.hpp"

namespace spindrift {

/// The scene with every place less an origin, which is kept in Scene::origin: whole kilometres, along x and y where a
/// 3D domain reaches farther than 20 km from zero, else 0. Such a scene is for the solver alone, it is not written.
/// Pre: the scene passed the reader's checks.
Scene around_local_origin(Scene scene);

}  // namespace spindrift
