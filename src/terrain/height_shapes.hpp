#pragma once
/// Mountains made from a few numbers: what 3D scenes describe in words, as heights of a HeightField.

#include <functional>

#include "terrain/height_field.hpp"
#include "terrain/profiles.hpp"

namespace spindrift {

/// z at (x, y) [m].
using HeightFunction = std::function<double(double x, double y)>;

/// z = z_s - tan(angle) (x - x_s) - tan(side_angle) (y - y_s), s the start.
HeightFunction tilted_plane(const Vec<3>& start, double angle, double side_angle);

/// Falls by `drop` along x as a parabola that begins with `angle` and ends level, 2 drop / tan(angle) farther on;
/// straight before.
HeightFunction parabola(const Vec<3>& start, double angle, double drop);

/// The same parabola turned about its lowest point: the ground falls towards it from all sides. Straight outside.
HeightFunction bowl(const Vec<3>& start, double angle, double drop);

struct Helix {
  Vec<3> start = Vec<3>::Zero();  ///< of the channel's middle, which sets out along x and turns towards y [m]
  double angle = 0.6;             ///< by which the channel falls [rad]
  double drop = 50;               ///< from start to the channel's end [m]
  double radius = 50;             ///< of the channel's middle about its axis [m]
  double depth = 5;               ///< of the channel [m]
  double width = 10;              ///< of the channel between its edges [m]
};

/// A channel along a helix about the vertical axis at (x_s, y_s + radius):
///   z = l(phi) + depth (1 - exp(-2 (2 (r - radius) / width)^2)),   l = z_s - radius phi tan(angle), at least z_s -
///   drop
/// where r and phi are the distance from the axis and the angle from the start on. In the part of the circle that the
/// channel leaves free, l rises again smoothly, and within half a radius of the axis it goes over into its mean.
/// Throws Error(bad_input): the channel would take up more than three quarters of the circle.
HeightFunction helix(const Helix& shape);

/// A slope's ground with a Gaussian ridge on it: height exp(-(s / width)^2 / 2), s the distance from the crest, which
/// lies across the slope `at` [m] behind its start, or along it through the start where `at` is NaN.
HeightFunction ridge(const SlopeProfile& slope, const Vec<3>& start, double end_x, double height, double width,
                     double at);

/// A slope with a band of cliffs across: it falls by slope.cliff_height more where it has fallen by slope.cliff_at, as
/// a smooth step as steep as `cliff_angle`.   Throws Error(bad_input): the slope is steeper.
HeightFunction cliff_band(const SlopeProfile& slope, double end_x, double cliff_angle);

/// A plane floor of `width` that falls along x, and walls on both sides of it that rise towards `wall_angle`:
///   tan(wall_angle) (sqrt(e^2 + c^2) - c),   c = radius tan(wall_angle),
/// e the distance from the floor and `radius` that of the bend at its edge.
HeightFunction valley(const Vec<3>& start, double angle, double width, double wall_angle, double radius);

/// Samples z over `extent` and `rim` [m] around it. The points lie at whole multiples of `cell` [m].
/// Throws Error(would_not_fit): more than 5e7 points.
HeightGrid sampled(const HeightFunction& z, const Box<2>& extent, double rim, double cell);

}  // namespace spindrift
