#pragma once
/// The velocity that the air begins with.

#include "grid/mac_grid.hpp"
#include "simulation/scene.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// suspension.initial_flow at face centres [m/s], 0 on closed sides, through which it would blow. With U the
/// initial_speed, (x, z) from the lower corner of the grid's box of L_x by L_z, in 3D the same for every y:
///   wind       suspension.wind
///   vortices   u = U sin(pi x / L_x) cos(pi z / L_z), w = -U (L_z / L_x) cos(pi x / L_x) sin(pi z / L_z)
///   rotation   u = -W (z - L_z / 2), w = W (x - L_x / 2), W = 2 U / L_x
///   potential  the gradient of 48 sqrt(3) U L X(x / L_x) X(z / L_z), X(s) = s^2 (1 - s)^2, L = min(L_x, L_z), whose
///              largest component is U
/// Source: Taylor and Green (1937) for the vortex. The potential has no flow through the sides and is no eigenfunction
/// of the Laplacian, continuous or discrete: of its flow a projection leaves the discretisation error alone.
template <int Dim>
FaceField<Dim> initial_flow(const SuspensionSection& suspension, const MacGrid<Dim>& grid, const Walls<Dim>& walls);

}  // namespace spindrift
