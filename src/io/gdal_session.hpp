#pragma once
/// GDAL with its drivers known, for as long as a file is read with it. To be included where SPINDRIFT_GDAL is defined.

#include <cpl_error.h>
#include <gdal.h>

namespace spindrift {

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
