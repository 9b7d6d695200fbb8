#pragma once
/// Heights of an elevation model in any of the files that geographic programs write.

#include <filesystem>

#include "io/esri_grid.hpp"

namespace spindrift {

/// A file that ends in .asc, in any letter case, as an ESRI ASCII grid, without GDAL; every other one, as GeoTIFF, by
/// GDAL: its only band, scale and offset applied, holes where it has its NODATA value or NaN. At most 5e7 heights.
/// Throws GridFileError: no such file, none that GDAL can read, a build without GDAL, more bands than one, a grid that
/// is turned, not north-up, not of square cells or in degrees, a unit other than metres, a height beyond 100 km, or no
/// height at all;  Error(bad_input): GDAL's module does not load.
ElevationGrid read_elevation_model(const std::filesystem::path& file);

}  // namespace spindrift
