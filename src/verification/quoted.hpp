#pragma once
/// Text in a table of commas.

#include <algorithm>
#include <string>

namespace spindrift {

/// Between quotes, its own doubled, on one line.
inline std::string quoted(std::string text) {
  for (std::size_t at = 0; (at = text.find('"', at)) != std::string::npos; at += 2) text.insert(at, 1, '"');
  std::replace(text.begin(), text.end(), '\n', ' ');
  text.insert(0, 1, '"');
  text.push_back('"');
  return text;
}

}  // namespace spindrift
