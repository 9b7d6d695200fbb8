#pragma once
/// One avalanche part by part, and air and smoke alone, as scenes. DenseAlone and AirAlone hold the same numbers.

#include <string>
#include <string_view>

namespace spindrift::absence {

struct Part {
  std::string_view name, text;
};

inline constexpr Part parts[] = {
    {"dense flow", R"(
schema_version = 1
[domain]
lower = [0, 0]
upper = [40, 24]
[terrain]
shape = "polyline"
points = [[0, 20], [24, 2], [100, 1]]
[release]
at = 1
length = 5
thickness = 1.5
velocity = [4, -3]
[dense_flow]
)"},
    {"cover", "[cover]\ndepth = 0.5\n"},
    {"suspension", "[suspension]\ncell_size = 0.5\n"},
    {"drag", "[coupling.drag]\n"},
    {"lift", "[coupling.lift]\n"},
    {"generation", "[coupling.generation]\nthreshold_speed = 0\n"},
    {"adhesion", "[coupling.adhesion]\n"},
    {"confinement", "[suspension.confinement]\n"},
    {"entrainment", "[entrainment]\n"},
};

/// The avalanche with the first `n_parts` parts.
inline std::string avalanche(std::size_t n_parts) {
  std::string text;
  for (std::size_t i = 0; i < n_parts; ++i) text += parts[i].text;
  return text;
}

inline constexpr std::string_view air_alone = R"(
schema_version = 1
[domain]
lower = [0, 0]
upper = [40, 24]
[suspension]
cell_size = 0.5
[[smoke]]
density = 3
lower = [10, 2]
upper = [20, 8]
)";

}  // namespace spindrift::absence
