#pragma once
/// Frames as VTKHDF files in memory: made by HDF5 without a disk, identical bytes for identical input. commit() them.
/// Two dimensions: everything lies in the x-z plane, and arrays of two components (x, z) are stored as (x, 0, z).
/// The group /spindrift holds the attributes, the format's version and a digest of the arrays as stored.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/named_array.hpp"

namespace spindrift {

/// Points and values on them; all arrays have as many points as `positions` [m], whose name does not matter.
struct PointCloud {
  NamedArray positions;
  std::vector<NamedArray> arrays;
  Attributes attributes;

  std::size_t n_points() const {
    return positions.n_values() / static_cast<std::size_t>(std::max(positions.components, 1));
  }
};

/// A box of points, x fastest, then y, then z.
struct Lattice {
  std::array<std::int64_t, 3> shape{1, 1, 1};  ///< points along x, y, z; y = 1: two dimensions
  std::array<double, 3> origin{0, 0, 0};       ///< of the first point [m]
  std::array<double, 3> spacing{1, 1, 1};      ///< [m]

  std::size_t n_points() const { return static_cast<std::size_t>(shape[0] * shape[1] * shape[2]); }
  bool operator==(const Lattice&) const = default;
};

/// Values on a lattice, cell-centred quantities on the lattice of the cell centres. Two dimensions are stored as two
/// identical layers, y = 0 and y = 1 m (quantities are per metre of width): no VTK before 9.2 reads a flat image.
struct LatticeImage {
  Lattice lattice;
  std::vector<NamedArray> arrays;
  Attributes attributes;
};

/// VTKHDF 1.0 UnstructuredGrid of vertices, and ImageData.
/// Throws    Error(bug): an array of another size than the points, a name twice;  Error(io_failed): HDF5 refused.
std::vector<std::byte> vtkhdf_bytes(const PointCloud& cloud);
std::vector<std::byte> vtkhdf_bytes(const LatticeImage& image);

/// What stands in a file of ours. The arrays are sorted by name; a point cloud's positions are named "Points".
struct StoredFrame {
  std::optional<Lattice> lattice;  ///< as stored; empty: a point cloud
  std::vector<StoredArray> arrays;
  Attributes attributes;  ///< with "digest"
};

/// Reads what vtkhdf_bytes wrote. name: of the file, for messages.
/// Throws    Error(incompatible_file): not such a file, of a newer format, or its digest does not hold.
StoredFrame read_vtkhdf(std::span<const std::byte> bytes, const std::string& name);

}  // namespace spindrift
