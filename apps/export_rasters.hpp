#pragma once
/// The maps of a 3D run under the names that AvaFrame's tools look for.

#include <array>
#include <filesystem>
#include <string_view>

namespace spindrift {

inline constexpr std::array<std::string_view, 2> raster_formats{"asc", "tif"};

/// Writes peaks/NAME.asc of a run folder to `out` as RELEASE_SIMID_SIMTYPE_MODELTYPE_{pft,pfv,ppr,...}.FORMAT: the
/// scene's name with '-' for '_', ten digits of the scene's digest, "ent" or "null" (without entrainment), "spindrift".
/// format   one of raster_formats
/// Returns how many.   Throws Error: bad_input, the run has no maps, or a build without GDAL was asked for tif;
/// incompatible_file, a map cannot be read;  io_failed.
std::size_t export_rasters(const std::filesystem::path& run, const std::filesystem::path& out, std::string_view format);

}  // namespace spindrift
