#pragma once
/// Points as PLY, which Blender, Houdini, MeshLab and CloudCompare open.

#include <cstddef>
#include <vector>

#include "io/vtkhdf.hpp"

namespace spindrift {

/// Binary little-endian PLY 1.0 of vertices: properties x, y, z, then every component of every array ("velocity_x").
/// PLY knows no 64-bit integers: such an array is stored as `int` where its values fit, else as `double`. Attributes
/// become comments, a line each.
std::vector<std::byte> ply_bytes(const PointCloud& cloud);

}  // namespace spindrift
