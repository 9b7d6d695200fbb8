#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>

#include "io/esri_grid.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;
using Catch::EndsWith;

namespace {

const std::string header = "ncols 3\nnrows 2\nxllcorner 100\nyllcorner 50\ncellsize 10\nNODATA_value -9999\n";

ElevationGrid parsed(const std::string& text) {
  return parse_esri_grid(text, "dem.asc");
}

}  // namespace

TEST_CASE("A grid has its first height in the middle of its south-western cell", "[io]") {
  const ElevationGrid grid = parsed(header + "1 2 3\n4 5 6\n");
  CHECK(grid.columns == 3);
  CHECK(grid.rows == 2);
  CHECK(grid.cell == 10);
  CHECK(grid.x == 105);
  CHECK(grid.y == 55);
  CHECK(grid.z == std::vector<double>{4, 5, 6, 1, 2, 3});  // from the south on
  CHECK(grid.at(2, 0) == 6);
}

TEST_CASE("Grids come in every habit of writing", "[io]") {
  const std::string plain = header + "1 2 3\n4 5 -9999\n";
  std::string text = plain;
  const auto replace = [&](const std::string& from, const std::string& to) {
    for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
      text.replace(at, from.size(), to);
  };
  SECTION("Windows line ends") {
    replace("\n", "\r\n");
  }
  SECTION("tabs, blanks and empty lines") {
    replace(" ", " \t ");
    replace("\n", "  \n\n");
  }
  SECTION("other letter cases") {
    replace("ncols", "NCOLS");
    replace("cellsize", "CellSize");
    replace("NODATA_value", "nodata_VALUE");
  }
  SECTION("middles of cells") {
    replace("xllcorner 100", "XLLCENTER 105");
    replace("yllcorner 50", "yllcentre 55");
  }
  SECTION("another order") {
    replace("ncols 3\n", "");
    replace("NODATA_value -9999\n", "NODATA_value -9999\nncols 3\n");
  }
  SECTION("without NODATA_value") {
    replace("NODATA_value -9999\n", "");
  }
  SECTION("line breaks anywhere") {
    replace("1 2 3\n4 5 -9999", "1\n2 3 4\n5\n\n-9999");
  }
  SECTION("a byte order mark, and no last line end") {
    text.pop_back();
    text = "\xEF\xBB\xBF" + text;
  }
  SECTION("nan for a hole") {
    replace("-9999\n", "nan\n"), replace("NODATA_value nan", "NODATA_value -1");
  }
  SECTION("a hole with more digits than its value") {
    replace("NODATA_value -9999", "NODATA_value -3.40282e+38");
    replace("5 -9999", "5 -3.4028234663852886e+38");
  }
  SECTION("dx and dy") {
    replace("cellsize 10", "dx 10\ndy 10.000000000000002");
  }
  SECTION("exponents and signs") {
    replace("1 2 3", "+1.0 2e0 0.3E+1");
  }
  const ElevationGrid a = parsed(plain), b = parsed(text);
  CHECK((a.x == b.x && a.y == b.y && a.cell == b.cell && a.columns == b.columns));
  REQUIRE(b.z.size() == 6);
  for (std::size_t i = 0; i < 6; ++i) {
    if (i == 2) {
      CHECK(std::isnan(b.z[i]));
    } else {
      CHECK(b.z[i] == a.z[i]);
    }
  }
}

