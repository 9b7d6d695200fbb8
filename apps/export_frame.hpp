#pragma once
/// A frame in the formats of others.

#include <array>
#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "io/vtkhdf.hpp"

namespace spindrift {

inline constexpr std::array<std::string_view, 3> export_formats{"csv", "vtk", "ply"};

struct ExportOptions {
  std::string format;      ///< one of export_formats
  int dim = 2;             ///< of the run
  double smoke_above = 0;  ///< csv, ply: cells with more smoke than this become points [kg/m^3]
};

/// The ending of the files that a layer becomes, without a dot.   layer: "particles" or "smoke"
std::string exported_ending(const std::string& format, const std::string& layer);

/// A frame as the bytes of a file: particles as csv, vtp or ply, smoke as csv, vti or ply. `file` is named in messages.
/// Throws    Error(incompatible_file): arrays are missing or of another type than `spindrift run` writes.
std::vector<std::byte> exported(const StoredFrame& frame, const ExportOptions& options,
                                const std::filesystem::path& file);

}  // namespace spindrift
