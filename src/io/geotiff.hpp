#pragma once
/// Grids as GeoTIFF, where GDAL is built in.

#include <cstddef>
#include <vector>

#include "io/esri_grid.hpp"

namespace spindrift {

/// Whether this build writes them.
bool writes_geotiff();

/// The grid as the bytes of a GeoTIFF: one band in single precision, deflated, holes -9999, no system of coordinates.
/// Throws Error(bad_input): a build without GDAL, or its module does not load;  Error(io_failed): GDAL refused.
std::vector<std::byte> geotiff_bytes(const ElevationGrid& grid);

}  // namespace spindrift
