#include "terrain/height_field.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

void check_grid(const HeightGrid& grid) {
  const auto require = [](bool good, const std::string& what) {
    if (!good) throw Error(ExitCode::bad_input, "terrain: " + what);
  };
  require(std::isfinite(grid.cell) && grid.cell > 0, "the cells of the ground must have a positive size");
  require(grid.first.allFinite(), "the first point of the ground must be finite");
  require(grid.points[0] >= 2 && grid.points[1] >= 2, "the ground needs two points or more along x and y");
  require(grid.z.size() == count<2>(grid.points), "the ground must have as many heights as points");
  for (std::size_t i = 0; i < grid.z.size(); ++i)
    if (!std::isfinite(grid.z[i])) {
      const Index<2> at = unflat<2>(i, grid.points);
      require(false,
              "the height of point (" + std::to_string(at[0]) + ", " + std::to_string(at[1]) + ") is not finite");
    }
}

}  // namespace

HeightField::HeightField(const HeightGrid& grid) : cell_(grid.cell), inverse_cell_(1 / grid.cell) {
  check_grid(grid);
  constexpr int rings = 2;
  corner_ = grid.first - Vec<2>::Constant(grid.cell);
  const Index<2> padded{grid.points[0] + 2 * rings, grid.points[1] + 2 * rings};
  stride_ = static_cast<std::size_t>(padded[0]);
  z_.resize(count<2>(padded));
  for_each_index<2>(padded, [&](const Index<2>& i) {
    Index<2> from;
    for (int k = 0; k < 2; ++k) from[k] = std::clamp(i[k] - rings, 0, grid.points[k] - 1);
    z_[flat<2>(i, padded)] = grid.z[flat<2>(from, grid.points)];
  });

  shapes_.push_back({padded[0] - 3, padded[1] - 3});
  bounds_.emplace_back(count<2>(shapes_[0]));
  parallel_for(
      bounds_[0].size(),
      [&](std::size_t n) { bounds_[0][n] = cubic_bounds(points_of(unflat<2>(n, shapes_[0])), stride_, cell_); }, 256);
  while (bounds_.back().size() > 1) {
    const Index<2> fine = shapes_.back(), coarse{(fine[0] + 1) / 2, (fine[1] + 1) / 2};
    std::vector<CellBounds> level(count<2>(coarse));
    for_each_index<2>(coarse, [&](const Index<2>& i) {
      CellBounds& all = level[flat<2>(i, coarse)];
      all = bounds_.back()[flat<2>({2 * i[0], 2 * i[1]}, fine)];
      for_each_index<2>({2, 2}, [&](const Index<2>& bit) {
        const Index<2> part{2 * i[0] + bit[0], 2 * i[1] + bit[1]};
        if (inside<2>(part, fine)) all.include(bounds_.back()[flat<2>(part, fine)]);
      });
    });
    shapes_.push_back(coarse);
    bounds_.push_back(std::move(level));
  }
  lipschitz_ = std::hypot(1.0, bounds_.back()[0].slope);
}

HeightField::Cell HeightField::locate(const Vec<2>& place) const {
  Cell at;
  for (int k = 0; k < 2; ++k) {
    const double s = (place[k] - corner_[k]) * inverse_cell_, end = shapes_[0][k];
    const double held = s > 0 ? (s < end ? s : end) : 0;  // 0 for NaN
    at.number[k] = std::min(static_cast<int>(held), shapes_[0][k] - 1);
    at.t[k] = held - at.number[k];
    at.level[static_cast<std::size_t>(k)] = held != s;
  }
  return at;
}

const double* HeightField::points_of(const Index<2>& cell) const {
  return z_.data() + static_cast<std::size_t>(cell[1]) * stride_ + static_cast<std::size_t>(cell[0]);
}

Jet HeightField::jet(const Vec<2>& place) const {
  const Cell at = locate(place);
  return cubic_jet(points_of(at.number), stride_, CubicWeights(at.t[0], inverse_cell_, at.level[0]),
                   CubicWeights(at.t[1], inverse_cell_, at.level[1]));
}

double HeightField::height(const Vec<2>& place) const {
  const Cell at = locate(place);
  return cubic_value(points_of(at.number), stride_, CubicWeights(at.t[0], inverse_cell_, at.level[0]).value,
                     CubicWeights(at.t[1], inverse_cell_, at.level[1]).value);
}

Vec<3> HeightField::normal(const Vec<2>& place) const {
  return normal_of(jet(place));
}

Vec<3> HeightField::position(const Vec<2>& place, double distance) const {
  const Jet at = jet(place);
  return Vec<3>(place[0], place[1], at.z) + distance * normal_of(at);
}

bool HeightField::clears(const Vec<3>& x, double reach) const {
  const double above = x[2] - height(x.head<2>());
  return above >= reach * lipschitz_;
}

std::size_t HeightField::bytes() const {
  std::size_t all = spindrift::bytes(z_) + spindrift::bytes(shapes_);
  for (const auto& level : bounds_) all += spindrift::bytes(level);
  return all;
}

}  // namespace spindrift
