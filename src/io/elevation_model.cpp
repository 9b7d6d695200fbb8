#include "io/elevation_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

#include "io/gdal_module.hpp"

namespace spindrift {
namespace {

[[noreturn]] void refuse(const std::filesystem::path& file, const std::string& why) {
  throw GridFileError(fmt::format("{}: {}", file.string(), why));
}

#ifndef SPINDRIFT_GDAL

ElevationGrid read_raster(const std::filesystem::path& file) {
  refuse(
      file,
      "this build reads elevation models from ESRI ASCII grids (.asc) alone; install libgdal-dev, then configure and "
      "build again, or make one by gdal_translate -of AAIGrid");
}

#else

ElevationGrid read_raster(const std::filesystem::path& file) {
  return load_module<GdalModule>(file.string()).read_raster(file);
}

#endif

}  // namespace

ElevationGrid read_elevation_model(const std::filesystem::path& file) {
  std::string ending = file.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto with_heights = [&](ElevationGrid grid) {
    if (std::ranges::all_of(grid.z, [](double z) { return std::isnan(z); }))
      refuse(file, "has no heights, all are holes");
    return grid;
  };
  if (ending == ".asc") return with_heights(read_esri_grid(file));
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw GridFileError("there is no file " + file.string());
  if (!std::filesystem::is_regular_file(file, error)) throw GridFileError(file.string() + " is no regular file");
  return with_heights(read_raster(file));
}

}  // namespace spindrift
