#include <catch2/catch.hpp>
#include <fstream>

#include "io/point_file.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

TEST_CASE("points come from lines of two numbers", "[io]") {
  const TemporaryFolder folder;
  const auto read = [&](const std::string& text) {
    std::ofstream(folder.path() / "p.txt", std::ios::binary) << text;
    return read_points(folder.path() / "p.txt");
  };
  using Points = std::vector<std::array<double, 2>>;
  CHECK_THROWS_WITH(read("# nothing\n"), Catch::EndsWith("p.txt holds no points"));
  CHECK_THROWS_WITH(read("0 1\n5 1\n4 1\n"),
                    Catch::EndsWith("p.txt:3: x = 4 lies left of x = 5 of the point before; x may not decrease"));
  CHECK(read("x,z\n0,1\n2.5,-3e-1\n") == Points{{0, 1}, {2.5, -0.3}});
  CHECK(read("# profile\n\n 0\t1 # here\r\n2;3\n") == Points{{0, 1}, {2, 3}});
  CHECK_THROWS_WITH(read("0 1\n2 3 4\n"), Catch::EndsWith("p.txt:2: got 3 values, expected two numbers: x and z"));
  CHECK_THROWS_WITH(read("0 1\n2 nan\n"), Catch::EndsWith("p.txt:2: got \"nan\", expected a finite number"));
  CHECK_THROWS_WITH(read("x z\nx z\n"), Catch::EndsWith("p.txt:2: got \"x\", expected a finite number"));
  CHECK_THROWS_WITH(read_points(folder.path() / "none.txt"), Catch::StartsWith("there is no file "));
}
