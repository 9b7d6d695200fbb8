#include <ogr_srs_api.h>

#include <array>
#include <cmath>
#include <memory>

#include "gdal/functions.hpp"
#include "gdal/session.hpp"

namespace spindrift::gdal {
namespace {

/// Whether x, y of one system are x, y of the other too: names and codes often differ where the coordinates do not.
bool same_place(OGRSpatialReferenceH a, OGRSpatialReferenceH b, double x, double y) {
  const auto ordered = [](OGRSpatialReferenceH system) {
    std::unique_ptr<void, decltype(&OSRDestroySpatialReference)> copy(OSRClone(system), OSRDestroySpatialReference);
    OSRSetAxisMappingStrategy(copy.get(), OAMS_TRADITIONAL_GIS_ORDER);
    return copy;
  };
  const auto from = ordered(a), to = ordered(b);
  const std::unique_ptr<void, decltype(&OCTDestroyCoordinateTransformation)> change(
      OCTNewCoordinateTransformation(from.get(), to.get()), OCTDestroyCoordinateTransformation);
  double u = x, v = y;
  return change && OCTTransform(change.get(), 1, &u, &v, nullptr) != 0 && std::hypot(u - x, v - y) < 1;
}

}  // namespace

bool same_coordinates(const std::filesystem::path& shapes, const std::filesystem::path& model) {
  const QuietGdal quiet;
  const GdalData map = open_for_reading(shapes, GDAL_OF_VECTOR), heights = open_for_reading(model, GDAL_OF_RASTER);
  if (!map || !heights || GDALDatasetGetLayerCount(map.get()) == 0) return true;
  const OGRSpatialReferenceH of_shapes = OGR_L_GetSpatialRef(GDALDatasetGetLayer(map.get(), 0));
  const OGRSpatialReferenceH of_heights = GDALGetSpatialRef(heights.get());
  if (of_shapes == nullptr || of_heights == nullptr || OSRIsSame(of_shapes, of_heights) != 0) return true;
  // What is no projection is the mark of a file without one: GeoJSON always claims degrees.
  if (OSRIsProjected(of_shapes) == 0 || OSRIsProjected(of_heights) == 0) return true;
  std::array<double, 6> t{};
  if (GDALGetGeoTransform(heights.get(), t.data()) != CE_None) return true;
  const double column = GDALGetRasterXSize(heights.get()) / 2.0, row = GDALGetRasterYSize(heights.get()) / 2.0;
  return same_place(of_shapes, of_heights, t[0] + column * t[1], t[3] + row * t[5]);
}

}  // namespace spindrift::gdal
