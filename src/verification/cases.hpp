#pragma once
/// The verification cases of Spindrift, in the order of the page that `spindrift verify` writes.

#include <string_view>
#include <vector>

#include "verification/case.hpp"

namespace spindrift {

std::vector<Case> verification_cases();

/// The text of a scene of configs/, as it was when the program was built.
/// file: "dam_break.toml", "verification/film.toml".   Throws Error(bug): there is none of that name.
std::string_view scene_text(std::string_view file);

}  // namespace spindrift
