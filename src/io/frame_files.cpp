#include "io/frame_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

#include "core/error.hpp"

namespace spindrift {

namespace fs = std::filesystem;

fs::path frame_path(const std::string& layer, std::uint64_t number) {
  return fmt::format("frames/{}_{:06}.hdf", layer, number);
}

std::vector<FrameFile> frame_files(const fs::path& run, const std::string& layer) {
  std::vector<FrameFile> files;
  try {
    if (!fs::is_directory(run / "frames")) return files;
    for (const fs::directory_entry& entry : fs::directory_iterator(run / "frames")) {
      const std::string name = entry.path().filename().string();
      if (!name.starts_with(layer + "_")) continue;
      std::uint64_t number = 0;
      std::from_chars(name.data() + layer.size() + 1, name.data() + name.size(), number);
      if (frame_path(layer, number).filename() == name) files.push_back({number, entry.path()});
    }
  } catch (const fs::filesystem_error& reason) {
    throw Error(ExitCode::io_failed, fmt::format("cannot list {}: {}", run.string(), reason.code().message()));
  }
  std::ranges::sort(files, {}, &FrameFile::number);
  return files;
}

StoredFrame read_frame_file(const fs::path& path) {
  std::string text;
  try {
    std::ifstream stream;
    stream.exceptions(std::ios::badbit | std::ios::failbit);
    stream.open(path, std::ios::binary);
    text.assign(std::istreambuf_iterator<char>(stream), {});
  } catch (const std::ios_base::failure&) {
    throw Error(ExitCode::io_failed, path.string() + ": cannot be read");
  }
  return read_vtkhdf(std::as_bytes(std::span(text)), path.string());
}

void missing_array(const std::string& name, const std::string& file) {
  throw Error(ExitCode::incompatible_file,
              fmt::format("{}: expected an array \"{}\" as `spindrift run` writes it", file, name));
}

const StoredArray& stored_points(const std::vector<StoredArray>& arrays, const std::string& file) {
  for (const StoredArray& array : arrays)
    if (array.name == "Points" && (std::holds_alternative<std::vector<float>>(array.values) ||
                                   std::holds_alternative<std::vector<double>>(array.values)))
      return array;
  missing_array("Points", file);
}

double frame_number(const StoredFrame& frame, const std::string& name, const fs::path& file) {
  for (const Attribute& attribute : frame.attributes)
    if (attribute.name == name)
      if (const auto* number = std::get_if<double>(&attribute.value)) return *number;
  throw Error(ExitCode::incompatible_file, fmt::format("{}: has no {}", file.string(), name));
}

}  // namespace spindrift
