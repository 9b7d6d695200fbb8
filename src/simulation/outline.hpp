#pragma once
/// Polygons of a scene, as corners one after the other. A line that is walked there and back bounds nothing, so that
/// one outline may have holes.

#include <array>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

using Outline = std::vector<std::array<double, 2>>;

/// Whether (x, z), or (x, y), lies inside, by the even-odd rule.
bool inside(const Outline& corners, double x, double z);

/// Whether a place lies inside one or more of them.
bool inside_any(const std::vector<Outline>& outlines, const Vec<2>& place);

/// The least box around all corners.   Pre: there is one.
Box<2> extent_of(const Outline& corners);

/// The least box around two.
Box<2> hull_of(const Box<2>& a, const Box<2>& b);

/// [m^2]
double area_of(const Outline& corners);

}  // namespace spindrift
