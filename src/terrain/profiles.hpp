#pragma once
/// Ground profiles made from a few numbers: what scenes describe in words, as the vertices of a Terrain.

#include <vector>

#include "core/vec.hpp"

namespace spindrift {

/// A slope that begins at `start`, falls by `drop` at `angle`, and runs out at `runout_angle`, joined by an arc.
struct SlopeProfile {
  Vec<2> start = Vec<2>::Zero();  ///< upper left end (x, z) [m]
  double angle = 0.6;             ///< [rad], positive downhill to the right
  double drop = 50;               ///< height from start to where slope and run-out would meet without the arc [m]
  double runout_angle = 0;        ///< [rad]
  double transition_radius = 15;  ///< of the arc [m]; 0: a kink
  double bump_height = 0;         ///< crest to trough, normal to the slope [m]
  double bump_length = 15;        ///< wavelength along the slope [m]
  double cliff_at = 0;            ///< drop from start at which a vertical face begins [m]
  double cliff_height = 0;        ///< [m]
};

/// Vertices of the profile from start.x to `end_x` [m], curved parts in pieces of about `resolution` [m].
/// Bumps fade in and out over half a wavelength at both ends of the slope, so that the ground stays smooth.
/// Throws Error(bad_input) where the numbers describe no profile (the arc does not fit, end_x left of the foot's arc).
std::vector<Vec<2>> slope_profile(const SlopeProfile& slope, double end_x, double resolution);

}  // namespace spindrift
