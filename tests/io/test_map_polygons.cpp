#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <string>

#include "io/map_polygons.hpp"

using namespace spindrift;

namespace {

std::filesystem::path written(const std::string& name, const std::string& text) {
  const std::filesystem::path file = std::filesystem::temp_directory_path() / ("spindrift_" + name);
  std::ofstream(file) << text;
  return file;
}

std::string collection(const std::string& features) {
  return R"({"type":"FeatureCollection","features":[)" + features + "]}";
}

std::string feature(const std::string& properties, const std::string& geometry, const std::string& coordinates) {
  return R"({"type":"Feature","properties":{)" + properties + R"(},"geometry":{"type":")" + geometry +
         R"(","coordinates":)" + coordinates + "}}";
}

const std::string square = "[[[1000,50],[1010,50],[1010,60],[1000,60],[1000,50]]]";

std::string why(const std::string& name, const std::string& text) {
  try {
    read_map_polygons(written(name, text));
  } catch (const MapFileError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A polygon knows its area and what lies inside, holes and all", "[map]") {
  const MapPolygon polygon{"", {}, {{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {{2, 2}, {2, 4}, {4, 4}, {4, 2}}}, 0};
  CHECK(polygon.area() == Approx(96));
  CHECK(polygon.contains(1, 1));
  CHECK(polygon.contains(5, 3));
  CHECK(!polygon.contains(3, 3));
  CHECK(!polygon.contains(11, 3));
  CHECK(!polygon.contains(-1, 3));
  const MapPolygon joined{"", {}, {polygon.one_ring()}, 0};
  for (double x = -0.75; x < 12; x += 0.5)
    for (double y = -0.75; y < 12; y += 0.5) CHECK(joined.contains(x, y) == polygon.contains(x, y));
}

TEST_CASE("Polygons of a GeoJSON file", "[map]") {
  if (!reads_map_files()) {
    WARN("built without GDAL: no polygons are read");
    CHECK_THROWS_AS(read_map_polygons("any.shp"), MapFileError);
    return;
  }
  const auto file =
      written("polygons.geojson",
              collection(feature(R"("Name":"upper","thickness":1.5)", "Polygon", square) + "," +
                         feature(R"("thickness":"None")", "MultiPolygon",
                                 "[[[[0,100],[4,100],[4,102],[0,102],[0,100]]],[[[8,100],[9,100],[9,101],[8,100]]]]")));
  const auto polygons = read_map_polygons(file);
  REQUIRE(polygons.size() == 3);
  CHECK(polygons[0].name == "upper");
  CHECK(polygons[0].thickness == 1.5);
  CHECK(polygons[0].rings.front().size() == 4);
  CHECK(polygons[0].area() == Approx(100));
  CHECK(!polygons[1].thickness);
  CHECK(polygons[1].area() == Approx(8));
  CHECK(polygons[2].area() == Approx(0.5));
  CHECK(polygons[2].number == polygons[1].number);
}

TEST_CASE("Files that hold no polygons are told why", "[map]") {
  if (!reads_map_files()) return;
  CHECK(why("not.json", "hello") != "");
  CHECK(why("cut.geojson", collection(feature("", "Polygon", square)).substr(0, 90)) != "");
  CHECK_THAT(why("none.geojson", collection("")), Catch::Contains("no polygons"));
  CHECK_THAT(why("line.geojson", collection(feature("", "LineString", "[[1000,0],[1010,0]]"))),
             Catch::Contains("expected a polygon"));
  CHECK_THAT(why("thick.geojson", collection(feature(R"("thickness":"much")", "Polygon", square))),
             Catch::Contains("got \"much\", expected metres"));
  CHECK_THAT(
      why("degrees.geojson", collection(feature("", "Polygon", "[[[11.2,47.1],[11.3,47.1],[11.3,47.2],[11.2,47.1]]]"))),
      Catch::Contains("degrees"));
  CHECK_THROWS_AS(read_map_polygons("nowhere.shp"), MapFileError);
}
