#include "io/vtk_xml.hpp"

#include <fmt/format.h>

#include <bit>
#include <cstring>
#include <numeric>

namespace spindrift {

static_assert(std::endian::native == std::endian::little, "values are copied as they stand in memory");

namespace {

constexpr const char* declaration = "<?xml version=\"1.0\"?>\n";

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    switch (c) {
      case '&':
        result += "&amp;";
        break;
      case '<':
        result += "&lt;";
        break;
      case '"':
        result += "&quot;";
        break;
      default:
        result += c;
    }
  }
  return result;
}

/// A file that grows as text first and keeps its arrays for the end.
class XmlFile {
 public:
  void text(std::string_view more) { text_ += more; }

  void array(const std::string& name, int components, const decltype(NamedArray::values)& values) {
    constexpr const char* types[] = {"Float32", "Float64", "UInt8", "Int64"};  // in the order of the variant
    text_ += fmt::format(
        "<DataArray type=\"{}\" Name=\"{}\" NumberOfComponents=\"{}\" format=\"appended\" offset=\"{}\"/>\n",
        types[values.index()], escaped(name), components, data_.size());
    std::visit(
        [this](const auto& v) {
          const auto bytes = std::as_bytes(v);
          const std::uint64_t size = bytes.size();
          const auto header = std::as_bytes(std::span(&size, 1));
          data_.insert(data_.end(), header.begin(), header.end());
          data_.insert(data_.end(), bytes.begin(), bytes.end());
        },
        values);
  }

  std::vector<std::byte> bytes() const {
    const std::string before = text_ + "<AppendedData encoding=\"raw\">\n_";
    constexpr std::string_view after = "\n</AppendedData>\n</VTKFile>\n";
    std::vector<std::byte> all;
    all.reserve(before.size() + data_.size() + after.size());
    for (const auto part :
         {std::as_bytes(std::span(before)), std::span<const std::byte>(data_), std::as_bytes(std::span(after))})
      all.insert(all.end(), part.begin(), part.end());
    return all;
  }

 private:
  std::string text_;
  std::vector<std::byte> data_;
};

std::string opening(const char* type) {
  return fmt::format("{}<VTKFile type=\"{}\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\">\n",
                     declaration, type);
}

std::string time_field(double time) {
  return fmt::format(
      "<FieldData>\n<DataArray type=\"Float64\" Name=\"TimeValue\" NumberOfTuples=\"1\" format=\"ascii\">{}"
      "</DataArray>\n</FieldData>\n",
      time);
}

void point_data(XmlFile& file, const std::vector<NamedArray>& arrays) {
  file.text("<PointData>\n");
  for (const NamedArray& array : arrays) file.array(array.name, array.components, array.values);
  file.text("</PointData>\n");
}

}  // namespace

std::vector<std::byte> vtp_bytes(const PointCloud& cloud, double time) {
  const std::size_t n = cloud.n_points();
  std::vector<std::int64_t> numbers(n + 1);
  std::iota(numbers.begin(), numbers.end(), 0);
  const std::span<const std::int64_t> all = numbers;

  XmlFile file;
  file.text(opening("PolyData") + "<PolyData>\n" + time_field(time));
  file.text(
      fmt::format("<Piece NumberOfPoints=\"{0}\" NumberOfVerts=\"{0}\" NumberOfLines=\"0\" "
                  "NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n",
                  n));
  point_data(file, cloud.arrays);
  file.text("<Points>\n");
  file.array("Points", cloud.positions.components, cloud.positions.values);
  file.text("</Points>\n<Verts>\n");
  file.array("connectivity", 1, all.first(n));
  file.array("offsets", 1, all.subspan(1));
  file.text("</Verts>\n</Piece>\n</PolyData>\n");
  return file.bytes();
}

std::vector<std::byte> vti_bytes(const LatticeImage& image, double time) {
  const Lattice& lattice = image.lattice;
  const std::string extent =
      fmt::format("0 {} 0 {} 0 {}", lattice.shape[0] - 1, lattice.shape[1] - 1, lattice.shape[2] - 1);
  XmlFile file;
  file.text(opening("ImageData") + fmt::format("<ImageData WholeExtent=\"{}\" Origin=\"{}\" Spacing=\"{}\">\n", extent,
                                               fmt::join(lattice.origin, " "), fmt::join(lattice.spacing, " ")));
  file.text(time_field(time) + fmt::format("<Piece Extent=\"{}\">\n", extent));
  point_data(file, image.arrays);
  file.text("</Piece>\n</ImageData>\n");
  return file.bytes();
}

std::string pvd_text(std::span<const SeriesEntry> entries) {
  std::string text = std::string(declaration) + "<VTKFile type=\"Collection\" version=\"0.1\">\n<Collection>\n";
  for (const SeriesEntry& entry : entries)
    text += fmt::format("<DataSet timestep=\"{}\" part=\"0\" file=\"{}\"/>\n", entry.time, escaped(entry.name));
  return text + "</Collection>\n</VTKFile>\n";
}

}  // namespace spindrift
