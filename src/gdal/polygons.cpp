#include <fmt/format.h>

#include <cmath>
#include <cstdlib>
#include <utility>

#include "gdal/functions.hpp"
#include "gdal/map_features.hpp"

namespace spindrift::gdal {
namespace {

MapPolygon fields_of(const MapFeatures& features, OGRFeatureH feature) {
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
      features.refuse(
          fmt::format("{}: thickness: got \"{}\", expected metres", features.name_of(feature, "polygon"), text));
    fields.thickness = value;
  }
  return fields;
}

}  // namespace

std::vector<MapPolygon> read_polygons(const std::filesystem::path& file) {
  MapFeatures features(file, "polygons");
  std::vector<MapPolygon> polygons;
  features.for_each([&](OGRGeometryH geometry, OGRFeatureH feature) {
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type != wkbPolygon)
      features.refuse(fmt::format("{} is a {}, expected a polygon", features.name_of(feature, "feature"),
                                  OGRGeometryTypeToName(type)));
    const std::string who = features.name_of(feature, "polygon");
    MapPolygon& polygon = polygons.emplace_back(fields_of(features, feature));
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) {
      MapFeatures::Points ring = features.points_of(OGR_G_GetGeometryRef(geometry, i), who);
      if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
      if (ring.size() < 3) features.refuse(who + " has a ring of fewer than three points");
      polygon.rings.push_back(std::move(ring));
    }
    if (polygon.rings.empty()) features.refuse(who + " is empty");
  });
  if (polygons.empty()) features.refuse("there are no polygons in it");
  return polygons;
}

}  // namespace spindrift::gdal
