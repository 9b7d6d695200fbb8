#pragma once
/// What people mean by lines that are not TOML.

#include <string>
#include <string_view>

namespace spindrift {

/// `; words stand in quotes: solver = "dfsph"`, or nothing.
/// text: of the whole file;   line: of the error, from 1;   why: the TOML package's complaint
std::string syntax_hint(std::string_view text, std::size_t line, std::string_view why);

}  // namespace spindrift
