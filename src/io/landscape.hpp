#pragma once
/// Pictures of a 3D scene: ground with its snow, particles of the flow, smoke as a volume, in the light of sun and sky.
/// Arrays in, pixels out; the same pixels with any number of threads.

#include <cstdint>
#include <span>
#include <vector>

#include "io/camera.hpp"
#include "io/picture.hpp"
#include "io/relief.hpp"
#include "io/smoke_volume.hpp"

namespace spindrift {

/// What a picture shows. All of it may be empty.
struct Landscape {
  Relief ground;
  std::vector<Box<3>> boxes;  ///< solid things [m]
  std::vector<Vec<3>> snow;   ///< centres of the dense flow's particles [m]; those that are not finite are left out
  std::vector<std::uint8_t> snow_kind;  ///< 0 released, 1 entrained, one a particle; empty: all are released
  double snow_radius = 0;               ///< [m]; never drawn less than 0.8 px
  SmokeLattice smoke;
  double opaque_smoke = 1;  ///< density that hides 63 % of what is behind one metre of it [kg m^-3]
};

/// Draws everything, the nearer before the farther, in bands of rows side by side. Memory: the pixels, the shadow map
/// (4 MB), a few copies of the ground and of the smoky part of the lattice.
/// Returns   0xffRRGGBB, rows from above.
std::vector<std::uint32_t> draw_landscape(const Landscape& landscape, const Camera& camera, const Light& light);

/// The same as a PNG file, with the time in the upper left corner and a scale bar in the lower right one, which is
/// right at `bar_depth` [m] from the camera, along its view.   Throws    Error(would_not_fit), Error(io_failed)
std::vector<std::byte> landscape_png(const Landscape& landscape, const Camera& camera, const Light& light, double time,
                                     double bar_depth);

}  // namespace spindrift
