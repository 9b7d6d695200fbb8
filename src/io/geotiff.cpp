#include "io/geotiff.hpp"

#include "core/error.hpp"
#include "io/gdal_module.hpp"

namespace spindrift {

#ifndef SPINDRIFT_GDAL

bool writes_geotiff() {
  return false;
}

std::vector<std::byte> geotiff_bytes(const ElevationGrid&) {
  throw Error(ExitCode::bad_input, "this build writes no GeoTIFF; install libgdal-dev, then configure and build again");
}

#else

bool writes_geotiff() {
  return true;
}

std::vector<std::byte> geotiff_bytes(const ElevationGrid& grid) {
  return load_module<GdalModule>("GeoTIFF").geotiff_bytes(grid);
}

#endif

}  // namespace spindrift
