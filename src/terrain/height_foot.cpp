/// The nearest point of a height field.

#include <algorithm>
#include <cmath>
#include <utility>

#include "terrain/height_field.hpp"

namespace spindrift {
namespace {

constexpr double last_step = 1e-6;  // of a cell: after a step of Newton's as small the error is its square
constexpr int most_steps = 60;

}  // namespace

HeightField::Candidate HeightField::candidate(const Vec<3>& x, const Vec<2>& place) const {
  Candidate c{place, jet(place), 0};
  c.squared = (place - x.head<2>()).squaredNorm() + (c.jet.z - x[2]) * (c.jet.z - x[2]);
  return c;
}

/// From `at` down to a place where the squared distance is stationary.
HeightField::Candidate HeightField::descend(const Vec<3>& x, Candidate at) const {
  for (int n = 0; n < most_steps; ++n) {
    const Jet& j = at.jet;
    const double up = j.z - x[2];
    const Vec<2> gradient = at.place - x.head<2>() + up * j.slope;
    double xx = 1 + j.slope[0] * j.slope[0] + up * j.xx, yy = 1 + j.slope[1] * j.slope[1] + up * j.yy;
    double xy = j.slope[0] * j.slope[1] + up * j.xy;
    if (!(xx > 0.1) || !(xx * yy - xy * xy > 0.1)) {  // bent away from x: as if it were a plane
      xx -= up * j.xx, yy -= up * j.yy, xy -= up * j.xy;
    }
    const double det = xx * yy - xy * xy;
    Vec<2> step((xy * gradient[1] - yy * gradient[0]) / det, (xy * gradient[0] - xx * gradient[1]) / det);
    const double length = step.norm();
    if (!(length > last_step * cell_)) {
      const Vec<2> end = at.place + step;
      if (locate(end).number != locate(at.place).number) return candidate(x, end);
      at.place = end;
      at.jet.z += j.slope.dot(step) + (j.xx * step[0] + j.xy * step[1]) * step[0] / 2 +
                  (j.xy * step[0] + j.yy * step[1]) * step[1] / 2;
      at.jet.slope += Vec<2>(j.xx * step[0] + j.xy * step[1], j.xy * step[0] + j.yy * step[1]);
      return at;
    }
    for (double share = 1;; share /= 2) {
      const Candidate next = candidate(x, at.place + share * step);
      if (next.squared <= at.squared * (1 + 1e-14)) {
        at = next;
        break;
      }
      if (share * length < last_step * cell_) return at;
    }
  }
  return at;
}

/// Calls f(level, block) for the few blocks that cover the square of `half_edge` around x.
template <class F>
void HeightField::for_blocks_around(const Vec<3>& x, double half_edge, F&& f) const {
  std::size_t level = 0;
  double size = cell_;
  while (level + 1 < shapes_.size() && size < half_edge) ++level, size *= 2;
  const auto block_at = [&](double place, int k) {
    const double b = (place - corner_[k]) / size, last = shapes_[level][k] - 1;
    return static_cast<int>(b > 0 ? std::min(b, last) : 0);  // 0 for NaN
  };
  const Index<2> first{block_at(x[0] - half_edge, 0), block_at(x[1] - half_edge, 1)};
  const Index<2> last{block_at(x[0] + half_edge, 0), block_at(x[1] + half_edge, 1)};
  for (int j = first[1]; j <= last[1]; ++j)
    for (int i = first[0]; i <= last[0]; ++i) f(level, Index<2>{i, j});
}

/// Whether no place is nearer to x than a stationary one at distance r. Half the second derivative of the squared
/// distance along a unit vector e is 1 + (e . slope)^2 + (z - x_z) e . bend . e. From the stationary place to a nearer
/// one the way in plan lies in the square of half edge r around x, both ends within r of x_z, and the surface bends off
/// its chord, of length 2 r at most, by curvature r^2 / 2 at most. If the derivative is positive all along, the other
/// end cannot be nearer.
bool HeightField::sole(const Vec<3>& x, double above, double r) const {
  CellBounds b{.low = INFINITY, .high = -INFINITY};
  for_blocks_around(x, r, [&](std::size_t level, const Index<2>& block) { b.include(bounds(level, block)); });
  const double chord = r + b.curvature() * r * r / 2, rise = static_cast<double>(b.slope) * std::sqrt(2.0) * r;
  const double below_x = std::min({above + rise, x[2] - static_cast<double>(b.low), chord});
  const double over_x = std::min({rise - above, static_cast<double>(b.high) - x[2], chord});
  return static_cast<double>(b.hollow) * below_x < 1 && static_cast<double>(b.crest) * over_x < 1;
}

Box<2> HeightField::block_extent(std::size_t level, const Index<2>& block) const {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double size = cell_ * static_cast<double>(std::size_t{1} << level);
  Box<2> box;
  for (int k = 0; k < 2; ++k) {
    box.lower[k] = block[k] == 0 ? -infinity : corner_[k] + block[k] * size;
    box.upper[k] = block[k] + 1 == shapes_[level][k] ? infinity : corner_[k] + (block[k] + 1) * size;
  }
  return box;
}

/// A bound of the squared distance from x to the surface over a block.
double HeightField::block_distance(const Vec<3>& x, std::size_t level, const Index<2>& block) const {
  const Box<2> box = block_extent(level, block);
  const CellBounds& b = bounds(level, block);
  const Vec<2> in_plan = x.head<2>();
  const double aside = (in_plan - in_plan.cwiseMax(box.lower).cwiseMin(box.upper)).squaredNorm();
  const double over = std::max({0.0, x[2] - b.high, b.low - x[2]});
  return aside + over * over;
}

void HeightField::search(const Vec<3>& x, std::size_t level, const Index<2>& block, Candidate& best) const {
  if (!(block_distance(x, level, block) < best.squared)) return;
  if (level == 0) return search_cell(x, block, best);
  struct Part {
    double distance;
    Index<2> number;
  };
  std::array<Part, 4> parts;
  std::size_t n = 0;
  for_each_index<2>({2, 2}, [&](const Index<2>& bit) {
    const Index<2> part{2 * block[0] + bit[0], 2 * block[1] + bit[1]};
    if (inside<2>(part, shapes_[level - 1])) parts[n++] = {block_distance(x, level - 1, part), part};
  });
  for (std::size_t k = 1; k < n; ++k)
    for (std::size_t i = k; i > 0 && parts[i].distance < parts[i - 1].distance; --i) std::swap(parts[i], parts[i - 1]);
  for (std::size_t k = 0; k < n; ++k) search(x, level - 1, parts[k].number, best);
}

/// A bound of the squared distance from x to the surface over a cell of the grid: from its value and slope in the
/// cell's middle, and the least that half its second derivative can be (see sole()).
double HeightField::cell_distance(const Vec<3>& x, const Index<2>& cell) const {
  const CellBounds& b = bounds(0, cell);
  const Candidate middle = candidate(x, corner_ + cell_ * Vec<2>(cell[0] + 0.5, cell[1] + 0.5));
  const Vec<2> gradient = middle.place - x.head<2>() + (middle.jet.z - x[2]) * middle.jet.slope;
  const double bend = 1 - std::max({0.0, static_cast<double>(b.hollow) * (x[2] - static_cast<double>(b.low)),
                                    static_cast<double>(b.crest) * (static_cast<double>(b.high) - x[2])});
  const double half = cell_ / 2;
  double least = middle.squared;
  for (int k = 0; k < 2; ++k) {
    const double g = std::abs(gradient[k]);
    least -= bend * half > g ? g * g / bend : (2 * g - bend * half) * half;
  }
  return least;
}

void HeightField::search_cell(const Vec<3>& x, const Index<2>& cell, Candidate& best) const {
  const Box<2> box = block_extent(0, cell);
  if (box.size().allFinite() && cell_distance(x, cell) >= best.squared) return;
  const Vec<2> in_plan = x.head<2>(), lower = corner_ + cell_ * Vec<2>(cell[0], cell[1]);
  Vec<2> start = in_plan.cwiseMax(box.lower).cwiseMin(box.upper);
  double least = std::numeric_limits<double>::infinity();
  const auto look = [&](const Vec<2>& place) {
    const double up = height(place) - x[2], squared = (place - in_plan).squaredNorm() + up * up;
    if (squared < least) least = squared, start = place;
  };
  look(start);
  for_each_index<2>({3, 3}, [&](const Index<2>& i) { look(lower + 0.5 * cell_ * Vec<2>(i[0], i[1])); });
  const Candidate found = descend(x, candidate(x, start));
  if (found.squared < best.squared) best = found;
}

Foot<3> HeightField::foot(const Vec<3>& x, double reach, double certain) const {
  const Candidate below = candidate(x, x.head<2>());
  const double above = x[2] - below.jet.z;
  Foot<3> foot;
  foot.distance = std::copysign(reach, above);
  if (std::abs(above) >= reach * lipschitz_) return foot;

  Candidate best = descend(x, below);
  const double r = std::sqrt(best.squared), nearest = std::min({r, reach, certain});
  if (r > nearest || !sole(x, above, r)) {
    Candidate nearer = best;
    nearer.squared = nearest * nearest;
    for_blocks_around(x, nearest, [&](std::size_t level, const Index<2>& block) { search(x, level, block, nearer); });
    if (nearer.squared < nearest * nearest) best = nearer;
  }
  if (best.squared >= reach * reach) return foot;

  foot.normal = normal_of(best.jet);
  foot.distance = foot.normal.dot(x - Vec<3>(best.place[0], best.place[1], best.jet.z));
  foot.place = best.place;
  return foot;
}

}  // namespace spindrift
