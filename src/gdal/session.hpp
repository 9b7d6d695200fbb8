#pragma once
/// GDAL with its drivers known, for as long as a file is read or written with it.

#include <cpl_error.h>
#include <gdal.h>

#include <filesystem>
#include <memory>

namespace spindrift {

/// Closed at its end; null where it could not be opened.
using GdalData = std::unique_ptr<void, decltype(&GDALClose)>;

/// kind: GDAL_OF_RASTER or GDAL_OF_VECTOR.   Pre: a QuietGdal lives.
inline GdalData open_for_reading(const std::filesystem::path& file, unsigned kind) {
  return {GDALOpenEx(file.c_str(), kind | GDAL_OF_READONLY, nullptr, nullptr, nullptr), GDALClose};
}

/// Keeps GDAL's complaints off the terminal while it lives; the last of them is CPLGetLastErrorMsg().
struct QuietGdal {
  QuietGdal() {
    GDALAllRegister();
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietGdal() { CPLPopErrorHandler(); }
  QuietGdal(const QuietGdal&) = delete;
  QuietGdal& operator=(const QuietGdal&) = delete;
};

}  // namespace spindrift
