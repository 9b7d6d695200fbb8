#include "export_frame.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "io/csv_points.hpp"
#include "io/frame_files.hpp"
#include "io/lattice_points.hpp"
#include "io/ply.hpp"
#include "io/vdb.hpp"
#include "io/vtk_xml.hpp"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

template <class T>
const std::vector<T>& values_of(const StoredFrame& frame, const std::string& name, const fs::path& file) {
  return array_values<T>(frame.arrays, name, file.string());
}

/// The frame's points, ids first; `positions` are not among the arrays.
PointCloud cloud_of(const std::vector<StoredArray>& arrays, const NamedArray& positions, const Attributes& attributes) {
  PointCloud cloud{positions, {}, attributes};
  for (const StoredArray& array : arrays)
    if (array.name != positions.name) cloud.arrays.push_back(array.view());
  std::ranges::stable_partition(cloud.arrays, [](const NamedArray& array) { return array.name == "id"; });
  return cloud;
}

std::vector<std::byte> as_points(PointCloud cloud, const StoredArray& radius, const ExportOptions& options,
                                 const fs::path& file, const StoredFrame& frame) {
  if (options.format == "vtk") return vtp_bytes(cloud, frame_number(frame, "time", file));
  if (options.format == "ply") {
    cloud.arrays.push_back(radius.view());
    return ply_bytes(cloud);
  }
  const std::string text = csv_text(cloud);
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

std::vector<std::byte> exported_particles(const StoredFrame& frame, const ExportOptions& options,
                                          const fs::path& file) {
  const auto& mass = values_of<float>(frame, "mass", file);
  const auto& density = values_of<float>(frame, "density", file);
  std::vector<float> radius(mass.size());
  for (std::size_t i = 0; i < mass.size(); ++i)
    radius[i] = 0.5f * std::pow(mass[i] / density[i], 1.0f / static_cast<float>(options.dim));
  const StoredArray& positions = stored_points(frame.arrays, file.string());
  return as_points(cloud_of(frame.arrays, positions.view(), frame.attributes), {"radius", 1, std::move(radius)},
                   options, file, frame);
}

std::vector<std::byte> exported_smoke(const StoredFrame& frame, const ExportOptions& options, const fs::path& file) {
  const auto& density = values_of<float>(frame, "density", file);
  if (options.format == "vdb") return vdb_bytes(frame, options.smoke_above, file.string());
  if (options.format == "vtk") {
    LatticeImage image{*frame.lattice, {}, frame.attributes};
    for (const StoredArray& array : frame.arrays) image.arrays.push_back(array.view());
    return vti_bytes(image, frame_number(frame, "time", file));
  }
  // A frame of two dimensions stores its one layer of cells twice, for readers that know no flat images.
  const auto& shape = frame.lattice->shape;
  const std::size_t nx = static_cast<std::size_t>(shape[0]), ny = static_cast<std::size_t>(shape[1]);
  std::vector<std::size_t> points;
  for (std::size_t i = 0; i < density.size(); ++i)
    if (static_cast<double>(density[i]) > options.smoke_above && (options.dim == 3 || i / nx % ny == 0))
      points.push_back(i);
  const StoredCloud cloud = lattice_points(frame, points);
  const float half = 0.5f * static_cast<float>(frame.lattice->spacing[0]);
  return as_points(cloud_of(cloud.arrays, cloud.positions.view(), frame.attributes),
                   {"radius", 1, std::vector<float>(points.size(), half)}, options, file, frame);
}

}  // namespace

std::string exported_ending(const std::string& format, const std::string& layer) {
  if (format != "vtk") return format;
  return layer == "smoke" ? "vti" : "vtp";
}

std::vector<std::byte> exported(const StoredFrame& frame, const ExportOptions& options, const fs::path& file) {
  return frame.lattice ? exported_smoke(frame, options, file) : exported_particles(frame, options, file);
}

}  // namespace spindrift
