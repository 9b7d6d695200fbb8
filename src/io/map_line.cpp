#include "io/map_line.hpp"

#include "io/gdal_module.hpp"

namespace spindrift {

MapLine read_map_line(const std::filesystem::path& file) {
#ifdef SPINDRIFT_GDAL
  return load_module<GdalModule>(file.string()).read_line(file);
#else
  throw no_map_files(file);
#endif
}

}  // namespace spindrift
