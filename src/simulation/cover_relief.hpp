#pragma once
/// The cover of a frame as it lies on the ground of a picture.

#include "io/relief.hpp"
#include "simulation/picture_frame.hpp"

namespace spindrift {

/// Raises bare ground by the cover on it, and fills in Relief::snow: its depth normal to the ground, up to half a
/// particle over the highest of its particles, over squares of two particles' edge. Beyond the domain it goes on as
/// deep as usual from where it ends at the domain's sides.   spacing: of the particles [m]
void add_cover(Relief& ground, const Box<3>& domain, double spacing, const PictureFrame& frame);

}  // namespace spindrift
