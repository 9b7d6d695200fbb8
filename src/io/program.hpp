#pragma once
/// Programs of others, where the machine has them.

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace spindrift {

/// The first executable file of this name on PATH, absolute; nothing if there is none.
std::optional<std::filesystem::path> program_on_path(const std::string& name);

/// Runs a program to its end in `folder`, without a shell; its input is empty and it writes nothing to the terminal.
/// Returns   nothing when it ended with 0, else why not, as one line: the last that it said.
std::optional<std::string> run_program(const std::filesystem::path& program, const std::vector<std::string>& words,
                                       const std::filesystem::path& folder);

}  // namespace spindrift
