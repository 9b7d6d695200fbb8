#include <hdf5.h>

#include <catch2/catch.hpp>
#include <random>

#include "core/error.hpp"
#include "sample_frames.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

namespace {

/// A frame opened by the bare C library.
class Opened {
 public:
  explicit Opened(std::vector<std::byte> bytes) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 1 << 16, 0);
    H5Pset_file_image(access, bytes.data(), bytes.size());
    file_ = H5Fopen("opened", H5F_ACC_RDONLY, access);
    H5Pclose(access);
    REQUIRE(file_ >= 0);
  }
  ~Opened() { H5Fclose(file_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  std::vector<hsize_t> shape(const char* path) const {
    const hid_t data = H5Dopen2(file_, path, H5P_DEFAULT), space = H5Dget_space(data);
    std::vector<hsize_t> result(static_cast<std::size_t>(H5Sget_simple_extent_ndims(space)));
    H5Sget_simple_extent_dims(space, result.data(), nullptr);
    H5Sclose(space), H5Dclose(data);
    return result;
  }
  template <class T>
  std::vector<T> values(const char* path, hid_t type) const {
    std::size_t n = 1;
    for (const hsize_t k : shape(path)) n *= k;
    std::vector<T> result(n);
    const hid_t data = H5Dopen2(file_, path, H5P_DEFAULT), stored = H5Dget_type(data);
    CHECK(H5Tequal(stored, type) > 0);
    H5Dread(data, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, result.data());
    H5Tclose(stored), H5Dclose(data);
    return result;
  }
  template <class T>
  std::vector<T> attribute(const char* object, const char* name, hid_t type) const {
    const hid_t a = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT), space = H5Aget_space(a);
    std::vector<T> result(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Aread(a, type, result.data());
    H5Sclose(space), H5Aclose(a);
    return result;
  }
  std::string fixed_text(const char* object, const char* name) const {
    const hid_t a = H5Aopen_by_name(file_, object, name, H5P_DEFAULT, H5P_DEFAULT), type = H5Aget_type(a);
    CHECK(H5Tis_variable_str(type) == 0);
    std::string result(H5Tget_size(type), '\0');
    H5Aread(a, type, result.data());
    H5Tclose(type), H5Aclose(a);
    return result;
  }

 private:
  hid_t file_;
};

ExitCode code_of_reading(std::span<const std::byte> bytes) {
  try {
    read_vtkhdf(bytes, "frame");
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::done;
}

}  // namespace

TEST_CASE("a point cloud is stored as a VTKHDF unstructured grid of vertices", "[vtkhdf]") {
  const SampleCloud cloud(3);
  const Opened file(vtkhdf_bytes(cloud.view()));
  CHECK(file.fixed_text("VTKHDF", "Type") == "UnstructuredGrid");
  CHECK(file.attribute<std::int64_t>("VTKHDF", "Version", H5T_NATIVE_INT64) == std::vector<std::int64_t>{1, 0});
  for (const char* count : {"VTKHDF/NumberOfPoints", "VTKHDF/NumberOfCells", "VTKHDF/NumberOfConnectivityIds"})
    CHECK(file.values<std::int64_t>(count, H5T_STD_I64LE) == std::vector<std::int64_t>{3});
  CHECK(file.values<std::int64_t>("VTKHDF/Connectivity", H5T_STD_I64LE) == std::vector<std::int64_t>{0, 1, 2});
  CHECK(file.values<std::int64_t>("VTKHDF/Offsets", H5T_STD_I64LE) == std::vector<std::int64_t>{0, 1, 2, 3});
  CHECK(file.values<std::uint8_t>("VTKHDF/Types", H5T_STD_U8LE) == std::vector<std::uint8_t>{1, 1, 1});
  CHECK(file.shape("VTKHDF/Points") == std::vector<hsize_t>{3, 3});
  CHECK(file.values<double>("VTKHDF/Points", H5T_IEEE_F64LE) == std::vector<double>{0, 0, 100, 1, 0, 98, 2, 0, 96});
  CHECK(file.shape("VTKHDF/PointData/velocity") == std::vector<hsize_t>{3, 3});
  CHECK(file.values<float>("VTKHDF/PointData/velocity", H5T_IEEE_F32LE) ==
        std::vector<float>{0, 0, 0, 0.5f, 0, -1, 1, 0, -2});
  CHECK(file.shape("VTKHDF/PointData/mass") == std::vector<hsize_t>{3});
  CHECK(file.values<double>("VTKHDF/PointData/mass", H5T_IEEE_F64LE) == cloud.mass);
  CHECK(file.values<std::uint8_t>("VTKHDF/PointData/layer", H5T_STD_U8LE) == cloud.layer);
  CHECK(file.values<std::int64_t>("VTKHDF/PointData/id", H5T_STD_I64LE) == cloud.id);
  CHECK(file.attribute<double>("spindrift", "time", H5T_NATIVE_DOUBLE) == std::vector<double>{1.0 / 3});
  CHECK(file.attribute<std::int64_t>("spindrift", "seed", H5T_NATIVE_INT64) == std::vector<std::int64_t>{-7});
  CHECK(file.fixed_text("spindrift", "scene") == "[scene]\nname = \"Zürs\"\n");
  CHECK(file.fixed_text("spindrift", "digest").size() == 32);
}

TEST_CASE("a 2D image is stored as two identical layers", "[vtkhdf]") {
  const Opened file(vtkhdf_bytes(SampleImage(3, 1, 2).view()));
  CHECK(file.fixed_text("VTKHDF", "Type") == "ImageData");
  CHECK(file.attribute<std::int64_t>("VTKHDF", "WholeExtent", H5T_NATIVE_INT64) ==
        std::vector<std::int64_t>{0, 2, 0, 1, 0, 1});
  CHECK(file.attribute<double>("VTKHDF", "Origin", H5T_NATIVE_DOUBLE) == std::vector<double>{5, 0, 7});
  CHECK(file.attribute<double>("VTKHDF", "Spacing", H5T_NATIVE_DOUBLE) == std::vector<double>{0.5, 1, 2});
  CHECK(file.attribute<double>("VTKHDF", "Direction", H5T_NATIVE_DOUBLE) ==
        std::vector<double>{1, 0, 0, 0, 1, 0, 0, 0, 1});
  CHECK(file.shape("VTKHDF/PointData/density") == std::vector<hsize_t>{2, 2, 3});
  CHECK(file.values<float>("VTKHDF/PointData/density", H5T_IEEE_F32LE) ==
        std::vector<float>{0, 1, 2, 0, 1, 2, 3, 4, 5, 3, 4, 5});
  CHECK(file.shape("VTKHDF/PointData/velocity") == std::vector<hsize_t>{2, 2, 3, 3});
  const auto velocity = file.values<double>("VTKHDF/PointData/velocity", H5T_IEEE_F64LE);
  CHECK(std::vector(velocity.begin(), velocity.begin() + 9) ==
        std::vector<double>{0.5, 0, 1.5, 2.5, 0, 3.5, 4.5, 0, 5.5});
  CHECK(std::vector(velocity.begin() + 9, velocity.begin() + 18) ==
        std::vector(velocity.begin(), velocity.begin() + 9));
}

TEST_CASE("a 3D image is stored as it is", "[vtkhdf]") {
  const SampleImage image(3, 4, 2);
  const Opened file(vtkhdf_bytes(image.view()));
  CHECK(file.shape("VTKHDF/PointData/density") == std::vector<hsize_t>{2, 4, 3});
  CHECK(file.values<float>("VTKHDF/PointData/density", H5T_IEEE_F32LE) == image.density);
  CHECK(file.values<double>("VTKHDF/PointData/velocity", H5T_IEEE_F64LE) == image.velocity);
  CHECK(file.attribute<double>("VTKHDF", "Origin", H5T_NATIVE_DOUBLE) == std::vector<double>{5, 6, 7});
}

TEST_CASE("the same frame has the same bytes, another value another digest", "[vtkhdf]") {
  SampleCloud cloud(20000);
  const auto bytes = vtkhdf_bytes(cloud.view());
  CHECK(vtkhdf_bytes(SampleCloud(20000).view()) == bytes);
  CHECK(vtkhdf_bytes(SampleImage(40, 1, 30).view()) == vtkhdf_bytes(SampleImage(40, 1, 30).view()));
  const auto digest = [](const std::vector<std::byte>& b) { return Opened(b).fixed_text("spindrift", "digest"); };
  cloud.mass[12345] *= 1 + 1e-15;
  CHECK(digest(vtkhdf_bytes(cloud.view())) != digest(bytes));
}

TEST_CASE("the order of the arrays does not matter", "[vtkhdf]") {
  const SampleCloud cloud(5);
  PointCloud turned = cloud.view();
  std::ranges::reverse(turned.arrays);
  CHECK(vtkhdf_bytes(turned) == vtkhdf_bytes(cloud.view()));
}

TEST_CASE("frames read back", "[vtkhdf]") {
  const std::size_t n = GENERATE(0, 1, 2, 16384, 40001);
  const SampleCloud cloud(n);
  const StoredFrame frame = read_vtkhdf(vtkhdf_bytes(cloud.view()), "frame");
  CHECK_FALSE(frame.lattice);
  REQUIRE(frame.arrays.size() == 5);
  CHECK(frame.arrays[0].name == "Points");
  CHECK(frame.arrays[0].components == 3);
  CHECK(frame.arrays[1].name == "id");
  CHECK(std::get<std::vector<std::int64_t>>(frame.arrays[1].values) == cloud.id);
  CHECK(std::get<std::vector<std::uint8_t>>(frame.arrays[2].values) == cloud.layer);
  CHECK(std::get<std::vector<double>>(frame.arrays[3].values) == cloud.mass);
  CHECK(frame.arrays[4].components == 3);
  REQUIRE(frame.attributes.size() == 4);
  CHECK(frame.attributes[0].name == "digest");
  CHECK(std::get<std::string>(frame.attributes[1].value) == "[scene]\nname = \"Zürs\"\n");
  CHECK(std::get<std::int64_t>(frame.attributes[2].value) == -7);
  CHECK(std::get<double>(frame.attributes[3].value) == 1.0 / 3);

  const SampleImage image(7, 3, 5);
  const StoredFrame stored = read_vtkhdf(vtkhdf_bytes(image.view()), "image");
  REQUIRE(stored.lattice);
  CHECK(*stored.lattice == image.lattice);
  CHECK(std::get<std::vector<float>>(stored.arrays.at(0).values) == image.density);
}

TEST_CASE("frames are read whatever the folder at hand holds", "[vtkhdf]") {
  // HDF5 refuses an image in memory that has the name of a file on disk.
  const TemporaryFolder folder;
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(folder.path());
  for (const char* name : {"spindrift", "frame"}) std::ofstream(folder.path() / name) << "a program, not a frame";
  CHECK_NOTHROW(read_vtkhdf(vtkhdf_bytes(SampleCloud(3).view()), "frame"));
  std::filesystem::current_path(before);
}

TEST_CASE("a long scene fits into its attribute", "[vtkhdf]") {
  const SampleCloud sample(1);
  PointCloud cloud = sample.view();
  const std::string text(300000, 'x');
  cloud.attributes = {{"scene", text}, {"empty", ""}};
  const StoredFrame frame = read_vtkhdf(vtkhdf_bytes(cloud), "frame");
  CHECK(std::get<std::string>(frame.attributes.at(2).value) == text);
  CHECK(std::get<std::string>(frame.attributes.at(1).value).empty());
}

TEST_CASE("arrays that do not fit are a bug", "[vtkhdf]") {
  const SampleCloud sample(4);
  PointCloud cloud = sample.view();
  const std::vector<double> other(3);
  cloud.arrays.push_back({"other", 1, std::span(other)});
  CHECK_THROWS_AS(vtkhdf_bytes(cloud), Error);
  cloud = sample.view();
  cloud.arrays.push_back(cloud.arrays[0]);
  CHECK_THROWS_AS(vtkhdf_bytes(cloud), Error);
  const SampleImage image(3, 1, 3);
  LatticeImage wrong = image.view();
  wrong.lattice.shape[2] = 4;
  CHECK_THROWS_AS(vtkhdf_bytes(wrong), Error);
}

TEST_CASE("damaged frames are refused, or read as they were", "[vtkhdf]") {
  const SampleCloud cloud(300);
  const auto whole = vtkhdf_bytes(cloud.view());
  CHECK(code_of_reading({}) == ExitCode::incompatible_file);
  CHECK(code_of_reading(bytes_of("not an HDF5 file at all")) == ExitCode::incompatible_file);
  for (std::size_t n = 1; n < 20; ++n)
    CHECK(code_of_reading(std::span(whole).first(whole.size() * n / 20)) == ExitCode::incompatible_file);
  std::minstd_rand random(1);
  for (int trial = 0; trial < 300; ++trial) {
    auto bytes = whole;
    bytes[random() % bytes.size()] ^= static_cast<std::byte>(1u << random() % 8);
    ExitCode code = ExitCode::incompatible_file;
    try {
      const StoredFrame frame = read_vtkhdf(bytes, "frame");
      code = ExitCode::done;
      CHECK(std::get<std::vector<double>>(frame.arrays.at(3).values) == cloud.mass);
      CHECK(std::get<std::vector<std::int64_t>>(frame.arrays.at(1).values) == cloud.id);
    } catch (const Error& error) {
      code = error.code();
    }
    CHECK((code == ExitCode::done || code == ExitCode::incompatible_file));
  }
}
