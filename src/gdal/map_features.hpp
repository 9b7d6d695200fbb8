#pragma once
/// The shapes of a map file one by one: what the readers of polygons and of lines share.

#include <ogr_api.h>

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "gdal/session.hpp"

namespace spindrift::gdal {

/// The first layer of a file, open as long as this lives. All throw MapFileError.
class MapFeatures {
 public:
  using Points = std::vector<std::array<double, 2>>;

  /// kind  of the shapes sought, "polygons"
  MapFeatures(const std::filesystem::path& file, std::string_view kind);

  [[noreturn]] void refuse(const std::string& why) const;

  /// Calls f(geometry, feature) for each that has a geometry, the parts of collections one by one, then refuses what is
  /// damaged, and degrees.
  template <class F>
  void for_each(F&& f) {
    while (OGRFeatureH feature = OGR_L_GetNextFeature(layer_)) {
      const std::unique_ptr<void, decltype(&OGR_F_Destroy)> owner(feature, OGR_F_Destroy);
      if (OGRGeometryH geometry = OGR_F_GetGeometryRef(feature)) for_parts(geometry, feature, f);
    }
    finish();
  }

  /// The vertices of a ring or line, which is part of `whose`.
  Points points_of(OGRGeometryH line, const std::string& whose);

  /// "polygon 2"
  std::string name_of(OGRFeatureH feature, std::string_view shape) const;

 private:
  template <class F>
  void for_parts(OGRGeometryH geometry, OGRFeatureH feature, F& f) {
    const OGRwkbGeometryType type = wkbFlatten(OGR_G_GetGeometryType(geometry));
    if (type != wkbMultiPolygon && type != wkbMultiLineString && type != wkbGeometryCollection)
      return f(geometry, feature);
    for (int i = 0; i < OGR_G_GetGeometryCount(geometry); ++i) for_parts(OGR_G_GetGeometryRef(geometry, i), feature, f);
  }
  void finish() const;

  const std::filesystem::path& file_;
  QuietGdal quiet_;
  GdalData data_;
  OGRLayerH layer_ = nullptr;
  std::size_t n_points_ = 0;    ///< so far
  bool within_degrees_ = true;  ///< all of them could be degrees
};

}  // namespace spindrift::gdal
