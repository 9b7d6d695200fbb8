#include "gdal/map_features.hpp"

#include <fmt/format.h>
#include <ogr_srs_api.h>

#include <cmath>

#include "io/map_polygons.hpp"

namespace spindrift::gdal {

MapFeatures::MapFeatures(const std::filesystem::path& file, std::string_view kind)
    : file_(file), data_(nullptr, GDALClose) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) refuse("there is no such file");
  data_ = open_for_reading(file, GDAL_OF_VECTOR);
  if (!data_) refuse(fmt::format("not a file of {} that can be read: {}", kind, CPLGetLastErrorMsg()));
  if (GDALDatasetGetLayerCount(data_.get()) == 0) refuse("there is no layer in it");
  layer_ = GDALDatasetGetLayer(data_.get(), 0);
  OGR_L_ResetReading(layer_);
}

void MapFeatures::refuse(const std::string& why) const {
  throw MapFileError(fmt::format("{}: {}", file_.string(), why));
}

MapFeatures::Points MapFeatures::points_of(OGRGeometryH line, const std::string& whose) {
  constexpr double most_longitude = 360, most_latitude = 90;
  Points points;
  for (int i = 0; i < OGR_G_GetPointCount(line); ++i) {
    const double x = OGR_G_GetX(line, i), y = OGR_G_GetY(line, i);
    if (!std::isfinite(x) || !std::isfinite(y)) refuse(whose + " has a point that is not finite");
    within_degrees_ = within_degrees_ && std::abs(x) <= most_longitude && std::abs(y) <= most_latitude;
    points.push_back({x, y});
  }
  n_points_ += points.size();
  return points;
}

std::string MapFeatures::name_of(OGRFeatureH feature, std::string_view shape) const {
  return fmt::format("{} {}", shape, OGR_F_GetFID(feature) + 1);
}

void MapFeatures::finish() const {
  if (CPLGetLastErrorType() >= CE_Failure) refuse(fmt::format("cut off or damaged: {}", CPLGetLastErrorMsg()));
  // GeoJSON without a system of coordinates counts as degrees: only numbers that can be such are refused.
  const OGRSpatialReferenceH system = OGR_L_GetSpatialRef(layer_);
  if (system != nullptr && OSRIsGeographic(system) != 0 && n_points_ > 0 && within_degrees_)
    refuse("its coordinates are degrees, expected metres: project it to the terrain's coordinates");
}

}  // namespace spindrift::gdal
