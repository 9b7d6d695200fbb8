#pragma once
/// Points in the plane from a text file.

#include <array>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace spindrift {

/// Where and why a file is no list of points: "profile.txt:12: ...".
struct PointFileError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// One point a line: two numbers, apart by blanks, tabs, a comma or a semicolon. Empty lines and what follows '#' count
/// for nothing, nor does a first line of words. At most 16 MB.
/// Throws PointFileError: no such file, no points, a line that is not two finite numbers, x that decreases.
std::vector<std::array<double, 2>> read_points(const std::filesystem::path& file);

}  // namespace spindrift