TEST_CASE("What is no grid is refused with its place", "[io]") {
  const auto refused = [](const std::string& text, const std::string& why) {
    CAPTURE(text.substr(0, 100));
    CHECK_THROWS_WITH(parsed(text), why);
  };
  refused("", "dem.asc is empty");
  refused(" \r\n\n", "dem.asc is empty");
  refused(header + "1 2 3\n4 5\n", "dem.asc: ends after 5 of 3 x 2 heights");
  refused(header, "dem.asc: ends after 0 of 3 x 2 heights");
  refused(header + "1 2 3\n4 5 6\n7\n", "dem.asc:9: goes on after its 3 x 2 heights");
  refused(header + "1 2 3\n4 x 6\n", "dem.asc:8: got \"x\", expected the height in column 2 of row 2 from the north");
  refused(header + "1 2 3\n4 5,5 6\n",
          "dem.asc:8: got \"5,5\", expected the height in column 2 of row 2 from the north; decimals have a point");
  refused(header + "1 2 3\n4 1e39 6\n",
          "dem.asc:8: got \"1e39\", expected a height from -1e5 to 1e5 m; holes have NODATA_value, -9999");
  refused(header + "1 2 3\n4 inf 6\n",
          "dem.asc:8: got \"inf\", expected a height from -1e5 to 1e5 m; holes have NODATA_value, -9999");
  refused("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\n1 2 3 4 5 6\n", "dem.asc: its header has no cellsize");
  refused("nrows 2\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2\n", "dem.asc: its header has no ncols");
  refused("ncols 3\nnrows 2\nyllcorner 0\ncellsize 1\n1 2\n",
          "dem.asc: its header has neither xllcorner nor xllcenter");
  refused("xllcenter 3\n" + header, "dem.asc: its header has both xllcorner and xllcenter");
  refused("ncols 3\nncols 3\n", "dem.asc:2: ncols stands there twice");
  refused("ncols 2.5\nnrows 2\n1 1", "dem.asc: ncols is 2.5, expected a whole number from 2 on");
  refused("ncols -3\nnrows 2\n1 1", "dem.asc: ncols is -3, expected a whole number from 2 on");
  refused("ncols 1e300\nnrows 2\n1 1", "dem.asc: ncols is 1e+300, expected a whole number from 2 on");
  refused("ncols 40000000\nnrows 40000000\nxllcorner 0\nyllcorner 0\ncellsize 1\n1 2 3",
          "dem.asc: 40000000 x 40000000 heights, at most 5e+07 can be: cut it to the part that the domain covers");
  refused("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ncellsize 0\n1",
          "dem.asc: cellsize is 0, expected more than 0 and "
          "at most 1e5 m");
  refused("ncols 3\nnrows 2\nxllcorner 0\nyllcorner 0\ndx 1\ndy 2\n1",
          "dem.asc: cells of 1 x 2 m, expected square ones");
  refused("ncols three\n", "dem.asc:1: got \"three\", expected a number behind ncols");
  refused("ncols\n", "dem.asc:2: got \"\", expected a number behind ncols");
  refused("cellsize nan\n", "dem.asc:1: got \"nan\", expected a number behind cellsize");
  refused("cellsize 2,5\n", "dem.asc:1: got \"2,5\", expected a number behind cellsize; decimals have a point");
  refused("\x89PNG\r\n",
          "dem.asc:1: got \"?PNG\", expected the header of an ESRI ASCII grid: ncols, nrows, xllcorner or xllcenter, "
          "yllcorner or yllcenter, cellsize, NODATA_value");
  refused(std::string("II*\0\1\2", 6),
          "dem.asc is a TIFF, expected an ESRI ASCII grid: gdal_translate -of AAIGrid makes one");
}

TEST_CASE("Grid files that cannot be read say so", "[io]") {
  const TemporaryFolder folder;
  CHECK_THROWS_WITH(read_esri_grid(folder.path() / "none.asc"), Catch::StartsWith("there is no file "));
  CHECK_THROWS_WITH(read_esri_grid(folder.path()), EndsWith(" is no regular file"));
  std::ofstream(folder.path() / "huge.asc").put('1');
  std::filesystem::resize_file(folder.path() / "huge.asc", 1'000'000'001);  // sparse: takes no space
  CHECK_THROWS_WITH(read_esri_grid(folder.path() / "huge.asc"),
                    EndsWith(" is longer than the 1 GB that a grid may have"));
}

TEST_CASE("A grid that is written reads back as the same bits", "[io]") {
  const TemporaryFolder folder;
  ElevationGrid grid{3, 2, 223000.123456789, -4.99768890660 / 3, 4.99768890660, {}};
  grid.z = {1.0 / 3, -2e-300, 99999.5, std::nan(""), 0, 2047.0000000000002};
  std::ofstream(folder.path() / "g.asc") << esri_grid_text(grid);
  const ElevationGrid back = read_esri_grid(folder.path() / "g.asc");
  CHECK((back.x == grid.x && back.y == grid.y && back.cell == grid.cell));
  REQUIRE(back.z.size() == grid.z.size());
  for (std::size_t i = 0; i < grid.z.size(); ++i)
    CHECK((back.z[i] == grid.z[i] || (std::isnan(back.z[i]) && std::isnan(grid.z[i]))));
}
