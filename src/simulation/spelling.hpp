#pragma once
/// "Did you mean": the nearest of the known names to one that is not known.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace spindrift {

/// The fewest insertions, deletions, replacements and swaps of neighbours that turn `a` into `b` (optimal string
/// alignment distance). Cost: O(|a| |b|).
std::size_t edit_distance(std::string_view a, std::string_view b);

/// The name nearest to `word`, the first of equals; nothing if none is near: at most a third of the word may differ,
/// and two letters of a short one.
std::optional<std::string_view> nearest(std::string_view word, const std::vector<std::string_view>& names);

/// `; did you mean "name"?`, or nothing.
std::string did_you_mean(std::optional<std::string_view> name);
inline std::string did_you_mean(std::string_view word, const std::vector<std::string_view>& names) {
  return did_you_mean(nearest(word, names));
}

}  // namespace spindrift
