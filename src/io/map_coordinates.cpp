#include "io/map_coordinates.hpp"

#include "io/gdal_module.hpp"

namespace spindrift {

#ifndef SPINDRIFT_GDAL

bool same_coordinates(const std::filesystem::path&, const std::filesystem::path&) {
  return true;
}

#else

bool same_coordinates(const std::filesystem::path& shapes, const std::filesystem::path& model) {
  return load_module<GdalModule>(shapes.string()).same_coordinates(shapes, model);
}

#endif

}  // namespace spindrift
