#pragma once
/// The series that cases of air and smoke have in common.

#include <fmt/format.h>

#include "verification/case.hpp"

namespace spindrift {

/// A level of the cell size [m].
inline Level cells_of(double size, double gate = std::numeric_limits<double>::infinity(),
                      std::vector<std::string> more = {}) {
  more.push_back(fmt::format("suspension.cell_size={}", size));
  return {fmt::format("dx = {:.4g} m", size), std::move(more), size, gate};
}

/// `refined` with the other schemes of the air's advection, and its level `level` at other tolerances and CFL numbers.
inline std::vector<Series> air_series(const Series& refined, std::size_t level) {
  std::vector<Series> all{refined};
  for (const char* scheme : {"semi_lagrangian", "maccormack", "reflection"})
    if (refined.label != scheme)
      all.push_back(with_settings(refined, "scheme", scheme, {fmt::format("suspension.scheme={}", scheme)}));
  all.push_back(over_values(refined, level, "tolerance", "suspension.tolerance",
                            {"1e-2", "1e-3", "1e-4", "1e-5", "1e-6", "1e-8"}));
  all.push_back(over_values(refined, level, "time step", "suspension.cfl", {"4", "2", "1", "0.5", "0.25"}));
  return all;
}

}  // namespace spindrift
