#pragma once
/// Files of maps for tests, written by GDAL. To be included where SPINDRIFT_GDAL is defined.

#include <ogr_api.h>
#include <ogr_srs_api.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "gdal/session.hpp"
#include "io/esri_grid.hpp"

namespace spindrift {

struct TestPolygon {
  std::vector<std::vector<std::array<double, 2>>> rings;
  std::string thickness;  ///< as the field has it; empty: not set
};

/// An EPSG code as a system of coordinates; null for 0.
inline OGRSpatialReferenceH system_of(int epsg) {
  if (epsg == 0) return nullptr;
  OGRSpatialReferenceH system = OSRNewSpatialReference(nullptr);
  REQUIRE(OSRImportFromEPSG(system, epsg) == OGRERR_NONE);
  return system;
}

/// A shapefile with a field of text, as AvaFrame's users have it.
inline void write_shapefile(const std::filesystem::path& file, const std::vector<TestPolygon>& polygons,
                            const char* field = "thickness", int epsg = 0) {
  const QuietGdal quiet;
  GDALDatasetH data = GDALCreate(GDALGetDriverByName("ESRI Shapefile"), file.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  REQUIRE(data != nullptr);
  OGRSpatialReferenceH system = system_of(epsg);
  OGRLayerH layer = GDALDatasetCreateLayer(data, file.stem().c_str(), system, wkbPolygon, nullptr);
  OGRFieldDefnH definition = OGR_Fld_Create(field, OFTString);
  REQUIRE(OGR_L_CreateField(layer, definition, 1) == OGRERR_NONE);
  OGR_Fld_Destroy(definition);
  for (const TestPolygon& polygon : polygons) {
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    if (!polygon.thickness.empty()) OGR_F_SetFieldString(feature, 0, polygon.thickness.c_str());
    OGRGeometryH shape = OGR_G_CreateGeometry(wkbPolygon);
    for (const auto& ring : polygon.rings) {
      OGRGeometryH line = OGR_G_CreateGeometry(wkbLinearRing);
      for (const auto& [x, y] : ring) OGR_G_AddPoint_2D(line, x, y);
      OGR_G_AddPoint_2D(line, ring[0][0], ring[0][1]);
      OGR_G_AddGeometryDirectly(shape, line);
    }
    OGR_F_SetGeometryDirectly(feature, shape);
    REQUIRE(OGR_L_CreateFeature(layer, feature) == OGRERR_NONE);
    OGR_F_Destroy(feature);
  }
  GDALClose(data);
  if (system != nullptr) OSRRelease(system);
}

/// A shapefile of lines.
inline void write_lines(const std::filesystem::path& file, const std::vector<std::vector<std::array<double, 2>>>& lines,
                        int epsg = 0) {
  const QuietGdal quiet;
  GDALDatasetH data = GDALCreate(GDALGetDriverByName("ESRI Shapefile"), file.c_str(), 0, 0, 0, GDT_Unknown, nullptr);
  REQUIRE(data != nullptr);
  OGRSpatialReferenceH system = system_of(epsg);
  OGRLayerH layer = GDALDatasetCreateLayer(data, file.stem().c_str(), system, wkbLineString, nullptr);
  for (const auto& points : lines) {
    OGRFeatureH feature = OGR_F_Create(OGR_L_GetLayerDefn(layer));
    OGRGeometryH line = OGR_G_CreateGeometry(wkbLineString);
    for (const auto& [x, y] : points) OGR_G_AddPoint_2D(line, x, y);
    OGR_F_SetGeometryDirectly(feature, line);
    REQUIRE(OGR_L_CreateFeature(layer, feature) == OGRERR_NONE);
    OGR_F_Destroy(feature);
  }
  GDALClose(data);
  if (system != nullptr) OSRRelease(system);
}

struct TiffOptions {
  double turn = 0;  ///< of the geotransform
  double height_of_cell = 0;
  int bands = 1;
  int epsg = 0;
  bool placed = true;
};

/// A GeoTIFF in single precision, holes as -3.4028234663852886e38.
inline void write_geotiff(const std::filesystem::path& file, const ElevationGrid& grid, const TiffOptions& o = {}) {
  const QuietGdal quiet;
  GDALDatasetH data =
      GDALCreate(GDALGetDriverByName("GTiff"), file.c_str(), grid.columns, grid.rows, o.bands, GDT_Float32, nullptr);
  REQUIRE(data != nullptr);
  const double high = o.height_of_cell > 0 ? o.height_of_cell : grid.cell;
  std::array<double, 6> t{
      grid.x - grid.cell / 2, grid.cell, o.turn, grid.y + grid.cell * (grid.rows - 0.5), o.turn, -high};
  if (o.placed) GDALSetGeoTransform(data, t.data());
  OGRSpatialReferenceH system = system_of(o.epsg);
  if (system != nullptr) GDALSetSpatialRef(data, system);
  GDALRasterBandH band = GDALGetRasterBand(data, 1);
  constexpr double none = -3.4028234663852886e38;
  GDALSetRasterNoDataValue(band, none);
  for (int row = 0; row < grid.rows; ++row)
    for (int column = 0; column < grid.columns; ++column) {
      const double height = grid.at(column, grid.rows - 1 - row);
      auto z = static_cast<float>(std::isnan(height) ? none : height);
      REQUIRE(GDALRasterIO(band, GF_Write, column, row, 1, 1, &z, 1, 1, GDT_Float32, 0, 0) == CE_None);
    }
  GDALClose(data);
  if (system != nullptr) OSRRelease(system);
}

}  // namespace spindrift
