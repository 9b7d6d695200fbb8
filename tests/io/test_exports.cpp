// The formats of others, from a few hand-made points.

#include <catch2/catch.hpp>
#include <cstring>

#include "core/error.hpp"
#include "io/commit.hpp"
#include "io/csv_points.hpp"
#include "io/frame_files.hpp"
#include "io/lattice_points.hpp"
#include "io/ply.hpp"
#include "io/vtk_xml.hpp"
#include "sample_frames.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

namespace {

std::string text_of(const std::vector<std::byte>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

template <class T>
T value_at(const std::string& text, std::size_t at) {
  T value;
  std::memcpy(&value, text.data() + at, sizeof value);
  return value;
}

const std::vector<float> three_points{0, 0, 0.1f, 1, 0, -2, 3, 0, 1e-7f};
const std::vector<std::int64_t> ids{7, 8, -9};
const std::vector<std::uint8_t> layer{0, 1, 255};
const std::vector<double> mass{1.0 / 3, 2, 1e300};

PointCloud three() {
  return {{"Points", 3, std::span(three_points)},
          {{"id", 1, std::span(ids)}, {"layer", 1, std::span(layer)}, {"mass", 1, std::span(mass)}},
          {{"time", 0.25}, {"unit.mass", "kg"}, {"scene", "two\nlines"}}};
}

}  // namespace

TEST_CASE("points as a table: units in the header, numbers that read back", "[export]") {
  CHECK(csv_text(three()) ==
        "x [m],y [m],z [m],id,layer,mass [kg]\n"
        "0,0,0.1,7,0,0.3333333333333333\n"
        "1,0,-2,8,1,2\n"
        "3,0,1e-07,-9,255,1e+300\n");
  CHECK(csv_text(SampleCloud(0).view()) == "x [m],z [m],velocity_x,velocity_z,mass,layer,id\n");
}

TEST_CASE("points as PLY", "[export]") {
  const std::string text = text_of(ply_bytes(three()));
  const std::string header =
      "ply\nformat binary_little_endian 1.0\ncomment time: 0.25\ncomment unit.mass: kg\ncomment scene: two lines\n"
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\nproperty int id\nproperty uchar layer\n"
      "property double mass\nend_header\n";
  REQUIRE(text.starts_with(header));
  const std::size_t row = 3 * 4 + 4 + 1 + 8, last = header.size() + 2 * row;
  CHECK(text.size() == header.size() + 3 * row);
  CHECK(value_at<float>(text, header.size() + 8) == 0.1f);
  CHECK(value_at<std::int32_t>(text, last + 12) == -9);
  CHECK(value_at<std::uint8_t>(text, last + 16) == 255);
  CHECK(value_at<double>(text, last + 17) == 1e300);
}

TEST_CASE("numbers that PLY has no integers for are doubles", "[export]") {
  const std::string text = text_of(ply_bytes(SampleCloud(2).view()));  // ids about -2^62
  CHECK(text.find("property double id\n") != std::string::npos);
  CHECK(value_at<double>(text, text.size() - 8) == static_cast<double>(1 - (std::int64_t{1} << 62)));
}

TEST_CASE("points as VTK's PolyData", "[export]") {
  const std::string text = text_of(vtp_bytes(three(), 0.25));
  CHECK(text.find("<VTKFile type=\"PolyData\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">") !=
        std::string::npos);
  CHECK(text.find("Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">0.25</DataArray>") != std::string::npos);
  const std::size_t data = text.find("<AppendedData encoding=\"raw\">\n_") + 31;
  CHECK(value_at<std::uint64_t>(text, data) == 3 * sizeof(std::int64_t));
  CHECK(value_at<std::int64_t>(text, data + 8 + 16) == -9);
  CHECK(text.find("<DataArray type=\"UInt8\" Name=\"layer\" NumberOfComponents=\"1\" format=\"appended\" "
                  "offset=\"32\"/>") != std::string::npos);
  CHECK(value_at<std::uint64_t>(text, data + 32) == 3);
  CHECK(text.ends_with("\n</AppendedData>\n</VTKFile>\n"));
}

TEST_CASE("a lattice as VTK's ImageData, and a series of files", "[export]") {
  const std::string text = text_of(vti_bytes(SampleImage(3, 4, 5).view(), 2.5));
  CHECK(text.find("<ImageData WholeExtent=\"0 2 0 3 0 4\" Origin=\"5 6 7\" Spacing=\"0.5 0.25 2\">") !=
        std::string::npos);
  const std::vector<SeriesEntry> entries{{"a<\"&.vti", 0.1}, {"b.vti", 2}};
  CHECK(pvd_text(entries) ==
        "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n"
        "<DataSet timestep=\"0.1\" part=\"0\" file=\"a&lt;&quot;&amp;.vti\"/>\n"
        "<DataSet timestep=\"2\" part=\"0\" file=\"b.vti\"/>\n</Collection>\n</VTKFile>\n");
}

TEST_CASE("chosen points of a lattice become a cloud", "[export]") {
  const SampleImage sample(3, 4, 5);
  const StoredFrame image = read_vtkhdf(vtkhdf_bytes(sample.view()), "sample");
  const StoredCloud cloud = lattice_points(image, std::vector<std::size_t>{0, 1 + 3 * (2 + 4 * 3)});
  CHECK(std::get<std::vector<float>>(cloud.positions.values) == std::vector<float>{5, 6, 7, 5.5f, 6.5f, 13});
  REQUIRE(cloud.arrays.size() == 2);
  CHECK(std::get<std::vector<float>>(cloud.arrays[0].values) == std::vector<float>{0, 43});
  CHECK(std::get<std::vector<double>>(cloud.arrays[1].values) ==
        std::vector<double>{0.5, 1.5, 2.5, 129.5, 130.5, 131.5});
}

TEST_CASE("frames are found by their names, and read", "[export]") {
  const TemporaryFolder folder;
  CHECK(frame_files(folder.path(), "smoke").empty());
  std::filesystem::create_directory(folder.path() / "frames");
  const auto bytes = vtkhdf_bytes(SampleCloud(4).view());
  for (const char* name : {"particles_000010.hdf", "particles_000002.hdf", "particles_1000000.hdf", "particles_3.hdf",
                           "particles_000004.hdf.tmp", ".particles_000005.hdf", "smoke_000006.hdf", "particles_.hdf"})
    commit(folder.path() / "frames" / name, bytes);
  const auto files = frame_files(folder.path(), "particles");
  REQUIRE(files.size() == 3);
  CHECK(files[0].number == 2);
  CHECK(files[1].number == 10);
  CHECK(files[2].number == 1000000);
  CHECK(files[1].path == folder.path() / frame_path("particles", 10));

  const StoredFrame frame = read_frame_file(files[0].path);
  CHECK(frame.arrays.size() == 5);
  CHECK(frame_number(frame, "time", files[0].path) == 1.0 / 3);
  const auto code = [](auto&& f) {
    try {
      f();
    } catch (const Error& error) {
      return error.code();
    }
    return ExitCode::done;
  };
  CHECK(code([&] { frame_number(frame, "tide", "file"); }) == ExitCode::incompatible_file);
  CHECK(code([&] { read_frame_file(folder.path() / "absent.hdf"); }) == ExitCode::io_failed);
  CHECK(code([&] { read_frame_file(folder.path()); }) == ExitCode::io_failed);
  commit(folder.path() / "text.hdf", std::string_view("text"));
  CHECK(code([&] { read_frame_file(folder.path() / "text.hdf"); }) == ExitCode::incompatible_file);
}
