#pragma once
/// VTK's XML files, for the readers that do not know VTKHDF: ParaView and VisIt of any age, meshio, PyVista.

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace spindrift {

/// PolyData (.vtp): the points, a vertex each, with all arrays.
/// ImageData (.vti): the lattice with all arrays on its points; a flat lattice stays flat.
/// Values are appended raw, uncompressed, with 64-bit headers (VTK 6 or newer). time: stored as TimeValue [s].
std::vector<std::byte> vtp_bytes(const PointCloud& cloud, double time);
std::vector<std::byte> vti_bytes(const LatticeImage& image, double time);

/// A collection (.pvd): files and their times, opened as one series.
std::string pvd_text(std::span<const SeriesEntry> entries);

}  // namespace spindrift
