#pragma once
/// The index that lets ParaView open a set of files as one series in time.

#include <filesystem>
#include <span>
#include <string>

namespace spindrift {

struct SeriesEntry {
  std::string name;  ///< path of the file, relative to the index
  double time = 0;   ///< [s]
};

/// Commits the JSON index `path`, named like "particles.hdf.series".   Throws Error(io_failed).
void commit_series(const std::filesystem::path& path, std::span<const SeriesEntry> entries);

}  // namespace spindrift
