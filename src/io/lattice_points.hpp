#pragma once
/// Chosen points of a lattice as a cloud of points, for formats that know no grids.

#include <span>
#include <vector>

#include "io/vtkhdf.hpp"

namespace spindrift {

/// Coordinates beyond are kept in double precision: single precision has no digits left [m].
inline constexpr double far_from_zero = 20e3;

/// A cloud that owns its values.
struct StoredCloud {
  StoredArray positions;  ///< [m], three components
  std::vector<StoredArray> arrays;
};

/// points: numbers of points of the lattice, x fastest.   Pre: image.lattice; each number is one of its points.
StoredCloud lattice_points(const StoredFrame& image, std::span<const std::size_t> points);

}  // namespace spindrift
