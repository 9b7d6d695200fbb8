/// The part of the registry's table that has no effect on the simulation.

#include "simulation/registry_rows.hpp"

namespace spindrift {

void add_output(Registry& r) {
  using L = PathSection;
  Rows<&Scene::path>(r, "path", "the line on a 3D ground along which the front is measured")
      .number<&L::points>("points", "m", position,
                          "vertices (x, y) downhill, 0 m at the first; the line goes on straight at both ends")
      .plain<&L::file>("file", "in place of points: a shapefile or another map of one line");

  using P = PylonSection;
  Rows<&Scene::pylon>(r, "pylon", "an instrument that stands at one place; there may be several")
      .plain<&P::name>("name", "of its columns in pylons.csv; default: pylon1, pylon2, ...")
      .place<&P::position>("position", "seen from above: [x] in 2D, [x, y] in 3D")
      .number<&P::height>("height", "m", from(0, 1000), "over the ground, not over the cover; straight up");

  using O = OutputSection;
  Rows<&Scene::output>(r, "output", "what the run folder gets")
      .number<&O::frames_per_second>("frames_per_second", "1/s", from(0, 1e5),
                                     "of simulated time; 0: none but the start")
      .plain<&O::particles>("particles", "write the particles of each frame")
      .plain<&O::smoke>("smoke", "write the smoke of each frame")
      .plain<&O::rasters>("rasters", "write maps of peaks, deposit and erosion (3D, with a terrain)")
      .number<&O::raster_cell>("raster_cell", "m", from(0, 1e4),
                               "of the maps; 0: the terrain's cells, on a profile two particle spacings")
      .plain<&O::preview>("preview", "draw a picture of each frame")
      .number<&O::preview_width>("preview_width", "", from(16, 16384),
                                 "of the pictures, in pixels; in 3D they are 16 to 9")
      .number<&O::opaque_smoke>(
          "opaque_smoke", "kg/m^3", above(0, 1e4),
          "smoke that hides 63 % of what is behind it in the pictures, in 3D behind a metre of it");
}

}  // namespace spindrift
