#pragma once
/// The pictures of the verification pages, by matplotlib where the machine has it.

#include <filesystem>
#include <optional>
#include <string>

namespace spindrift {

/// Draws what stands in the tables of `folder`, by tools/plot_verification.py, which is built in.
/// what: "cases" | "stability" | "refinement"
/// Returns   nothing when the pictures are there, else why not, as one line for the user.
std::optional<std::string> plot(const std::string& what, const std::filesystem::path& folder);

}  // namespace spindrift
