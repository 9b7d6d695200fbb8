#pragma once
/// What the module of src/gdal does for the maps of this folder.

#include <cstddef>
#include <filesystem>
#include <vector>

#include "io/esri_grid.hpp"
#include "io/map_line.hpp"
#include "io/map_polygons.hpp"
#include "io/module.hpp"

namespace spindrift {

/// Each as the function of this folder that calls it says.
struct GdalModule {
  static constexpr const char* file = "spindrift_gdal.so";

  ElevationGrid (*read_raster)(const std::filesystem::path& file);              ///< read_elevation_model
  std::vector<MapPolygon> (*read_polygons)(const std::filesystem::path& file);  ///< read_map_polygons
  MapLine (*read_line)(const std::filesystem::path& file);                      ///< read_map_line
  bool (*same_coordinates)(const std::filesystem::path& shapes, const std::filesystem::path& model);
  std::vector<std::byte> (*geotiff_bytes)(const ElevationGrid& grid);
};

}  // namespace spindrift
