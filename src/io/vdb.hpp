#pragma once
/// Smoke as OpenVDB volumes, for Houdini, Blender and renderers.

#include <cstddef>
#include <vector>

#include "io/vtkhdf.hpp"

namespace spindrift {

/// Whether this build writes them.
bool writes_vdb();

/// A frame of smoke as the bytes of a .vdb file: the grids "density" (fog volume) [kg m^-3] and "velocity" [m s^-1], in
/// single precision, with voxels where the density is above `least`. A voxel's middle is the cell's. Of two dimensions
/// one layer of voxels, at y = 0.
/// name     of the frame's file, for messages
/// Throws Error(incompatible_file): the frame lacks a lattice or one of the arrays;  Error(bad_input): a build without
/// OpenVDB, or its module does not load.
std::vector<std::byte> vdb_bytes(const StoredFrame& frame, double least, const std::string& name);

}  // namespace spindrift
