#include <cpl_conv.h>
#include <cpl_string.h>
#include <cpl_vsi.h>

#include <cmath>
#include <string>

#include "core/error.hpp"
#include "gdal/functions.hpp"
#include "gdal/session.hpp"

namespace spindrift::gdal {

std::vector<std::byte> geotiff_bytes(const ElevationGrid& grid) {
  constexpr const char* file = "/vsimem/spindrift.tif";  // GDAL's disk in memory
  constexpr double none = -9999;
  const auto check = [](bool good) {
    if (!good) throw Error(ExitCode::io_failed, std::string("GDAL writes no GeoTIFF: ") + CPLGetLastErrorMsg());
  };
  const QuietGdal quiet;
  const GDALDriverH driver = GDALGetDriverByName("GTiff");
  check(driver != nullptr);
  char** const options = CSLSetNameValue(nullptr, "COMPRESS", "DEFLATE");
  GdalData data(GDALCreate(driver, file, grid.columns, grid.rows, 1, GDT_Float32, options), GDALClose);
  CSLDestroy(options);
  check(data != nullptr);
  const double west = grid.x - grid.cell / 2, north = grid.y + (grid.rows - 0.5) * grid.cell;
  double frame[6] = {west, grid.cell, 0, north, 0, -grid.cell};
  check(GDALSetGeoTransform(data.get(), frame) == CE_None);
  const GDALRasterBandH band = GDALGetRasterBand(data.get(), 1);
  check(GDALSetRasterNoDataValue(band, none) == CE_None);
  std::vector<float> row(static_cast<std::size_t>(grid.columns));
  for (int j = 0; j < grid.rows; ++j) {
    for (int i = 0; i < grid.columns; ++i) {
      const double z = grid.at(i, grid.rows - 1 - j);
      row[static_cast<std::size_t>(i)] = static_cast<float>(std::isnan(z) ? none : z);
    }
    check(GDALRasterIO(band, GF_Write, 0, j, grid.columns, 1, row.data(), grid.columns, 1, GDT_Float32, 0, 0) ==
          CE_None);
  }
  data.reset();
  vsi_l_offset size = 0;
  const GByte* const written = VSIGetMemFileBuffer(file, &size, FALSE);
  check(written != nullptr);
  const auto* const first = reinterpret_cast<const std::byte*>(written);
  std::vector<std::byte> bytes(first, first + size);
  VSIUnlink(file);
  return bytes;
}

}  // namespace spindrift::gdal
