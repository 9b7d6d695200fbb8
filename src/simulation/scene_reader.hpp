#pragma once
/// A scene file, checked as a whole before anything else is touched.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/scene.hpp"

namespace spindrift {

/// settings  "key=value" from the command line, in order, each overriding the file and those before it
/// Throws Error(bad_input) with one line an error, `file:line:column: key: got X, expected Y; did you mean "Z"?`, all
/// of them at once, at most 20.  Errors in settings stand at "--set".
Scene parse_scene(std::string_view text, const std::string& file, const std::vector<std::string>& settings = {});

/// The same from a regular file of at most 64 kB.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings = {});

}  // namespace spindrift
