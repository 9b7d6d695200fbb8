#include "simulation/grid_domain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace spindrift {

void surround(DomainSection& domain, const ElevationGrid& model) {
  constexpr double below = 10, above = 100;  // [m]
  double low = std::numeric_limits<double>::infinity(), high = -low;
  int first[2] = {model.columns, model.rows}, last[2] = {0, 0};
  for (int row = 0; row < model.rows; ++row)
    for (int column = 0; column < model.columns; ++column) {
      const double z = model.at(column, row);
      if (std::isnan(z)) continue;
      low = std::min(low, z), high = std::max(high, z);
      first[0] = std::min(first[0], column), last[0] = std::max(last[0], column);
      first[1] = std::min(first[1], row), last[1] = std::max(last[1], row);
    }
  const double rim = model.cell / 2;
  domain.lower = {model.x + first[0] * model.cell + rim, model.y + first[1] * model.cell + rim,
                  std::floor(low - below)};
  domain.upper = {model.x + last[0] * model.cell - rim, model.y + last[1] * model.cell - rim, std::ceil(high + above)};
}

}  // namespace spindrift
