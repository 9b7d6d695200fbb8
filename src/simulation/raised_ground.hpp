#pragma once
/// Obstacles of shape "area": walls and dams as part of the ground.

#include "simulation/scene.hpp"
#include "terrain/height_field.hpp"

namespace spindrift {

/// Raises every height by that of each area of obstacle, times the share of the cell around the point that the area
/// covers: a wall narrower than a cell gets lower, and keeps its volume.
void raise_obstacles(HeightGrid& grid, const std::vector<ObstacleSection>& obstacles);

}  // namespace spindrift
