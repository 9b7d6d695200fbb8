#pragma once
/// The frames of a run folder: frames/particles_000012.hdf, frames/smoke_000012.hdf.

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "io/vtkhdf.hpp"

namespace spindrift {

struct FrameFile {
  std::uint64_t number = 0;
  std::filesystem::path path;
};

/// The path of a frame within its run folder.   layer: "particles" or "smoke"
std::filesystem::path frame_path(const std::string& layer, std::uint64_t number);

/// All frames of a layer that stand in the run folder `run`, by number; none where it has no folder of frames.
/// Throws    Error(io_failed): the folder cannot be listed.
std::vector<FrameFile> frame_files(const std::filesystem::path& run, const std::string& layer);

/// Throws    Error(io_failed): the file cannot be read;  Error(incompatible_file): it is no frame.
StoredFrame read_frame_file(const std::filesystem::path& path);

[[noreturn]] void missing_array(const std::string& name, const std::string& file);

/// The values of the array `name` among those of a frame.
/// Throws    Error(incompatible_file): `file` has no such array, or one of another type than T.
template <class T>
const std::vector<T>& array_values(const std::vector<StoredArray>& arrays, const std::string& name,
                                   const std::string& file) {
  for (const StoredArray& array : arrays)
    if (array.name == name)
      if (const auto* values = std::get_if<std::vector<T>>(&array.values)) return *values;
  missing_array(name, file);
}

/// The points of a frame of particles, in single or double precision, three numbers each.
/// Throws    Error(incompatible_file): there are none, or of another type.
const StoredArray& stored_points(const std::vector<StoredArray>& arrays, const std::string& file);

/// A number that describes a whole frame, as "time" [s].   Throws Error(incompatible_file): `file` has none.
double frame_number(const StoredFrame& frame, const std::string& name, const std::filesystem::path& file);

}  // namespace spindrift
