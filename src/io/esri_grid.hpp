#pragma once
/// Heights on a regular grid from and to ESRI ASCII grids (.asc).

#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

namespace spindrift {

/// Heights in the middles of square cells. Rows run from south to north, x fastest.
struct ElevationGrid {
  int columns = 0, rows = 0;
  double x = 0, y = 0;    ///< of the first height: the middle of the south-western cell [m]
  double cell = 1;        ///< edge of a cell [m]
  std::vector<double> z;  ///< [m]; NaN: a hole

  double& at(int column, int row) { return z[index(column, row)]; }
  double at(int column, int row) const { return z[index(column, row)]; }
  std::size_t index(int column, int row) const {
    return static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  }
};

/// Where and why a file is no grid: "dem.asc:12: ...".
struct GridFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Header lines of a word and a number in any order and letter case: ncols, nrows, xllcorner or xllcenter, yllcorner or
/// yllcenter, cellsize (or dx and dy, if they agree), NODATA_value (left out: -9999). Then ncols x nrows heights from
/// north to south, apart by any blanks and line ends of any system. Holes are the heights equal to NODATA_value to six
/// digits, and "nan". At most 1 GB and 5e7 heights.
/// Throws GridFileError: no such file, a header that is not complete, a height that is none or beyond 100 km, too few
/// of them or too many.
ElevationGrid read_esri_grid(const std::filesystem::path& file);

/// The same from the text of a file called `name`.
ElevationGrid parse_esri_grid(std::string_view text, const std::string& name);

/// The text of such a file, with xllcenter and yllcenter; reads back as the same bits.
std::string esri_grid_text(const ElevationGrid& grid);

}  // namespace spindrift
