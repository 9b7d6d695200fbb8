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

inline constexpr std::array<std::string_view, 4> frame_formats{"csv", "vtk", "ply", "vdb"};

struct ExportOptions {
  std::string format;      ///< one of frame_formats; vdb: of smoke alone
  int dim = 2;             ///< of the run
  double smoke_above = 0;  ///< csv, ply, vdb: cells with more smoke than this become points or voxels [kg/m^3]
};

/// The ending of the files that a layer becomes, without a dot.   layer: "particles" or "smoke"
std::string exported_ending(const std::string& format, const std::string& layer);

/// A frame as the bytes of a file: particles as csv, vtp or ply, smoke as csv, vti, ply or vdb. `file` is named in
/// messages. Throws    Error(incompatible_file): arrays are missing or of another type than `spindrift run` writes;
/// Error(bad_input): vdb, and a build without OpenVDB.
std::vector<std::byte> exported(const StoredFrame& frame, const ExportOptions& options,
                                const std::filesystem::path& file);

}  // namespace spindrift
