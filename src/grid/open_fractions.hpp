#pragma once
/// Open part of a segment, square or cube from the signed distances at its corners.

#include <array>

namespace spindrift {

/// Part of a K-dimensional box, 0..1, where the distance is positive. distance: at the corners, bit k of the number is
/// the side along axis k. The box is cut into simplices around its middle (whose distance is the corners' mean), in
/// each of which the distance is linear: exact for a plane surface, and the same whichever way the box is turned.
template <int K>
double open_fraction(const std::array<double, std::size_t{1} << K>& distance);

}  // namespace spindrift
