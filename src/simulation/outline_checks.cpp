#include "simulation/outline_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "simulation/units.hpp"

namespace spindrift {

std::string off_the_model(const ElevationGrid& model, const Outline& outline) {
  const Box<2> extent = extent_of(outline);
  const Vec<2> first(model.x, model.y), half = Vec<2>::Constant(model.cell / 2);
  const Vec<2> lower = first - half, upper = lower + model.cell * Vec<2>(model.columns, model.rows);
  for (int k = 0; k < 2; ++k)
    if (!(extent.lower[k] >= lower[k]) || !(extent.upper[k] <= upper[k]))
      return fmt::format("reaches {} along {}, expected it over the elevation model, which has heights from {} to {}",
                         number_text(extent.lower[k] >= lower[k] ? extent.upper[k] : extent.lower[k]),
                         k == 0 ? "x" : "y", number_text(lower[k]), number_text(upper[k]));

  const auto point_of = [&](double place, int k) {
    return std::clamp(static_cast<int>(std::lround((place - first[k]) / model.cell)), 0,
                      (k == 0 ? model.columns : model.rows) - 1);
  };
  const auto hole = [&](int column, int row) {
    return fmt::format("lies over a hole of the elevation model at ({}, {})",
                       number_text(model.x + column * model.cell), number_text(model.y + row * model.cell));
  };
  for (const auto& [x, y] : outline)
    if (const int column = point_of(x, 0), row = point_of(y, 1); std::isnan(model.at(column, row)))
      return hole(column, row);
  for (int row = point_of(extent.lower[1], 1); row <= point_of(extent.upper[1], 1); ++row)
    for (int column = point_of(extent.lower[0], 0); column <= point_of(extent.upper[0], 0); ++column)
      if (std::isnan(model.at(column, row)) &&
          inside(outline, model.x + column * model.cell, model.y + row * model.cell))
        return hole(column, row);
  return "";
}

}  // namespace spindrift
