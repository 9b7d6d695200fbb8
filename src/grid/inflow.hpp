#pragma once
/// What comes in through an open side: ambient air.

#include <array>

#include "grid/mac_grid.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// After advection, which reads values constant beyond the domain: on the side's faces, and on the faces across of the
/// cells beside them, mixes in the share of ambient air that a step carries in,
///   u <- u + c (wind - u),   c = min(1, dt c_in / dx),   c_in >= 0 the carrier's velocity into the domain.
/// Air that came in with the side's own velocity would bring ever more of it: an open side has pressure 0, and without
/// this loss of the dynamic pressure an inflow feeds itself.
/// u          inout: face velocities [m/s]
/// carrier    in: of the step [m/s]
/// flow_area  in: only faces with a positive one are changed
/// wind       of the ambient air [m/s]
/// dt         [s], >= 0
template <int Dim>
void let_in_ambient_air(FaceField<Dim>& u, const FaceField<Dim>& carrier, const FaceField<Dim>& flow_area,
                        const MacGrid<Dim>& grid, const std::array<std::array<Side, 2>, Dim>& sides,
                        const Vec<Dim>& wind, double dt);

}  // namespace spindrift
