#include <fmt/format.h>
#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <memory>
#include <utility>

#include "gdal/functions.hpp"
#include "gdal/session.hpp"

namespace spindrift::gdal {
namespace {

using Ring = std::vector<std::array<double, 2>>;

struct Reader {
  const std::filesystem::path& file;
  std::vector<MapPolygon> polygons;

  [[noreturn]] void refuse(const std::string& why) const {
    throw MapFileError(fmt::format("{}: {}", file.string(), why));
  }

  Ring ring_of(OGRGeometryH ring, std::size_t feature) const {
    Ring points;
    for (int i = 0; i < OGR_G_GetPointCount(ring); ++i) {
      points.push_back({OGR_G_GetX(ring, i), OGR_G_GetY(ring, i)});
      if (!std::isfinite(points.back()[0]) || !std::isfinite(points.back()[1]))
        refuse(fmt::format("polygon {} has a point that is not finite", feature + 1));
    }
    if (points.size() > 1 && points.front() == points.back()) points.pop_back();
    if (points.size() < 3) refuse(fmt::format("polygon {} has a ring of fewer than three points", feature + 1));
    return points;
  }

  void add(OGRGeometryH geometry, const MapPolygon& fields) {
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type == wkbMultiPolygon || type == wkbGeometryCollection) {
      for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) add(OGR_G_GetGeometryRef(geometry, i), fields);
      return;
    }
    if (type != wkbPolygon)
      refuse(fmt::format("feature {} is a {}, expected a polygon", fields.number + 1, OGRGeometryTypeToName(type)));
    polygons.push_back(fields);
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i)
      polygons.back().rings.push_back(ring_of(OGR_G_GetGeometryRef(geometry, i), fields.number));
    if (polygons.back().rings.empty()) refuse(fmt::format("polygon {} is empty", fields.number + 1));
  }

  bool within_degrees() const {
    return std::ranges::all_of(polygons, [](const MapPolygon& polygon) {
      return std::ranges::all_of(polygon.rings.front(), [](const std::array<double, 2>& point) {
        return std::abs(point[0]) <= 360 && std::abs(point[1]) <= 90;
      });
    });
  }

  MapPolygon fields_of(OGRFeatureH feature) const {
    MapPolygon fields;
    fields.number = static_cast<std::size_t>(OGR_F_GetFID(feature));
    // Field names count in any letter case.
    const int name = OGR_F_GetFieldIndex(feature, "name");
    int thickness = OGR_F_GetFieldIndex(feature, "thickness");
    if (thickness < 0) thickness = OGR_F_GetFieldIndex(feature, "d0");
    if (name >= 0 && OGR_F_IsFieldSetAndNotNull(feature, name)) fields.name = OGR_F_GetFieldAsString(feature, name);
    if (thickness >= 0 && OGR_F_IsFieldSetAndNotNull(feature, thickness)) {
      const std::string text = OGR_F_GetFieldAsString(feature, thickness);
      char* end = nullptr;
      const double value = std::strtod(text.c_str(), &end);
      // AvaFrame writes "None" where a polygon has none of its own.
      if (text.empty() || text == "None") return fields;
      if (end == text.c_str() || *end != '\0' || !std::isfinite(value))
        refuse(fmt::format("polygon {}: thickness: got \"{}\", expected metres", fields.number + 1, text));
      fields.thickness = value;
    }
    return fields;
  }
};

}  // namespace

std::vector<MapPolygon> read_polygons(const std::filesystem::path& file) {
  Reader reader{file, {}};
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) reader.refuse("there is no such file");
  const QuietGdal quiet;
  const GdalData data = open_for_reading(file, GDAL_OF_VECTOR);
  if (!data) reader.refuse(fmt::format("not a file of polygons that can be read: {}", CPLGetLastErrorMsg()));
  if (GDALDatasetGetLayerCount(data.get()) == 0) reader.refuse("there is no layer in it");
  OGRLayerH layer = GDALDatasetGetLayer(data.get(), 0);
  OGR_L_ResetReading(layer);
  while (OGRFeatureH feature = OGR_L_GetNextFeature(layer)) {
    const std::unique_ptr<void, decltype(&OGR_F_Destroy)> owner(feature, OGR_F_Destroy);
    if (OGRGeometryH geometry = OGR_F_GetGeometryRef(feature)) reader.add(geometry, reader.fields_of(feature));
  }
  if (CPLGetLastErrorType() >= CE_Failure) reader.refuse(fmt::format("cut off or damaged: {}", CPLGetLastErrorMsg()));
  if (reader.polygons.empty()) reader.refuse("there are no polygons in it");
  // GeoJSON without a system of coordinates counts as degrees: only numbers that can be such are refused.
  const OGRSpatialReferenceH system = OGR_L_GetSpatialRef(layer);
  if (system != nullptr && OSRIsGeographic(system) != 0 && reader.within_degrees())
    reader.refuse("its coordinates are degrees, expected metres: project it to the terrain's coordinates");
  return std::move(reader.polygons);
}

}  // namespace spindrift::gdal
