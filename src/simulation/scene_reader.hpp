#pragma once
/// A scene file, checked as a whole before anything else is touched.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "simulation/scene.hpp"

namespace spindrift {

/// Where sections begin and values were set, by their paths: "my.toml:12:9" or "--set".
using Origins = std::map<std::string, std::string, std::less<>>;

/// settings  "key=value" from the command line, in order, each overriding the file and those before it
/// Throws Error(bad_input) with one line an error, `file:line:column: key: got X, expected Y; did you mean "Z"?`, all
/// of them at once, at most 20.  Errors in settings stand at "--set".
/// origins   out where not null
Scene parse_scene(std::string_view text, const std::string& file, const std::vector<std::string>& settings = {},
                  Origins* origins = nullptr);

/// The same from a regular file of at most 4 MB.
Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings = {},
                 Origins* origins = nullptr);

}  // namespace spindrift
