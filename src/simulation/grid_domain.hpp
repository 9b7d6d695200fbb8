#pragma once
/// The domain of a scene that does not tell its corners.

#include "io/esri_grid.hpp"
#include "simulation/scene.hpp"

namespace spindrift {

/// Corners around all known heights of the model: a cell less than its extent, from 10 m below the lowest of them to
/// 100 m above the highest, in whole metres.   Pre: one height is known, and the model has three points an axis or
/// more.
void surround(DomainSection& domain, const ElevationGrid& model);

}  // namespace spindrift
