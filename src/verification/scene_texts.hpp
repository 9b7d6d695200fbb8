#pragma once
/// Files of the project that are built into the program (cmake/SceneTexts.cmake).

#include <span>
#include <string_view>

namespace spindrift {

struct SceneText {
  std::string_view file;  ///< under configs/
  std::string_view text;
};

std::span<const SceneText> scene_texts();

/// tools/plot_verification.py
std::string_view plot_script();

}  // namespace spindrift
