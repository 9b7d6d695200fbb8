#pragma once
/// Scene files as they lie on the disk: their text, and the name that a scene takes from its file.

#include <filesystem>
#include <string>

namespace spindrift {

/// The whole text.   Throws Error(bad_input): there is no such file, with the likeliest one beside it; no regular file,
/// not readable, or longer than 4 MB.
std::string scene_text(const std::filesystem::path& file);

/// The file's name without folder and ending, letters that a name may not have turned into '-'.
std::string scene_name(const std::string& file);

}  // namespace spindrift
