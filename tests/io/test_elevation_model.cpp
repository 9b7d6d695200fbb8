#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/elevation_model.hpp"
#include "io/map_coordinates.hpp"
#include "io/temporary_folder.hpp"

#ifdef SPINDRIFT_GDAL
#include "io/map_files.hpp"
#endif

using namespace spindrift;
namespace fs = std::filesystem;

namespace {

/// Heights that single precision has too, and a hole.
ElevationGrid model() {
  ElevationGrid grid{5, 4, 223000.25, 5365000.5, 2.5, {}};
  for (int i = 0; i < 20; ++i) grid.z.push_back(1500 + 0.25 * i);
  grid.at(3, 1) = std::nan("");
  return grid;
}

std::string why(const fs::path& file) {
  try {
    read_elevation_model(file);
  } catch (const GridFileError& error) {
    return error.what();
  }
  return "";
}

void write(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

TEST_CASE("An elevation model that ends in .asc is an ESRI grid, in any letter case", "[io]") {
  const TemporaryFolder folder;
  write(folder.path() / "DEM.ASC", esri_grid_text(model()));
  CHECK(read_elevation_model(folder.path() / "DEM.ASC").columns == 5);
  CHECK_THAT(why(folder.path() / "none.asc"), Catch::Contains("there is no file"));
  CHECK_THAT(why(folder.path() / "none.tif"), Catch::Contains("there is no file"));
  fs::create_directory(folder.path() / "folder.tif");
  CHECK_THAT(why(folder.path() / "folder.tif"), Catch::Contains("no regular file"));
}

#ifdef SPINDRIFT_GDAL

TEST_CASE("A GeoTIFF has the heights and holes of the same ESRI grid", "[io][map]") {
  const TemporaryFolder folder;
  write_geotiff(folder.path() / "dem.tif", model());
  const ElevationGrid read = read_elevation_model(folder.path() / "dem.tif");
  const ElevationGrid ascii = parse_esri_grid(esri_grid_text(model()), "dem.asc");
  CHECK(read.columns == ascii.columns);
  CHECK(read.rows == ascii.rows);
  CHECK(read.cell == ascii.cell);
  CHECK(read.x == Approx(ascii.x).epsilon(1e-14));
  CHECK(read.y == Approx(ascii.y).epsilon(1e-14));
  for (std::size_t i = 0; i < read.z.size(); ++i)
    CHECK((read.z[i] == ascii.z[i] || (std::isnan(read.z[i]) && std::isnan(ascii.z[i]))));
}

TEST_CASE("Rasters that are no elevation model are told why", "[io][map]") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "dem.tif";
  const auto says = [&](const TiffOptions& options, const std::string& words) {
    write_geotiff(file, model(), options);
    CHECK_THAT(why(file), Catch::StartsWith(file.string() + ": ") && Catch::Contains(words));
  };
  says({.turn = 0.1}, "turned");
  says({.height_of_cell = 3}, "expected square ones");
  says({.bands = 3}, "has 3 bands, expected one");
  says({.epsg = 4326}, "degrees");
  says({.placed = false}, "does not say where it lies");
  ElevationGrid high = model();
  high.z[0] = 2e5;
  write_geotiff(file, high);
  CHECK_THAT(why(file), Catch::Contains("in column 1 of row 4 from the north, expected a height"));
  write(file, "II* hello");
  CHECK_THAT(why(file), Catch::Contains("not an elevation model that can be read"));
  write(file, "");
  CHECK_THAT(why(file), Catch::Contains("not an elevation model"));
}

TEST_CASE("A GeoTIFF that is cut off is told", "[io][map]") {
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "dem.tif";
  ElevationGrid large{200, 200, 0, 0, 1, std::vector<double>(40000, 3.0)};
  write_geotiff(file, large);
  REQUIRE(why(file) == "");
  const auto size = fs::file_size(file);
  for (const double share : {0.05, 0.5, 0.9}) {
    fs::resize_file(file, static_cast<std::uintmax_t>(share * static_cast<double>(size)));
    CHECK(why(file) != "");
    write_geotiff(file, large);
  }
}

TEST_CASE("A raster that claims more heights than can be is refused before any is read", "[io][map]") {
  const TemporaryFolder folder;
  write(folder.path() / "dem.vrt",
        "<VRTDataset rasterXSize=\"2000000000\" rasterYSize=\"2000000000\"><GeoTransform>0,1,0,0,0,-1</GeoTransform>"
        "<VRTRasterBand dataType=\"Float64\" band=\"1\"/></VRTDataset>");
  CHECK_THAT(why(folder.path() / "dem.vrt"), Catch::Contains("at most 5e+07 can be"));
}

TEST_CASE("Polygons and model in two systems of coordinates are told apart", "[io][map]") {
  const TemporaryFolder folder;
  const fs::path shape = folder.path() / "rel.shp", tiff = folder.path() / "dem.tif", ascii = folder.path() / "dem.asc";
  const std::vector<TestPolygon> polygons{{{{{223001, 5365001}, {223005, 5365001}, {223005, 5365004}}}, "1"}};
  const auto same = [&](int of_shape, int of_model) {
    write_shapefile(shape, polygons, "thickness", of_shape);
    write_geotiff(tiff, model(), {.epsg = of_model});
    const bool result = same_coordinates(shape, tiff);
    fs::remove(folder.path() / "rel.prj");
    return result;
  };
  CHECK(same(31287, 31287));
  CHECK_FALSE(same(31287, 32632));
  CHECK(same(31287, 0));
  CHECK(same(0, 32632));
  write_shapefile(shape, polygons, "thickness", 31287);
  write(ascii, esri_grid_text(model()));
  CHECK(same_coordinates(shape, ascii));
  fs::copy_file(folder.path() / "rel.prj", folder.path() / "dem.prj");
  CHECK(same_coordinates(shape, ascii));
  write_shapefile(folder.path() / "other.shp", polygons, "thickness", 32632);
  fs::copy_file(folder.path() / "other.prj", folder.path() / "dem.prj", fs::copy_options::overwrite_existing);
  CHECK_FALSE(same_coordinates(shape, ascii));
}

#else

TEST_CASE("Without GDAL other elevation models are refused, and it is said why", "[io]") {
  const TemporaryFolder folder;
  write(folder.path() / "dem.tif", "II*");
  CHECK_THAT(why(folder.path() / "dem.tif"), Catch::Contains("libgdal-dev"));
}

#endif
