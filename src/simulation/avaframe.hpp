#pragma once
/// The folder of an avalanche as AvaFrame's users have it.

#include <filesystem>
#include <stdexcept>
#include <vector>

namespace spindrift {

/// What a folder lacks, or has too much of: "avaKot: ...".
struct AvaframeError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct AvaframeFolder {
  std::filesystem::path elevation;             ///< the one .asc or .tif in it or in Inputs/
  std::vector<std::filesystem::path> release;  ///< shapefiles of REL/ or Inputs/REL/, by name
  std::vector<std::filesystem::path> cover;    ///< of ENT/ or Inputs/ENT/; there may be none
  std::vector<std::filesystem::path>
      paths;  ///< of LINES/ or Inputs/LINES/, with "aimec" in the name; there may be none
};

/// Looks into `folder`; opens none of its files.
/// Throws AvaframeError: no such folder, no elevation model or several, no areas of release.
AvaframeFolder find_avaframe(const std::filesystem::path& folder);

}  // namespace spindrift
