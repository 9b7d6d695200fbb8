#pragma once
/// Whether two files of a map are told in the same coordinates.

#include <filesystem>

namespace spindrift {

/// False where both shapes and elevation model say which system of coordinates they are in, by a .prj beside them or
/// by themselves, and these are neither the same nor put the model's middle at the same place, to a metre. True also
/// in a build without GDAL.
/// Pre: both files were read without complaint, the shapes by GDAL.
bool same_coordinates(const std::filesystem::path& shapes, const std::filesystem::path& model);

}  // namespace spindrift
