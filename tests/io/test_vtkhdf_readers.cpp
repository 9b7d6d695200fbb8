#include <catch2/catch.hpp>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "io/commit.hpp"
#include "sample_frames.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

namespace {

/// A Python that has VTK and h5py, or nothing.
std::string python() {
  for (const std::string name : {"python3", "/usr/bin/python3"})
    if (std::system((name + " -c 'import vtk, h5py' 2> /dev/null").c_str()) == 0) return name;
  return "";
}

}  // namespace

TEST_CASE("VTK and h5py read the frames", "[vtkhdf][slow]") {
  const std::string interpreter = python();
  if (interpreter.empty()) {
    WARN("skipped: no python3 with vtk and h5py");
    return;
  }
  const TemporaryFolder folder;
  const SampleCloud cloud(20000);
  const SampleImage flat(6, 1, 4), box(3, 4, 5);
  commit(folder.path() / "cloud.hdf", vtkhdf_bytes(cloud.view()));
  commit(folder.path() / "flat.hdf", vtkhdf_bytes(flat.view()));
  commit(folder.path() / "box.hdf", vtkhdf_bytes(box.view()));
  commit(folder.path() / "empty.hdf", vtkhdf_bytes(SampleCloud(0).view()));
  const auto output = folder.path() / "read.json";
  const std::string files = " cloud.hdf flat.hdf box.hdf empty.hdf";
  REQUIRE(std::system(("cd " + folder.path().string() + " && " + interpreter +
                       " " SPINDRIFT_SOURCE_DIR "/tests/io/read_back.py" + files + " > read.json")
                          .c_str()) == 0);
  const auto read = nlohmann::json::parse(text_of(output));

  const auto& points = read.at(0).at("vtk");
  CHECK(points.at("class") == "vtkUnstructuredGrid");
  CHECK(points.at("n_points") == 20000);
  CHECK(points.at("n_cells") == 20000);
  CHECK(points.at("cell_type") == 1);
  CHECK(points.at("bounds") == std::vector<double>{0, 19999, 0, 0, 100 - 2 * 19999, 100});
  CHECK(points.at("arrays").at("mass").at("values") == cloud.mass);
  CHECK(points.at("arrays").at("mass").at("type") == "float64");
  CHECK(points.at("arrays").at("velocity").at("type") == "float32");
  CHECK(points.at("arrays").at("layer").at("type") == "uint8");
  CHECK(points.at("arrays").at("id").at("values") == cloud.id);
  const auto& attributes = read.at(0).at("h5py").at("attributes");
  CHECK(attributes.at("scene") == "[scene]\nname = \"Zürs\"\n");
  CHECK(attributes.at("time") == 1.0 / 3);
  CHECK(attributes.at("seed") == -7);
  CHECK(attributes.at("format") == std::vector<int>{1, 0});

  const auto& image = read.at(1).at("vtk");
  CHECK(image.at("class") == "vtkImageData");
  CHECK(image.at("bounds") == std::vector<double>{5, 7.5, 0, 1, 7, 13});
  CHECK(image.at("n_points") == 48);
  const auto values = image.at("arrays").at("density").at("values").get<std::vector<float>>();
  for (std::size_t z = 0; z < 4; ++z)
    for (std::size_t y = 0; y < 2; ++y)
      for (std::size_t x = 0; x < 6; ++x) CHECK(values.at((z * 2 + y) * 6 + x) == static_cast<float>(6 * z + x));

  CHECK(read.at(2).at("vtk").at("bounds") == std::vector<double>{5, 6, 6, 6.75, 7, 15});
  CHECK(read.at(2).at("vtk").at("arrays").at("velocity").at("values") == box.velocity);
  CHECK(read.at(3).at("vtk").at("n_points") == 0);
}
