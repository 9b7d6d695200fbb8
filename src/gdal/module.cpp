#include "gdal/functions.hpp"

namespace spindrift {

extern "C" const GdalModule spindrift_module{gdal::read_raster, gdal::read_polygons, gdal::read_line,
                                             gdal::same_coordinates, gdal::geotiff_bytes};

}  // namespace spindrift
