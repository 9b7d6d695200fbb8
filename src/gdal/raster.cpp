#include <fmt/format.h>
#include <ogr_srs_api.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <limits>
#include <string>

#include "gdal/functions.hpp"
#include "gdal/session.hpp"

namespace spindrift::gdal {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw GridFileError(fmt::format("{}: {}", file.string(), why));
}

constexpr double most_heights = 5e7, highest = 1e5;  // [m]

class RasterReader {
 public:
  explicit RasterReader(const std::filesystem::path& file)
      : file_(file), data_(open_for_reading(file, GDAL_OF_RASTER)) {}

  ElevationGrid read() {
    if (!data_) refuse(file_, fmt::format("not an elevation model that can be read: {}", CPLGetLastErrorMsg()));
    if (const int n = GDALGetRasterCount(data_.get()); n != 1)
      refuse(file_, fmt::format("has {} bands, expected one, of heights", n));
    band_ = GDALGetRasterBand(data_.get(), 1);
    ElevationGrid grid;
    grid.columns = GDALGetRasterXSize(data_.get());
    grid.rows = GDALGetRasterYSize(data_.get());
    if (grid.columns < 2 || grid.rows < 2)
      refuse(file_, fmt::format("{} x {} heights, expected at least 2 x 2", grid.columns, grid.rows));
    if (static_cast<double>(grid.columns) * grid.rows > most_heights)
      refuse(file_, fmt::format("{} x {} heights, at most {:g} can be: cut it to the part that the domain covers",
                                grid.columns, grid.rows, most_heights));
    place(grid);
    check_units();
    read_heights(grid);
    return grid;
  }

 private:
  void place(ElevationGrid& grid) const {
    std::array<double, 6> t{};  // x = t0 + column t1 + row t2, y = t3 + column t4 + row t5
    if (GDALGetGeoTransform(data_.get(), t.data()) != CE_None)
      refuse(file_, "it does not say where it lies: no geotransform");
    for (const double number : t)
      if (!std::isfinite(number)) refuse(file_, "its geotransform is not finite");
    if (t[2] != 0 || t[4] != 0 || !(t[1] > 0) || !(t[5] < 0))
      refuse(file_,
             "its grid is turned or upside down, expected rows along x from north to south: gdalwarp makes such");
    if (std::abs(t[1] + t[5]) > 1e-9 * t[1])
      refuse(file_, fmt::format("cells of {} x {} m, expected square ones", t[1], -t[5]));
    if (!(t[1] <= 1e5)) refuse(file_, fmt::format("cells of {} m, expected at most 1e5 m", t[1]));
    grid.cell = t[1];
    grid.x = t[0] + t[1] / 2;
    grid.y = t[3] + t[5] * (grid.rows - 0.5);
  }

  void check_units() const {
    const OGRSpatialReferenceH system = GDALGetSpatialRef(data_.get());
    if (system != nullptr && OSRIsGeographic(system) != 0)
      refuse(file_, "its coordinates are degrees, expected metres: gdalwarp projects it");
    std::string unit = GDALGetRasterUnitType(band_);
    std::transform(unit.begin(), unit.end(), unit.begin(), [](unsigned char c) { return std::tolower(c); });
    constexpr std::array<std::string_view, 6> metres = {"", "m", "metre", "metres", "meter", "meters"};
    if (std::find(metres.begin(), metres.end(), unit) == metres.end())
      refuse(file_, fmt::format("its heights are in \"{}\", expected metres", unit));
  }

  void read_heights(ElevationGrid& grid) const {
    int has_none = 0, scaled = 0, moved = 0;
    const double none = GDALGetRasterNoDataValue(band_, &has_none);
    const double scale = GDALGetRasterScale(band_, &scaled), offset = GDALGetRasterOffset(band_, &moved);
    grid.z.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    for (int line = 0; line < grid.rows; ++line) {
      const int row = grid.rows - 1 - line;
      double* const heights = &grid.at(0, row);
      if (GDALRasterIO(band_, GF_Read, 0, line, grid.columns, 1, heights, grid.columns, 1, GDT_Float64, 0, 0) !=
          CE_None)
        refuse(file_, fmt::format("cut off or damaged at row {} from the north: {}", line + 1, CPLGetLastErrorMsg()));
      for (int column = 0; column < grid.columns; ++column) {
        double& z = heights[column];
        if (std::isnan(z) || (has_none != 0 && is_hole(z, none))) {
          z = std::numeric_limits<double>::quiet_NaN();
          continue;
        }
        if (scaled != 0) z *= scale;
        if (moved != 0) z += offset;
        if (!(std::abs(z) <= highest))
          refuse(file_,
                 fmt::format("got {} in column {} of row {} from the north, expected a height from -1e5 to 1e5 m", z,
                             column + 1, line + 1));
      }
    }
  }

  /// Single precision rounds the heights, and not always the value that stands for none.
  static bool is_hole(double z, double none) { return z == none || std::abs(z - none) <= 5e-6 * std::abs(none); }

  const std::filesystem::path& file_;
  GdalData data_;
  GDALRasterBandH band_ = nullptr;
};

}  // namespace

ElevationGrid read_raster(const std::filesystem::path& file) {
  const QuietGdal quiet;
  return RasterReader(file).read();
}

}  // namespace spindrift::gdal
