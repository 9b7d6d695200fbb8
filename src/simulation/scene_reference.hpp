#pragma once
/// The page of the docs that tells everything a scene may say.

#include <string>

namespace spindrift {

/// Markdown: a short guide, then one table a section from the registry.
std::string scene_reference();

}  // namespace spindrift
