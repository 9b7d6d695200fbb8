#pragma once
/// A line on a map, from the files that geographic programs write.

#include <array>
#include <filesystem>
#include <vector>

#include "io/map_polygons.hpp"

namespace spindrift {

using MapLine = std::vector<std::array<double, 2>>;  ///< vertices (x, y) [m]

/// The only line of the first layer of a shapefile, a GeoJSON file or another that GDAL reads.
/// Throws as read_map_polygons() does; MapFileError also: there is no line in it, or another one.
MapLine read_map_line(const std::filesystem::path& file);

}  // namespace spindrift
