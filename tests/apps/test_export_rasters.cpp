// The maps of a run under AvaFrame's names, and its smoke as OpenVDB, read back by the programs of others.

#include <array>
#include <catch2/catch.hpp>
#include <regex>

#include "workplace.hpp"

using namespace spindrift::testing;

namespace {

/// Smoke over a slope in 3D, on an elevation model far from zero.
const std::string cloud = R"(
schema_version = 1
[scene]
name = "small_cloud"
dim = 3
end_time = 0.05
[domain]
lower = [500000, 200000, 0]
upper = [500010, 200008, 10]
[terrain]
shape = "plane"
start = [500000, 5]
angle = "20 deg"
cell_size = 2
[dense_flow]
support_radius = 0.5
[release]
shape = "area"
thickness = 0.6
points = [[500002, 200002], [500006, 200002], [500006, 200005], [500002, 200005]]
[suspension]
cell_size = 1
[smoke]
density = 2
lower = [500002, 200002, 6]
upper = [500006, 200004, 9]
[output]
preview = false
)";

class CloudRun : public Workplace {
 public:
  CloudRun() {
    write("cloud.toml", cloud);
    REQUIRE(run("run cloud.toml -o r --quiet").code == 0);
  }
};

}  // namespace

TEST_CASE("Maps are exported under AvaFrame's names, the same numbers", "[export]") {
  const CloudRun run;
  const Outcome outcome = run.run("export r --to raster -o maps");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "maps\n");
  CHECK(outcome.err == "6 maps as asc\n");
  const std::regex name("small-cloud_[0-9a-f]{10}_null_spindrift_(pft|pfv|ppr|psd|pch|dep)\\.asc");
  std::size_t n = 0;
  for (const auto& entry : fs::directory_iterator(run.folder() / "maps")) {
    const std::string file = entry.path().filename();
    CAPTURE(file);
    CHECK(std::regex_match(file, name));
    if (file.ends_with("_pft.asc"))
      CHECK(text_of(entry.path()) == text_of(run.folder() / "r/peaks/flow_thickness.asc"));
    ++n;
  }
  CHECK(n == 6);
  CHECK(text_of(run.folder() / "r/peaks/deposit.asc")
            .starts_with("ncols 5\nnrows 4\nxllcenter 500001\nyllcenter 200001\ncellsize 2\nNODATA_value -9999\n"));
}

TEST_CASE("What has no maps is told, and other formats are refused", "[export]") {
  const CloudRun run;
  CHECK(run.run("export r --to raster --format png")
            .err.find("--format \"png\" is not known, expected one of: asc, tif") == 0);
  fs::remove_all(run.folder() / "r/peaks");
  const Outcome outcome = run.run("export r --to raster");
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find("r: has no maps, expected peaks/flow_thickness.asc") == 0);
}

TEST_CASE("GDAL reads the GeoTIFF at its place with its numbers", "[export]") {
  const CloudRun run;
  const Outcome outcome = run.run("export r --to raster --format tif -o maps");
  if (outcome.code == 2) {
    WARN("not run: built without GDAL");
    CHECK(outcome.err.find("--format tif: this build writes no GeoTIFF") == 0);
    return;
  }
  CHECK(outcome.code == 0);
  if (std::system("command -v gdalinfo >/dev/null") != 0) {
    WARN("not run: no gdalinfo");
    return;
  }
  const std::string info = run.shell("gdalinfo maps/*_pft.tif").out;
  CHECK(info.find("Size is 5, 4") != std::string::npos);
  CHECK(info.find("Origin = (500000.0") != std::string::npos);
  CHECK(info.find(",200008.0") != std::string::npos);
  CHECK(info.find("Pixel Size = (2.0") != std::string::npos);
  CHECK(info.find("NoData Value=-9999") != std::string::npos);
  const std::string ours = text_of(run.folder() / "r/peaks/flow_thickness.asc");
  const double value = std::stod(run.shell("gdallocationinfo -valonly -geoloc maps/*_pft.tif 500003 200003").out);
  CHECK(ours.find(std::to_string(value).substr(0, 5)) != std::string::npos);
}

TEST_CASE("The program works without its modules until one is asked for, and then names it", "[export]") {
  const CloudRun run;
  const auto by_copy = [&](const std::string& words) { return run.shell("./spindrift " + words); };
  fs::copy_file(SPINDRIFT_BINARY_DIR "/spindrift", run.folder() / "spindrift");
  CHECK(by_copy("export r --to raster -o maps").code == 0);
  for (const auto& [words, file, built_without] :
       {std::array{"--to vdb --frame 0 -o volumes", "spindrift_openvdb.so", "this build writes no OpenVDB"},
        std::array{"--to raster --format tif -o tifs", "spindrift_gdal.so", "this build writes no GeoTIFF"}}) {
    const std::string line = std::string("export r ") + words;
    const Outcome missing = by_copy(line);
    CAPTURE(missing.err);
    CHECK(missing.code == 2);
    if (missing.err.find(built_without) != std::string::npos) continue;
    CHECK(missing.err.find(std::string(" needs ") + file + ", which does not load: " + file + ": cannot open") !=
          std::string::npos);
    run.write(file, "not a library");
    CHECK(by_copy(line).code == 2);
    fs::remove(run.folder() / file);
    fs::copy_file(fs::path(SPINDRIFT_BINARY_DIR) / file, run.folder() / file);
    CHECK(by_copy(line).code == 0);
  }
}

TEST_CASE("OpenVDB reads smoke and its velocity back", "[export]") {
  const CloudRun run;
  const Outcome outcome = run.run("export r --to vdb --frame 0 -o volumes");
  if (outcome.code == 2) {
    WARN("not run: built without OpenVDB");
    CHECK(outcome.err.find("--to vdb: this build writes no OpenVDB") == 0);
    return;
  }
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("0 frames of particles and 1 of smoke as vdb") == 0);
  const std::string python = python_with("pyopenvdb");
  if (python.empty()) {
    WARN("not run: no python3-openvdb");
    return;
  }
  const Outcome read = run.shell(
      "'" + python +
      "' -c '\nimport pyopenvdb as vdb\n"
      "smoke, air = vdb.read(\"volumes/smoke_000000.vdb\", \"density\"), vdb.read(\"volumes/smoke_000000.vdb\", "
      "\"velocity\")\n"
      "print(smoke.gridClass, smoke.activeVoxelCount(), air.activeVoxelCount())\n"
      "print(*smoke.transform.voxelSize())\n"
      "x = smoke.transform.worldToIndex((500003.5, 200002.5, 7.5))\n"
      "at = tuple(round(i) for i in x)\n"
      "print(max(abs(a - b) for a, b in zip(x, at)) < 1e-6, smoke.getConstAccessor().getValue(at))\n"
      "print(smoke.getConstAccessor().getValue((0, 0, 9)))\n'");
  CAPTURE(read.err);
  CHECK(read.out == "fog volume 24 24\n1.0 1.0 1.0\nTrue 2.0\n0.0\n");
}
