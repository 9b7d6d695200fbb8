#pragma once
/// The cover of a frame as it lies on the ground of a picture.

#include "io/relief.hpp"
#include "simulation/picture_frame.hpp"
#include "sph/sleeping_cover.hpp"

namespace spindrift {

/// Raises bare ground by the cover on it, and fills in Relief::snow: its depth normal to the ground, up to half a
/// particle over the highest of its particles, over squares of two particles' edge. Beyond the domain it goes on as
/// deep as usual from where it ends at the domain's sides.   spacing: of the particles [m]
/// area: of a cover that sleeps: from plots of it without a particle in the frame nothing was laid, and it lies there
/// as at the start; may be null
void add_cover(Relief& ground, const Box<3>& domain, double spacing, const CoverArea* area, const PictureFrame& frame);

}  // namespace spindrift
