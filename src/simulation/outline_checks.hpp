#pragma once
/// Whether an outline lies where the elevation model of a scene has heights.

#include <string>

#include "io/esri_grid.hpp"
#include "simulation/outline.hpp"

namespace spindrift {

/// What is wrong: "reaches ..., expected it over the elevation model ...", "lies over a hole ..."; empty: nothing.
std::string off_the_model(const ElevationGrid& model, const Outline& outline);

}  // namespace spindrift
