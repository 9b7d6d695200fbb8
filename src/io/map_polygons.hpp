#pragma once
/// Polygons of a map, from the files that geographic programs write.

#include <array>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

namespace spindrift {

/// Where and why a file holds no polygons: "REL/relKot.shp: ...".
struct MapFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct MapPolygon {
  std::string name;                 ///< of its field "name" or "NAME"; empty: it has none
  std::optional<double> thickness;  ///< of its field "thickness" or "d0", normal to the ground [m]
  std::vector<std::vector<std::array<double, 2>>> rings;  ///< the outline, then holes; the first point not repeated [m]
  std::size_t number = 0;                                 ///< of the feature in its file, from 0

  /// Whether (x, y) lies inside: inside an odd number of rings.
  bool contains(double x, double y) const;
  /// The outline that goes to every hole, around it and back on the same line: by the even-odd rule it has the same
  /// inside.   Pre: there is an outline.
  std::vector<std::array<double, 2>> one_ring() const;
  /// Area in plan [m^2].
  double area() const;
};

/// Whether this build reads shapefiles, GeoJSON and whatever else GDAL knows.
bool reads_map_files();
/// What is told where it does not.
MapFileError no_map_files(const std::filesystem::path& file);

/// The polygons of the first layer of a shapefile, a GeoJSON file or another that GDAL reads, in the file's order;
/// multipolygons are taken apart.
/// Throws MapFileError: no such file, none that GDAL can read, a layer without polygons, geometry that is no polygon, a
/// coordinate or thickness that is not finite, coordinates in degrees, or a build without GDAL;  Error(bad_input):
/// GDAL's module does not load.
std::vector<MapPolygon> read_map_polygons(const std::filesystem::path& file);

}  // namespace spindrift
