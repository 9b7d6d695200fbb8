#pragma once
/// What this module does, each on its own; `spindrift::GdalModule` says what for.

#include "io/gdal_module.hpp"

namespace spindrift::gdal {

ElevationGrid read_raster(const std::filesystem::path& file);
std::vector<MapPolygon> read_polygons(const std::filesystem::path& file);
MapLine read_line(const std::filesystem::path& file);
bool same_coordinates(const std::filesystem::path& shapes, const std::filesystem::path& model);
std::vector<std::byte> geotiff_bytes(const ElevationGrid& grid);

}  // namespace spindrift::gdal
