#include <fmt/format.h>

#include <utility>

#include "gdal/functions.hpp"
#include "gdal/map_features.hpp"

namespace spindrift::gdal {

MapLine read_line(const std::filesystem::path& file) {
  MapFeatures features(file, "lines");
  std::vector<MapLine> lines;
  features.for_each([&](OGRGeometryH geometry, OGRFeatureH feature) {
    const OGRwkbGeometryType type = OGR_G_GetGeometryType(geometry);
    if (wkbFlatten(type) != wkbLineString)
      features.refuse(fmt::format("{} is a {}, expected a line", features.name_of(feature, "feature"),
                                  OGRGeometryTypeToName(type)));
    lines.push_back(features.points_of(geometry, features.name_of(feature, "line")));
  });
  if (lines.size() != 1) features.refuse(fmt::format("there are {} lines in it, expected one", lines.size()));
  return std::move(lines[0]);
}

}  // namespace spindrift::gdal
