#pragma once
/// Solid boxes as particles and the grid meet them: signed distance and normal.

#include <algorithm>
#include <span>

#include "core/vec.hpp"

namespace spindrift {

template <int Dim>
struct BoxSurface {
  double distance = 0;  ///< signed distance to the box's surface [m], positive outside
  Vec<Dim> normal{};    ///< unit normal out of the box, at the nearest point of its surface
};

template <int Dim>
BoxSurface<Dim> surface_of(const Box<Dim>& box, const Vec<Dim>& x) {
  const Vec<Dim> from_middle = x - (box.lower + box.upper) / 2;
  const Vec<Dim> beyond = from_middle.cwiseAbs() - box.size() / 2;
  const auto sign = [](double a) { return a < 0 ? -1.0 : 1.0; };
  Eigen::Index nearest = 0;
  const double deepest = beyond.maxCoeff(&nearest);
  if (deepest <= 0) return {deepest, sign(from_middle[nearest]) * Vec<Dim>::Unit(nearest)};
  const Vec<Dim> away = beyond.cwiseMax(0).cwiseProduct(from_middle.unaryExpr(sign));
  const double distance = away.norm();
  return {distance, away / distance};
}

/// Whether one of the boxes lies within `reach` [m] of x.
template <int Dim>
bool any_within(std::span<const Box<Dim>> boxes, const Vec<Dim>& x, double reach) {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const Box<Dim>& box) { return surface_of<Dim>(box, x).distance < reach; });
}

}  // namespace spindrift
