#include "io/map_coordinates.hpp"

#include "io/gdal_module.hpp"

namespace spindrift {

#ifndef SPINDRIFT_GDAL

bool same_coordinates(const std::filesystem::path&, const std::filesystem::path&) {
  return true;
}

#else

bool same_coordinates(const std::filesystem::path& polygons, const std::filesystem::path& model) {
  return load_module<GdalModule>(polygons.string()).same_coordinates(polygons, model);
}

#endif

}  // namespace spindrift
