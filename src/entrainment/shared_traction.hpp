#pragma once
/// The part of the bed's traction that brings the snow it loses up to the flow's speed.

#include <span>

#include "sph/columns.hpp"
#include "sph/particles.hpp"

namespace spindrift {

/// Mass that the flow takes from a bin of the bed, per area and time.
template <int Dim>
struct BedFlux {
  GroundBin<Dim> bin{};
  double flux = 0;  ///< E [kg m^-2 s^-1]
};

/// Gives each eroding column back what bed friction took from it twice. Over a bed that gives way at rate E the flow's
/// traction is tau = tau_bed + E v_t: what the bed does not resist accelerates the snow that joins. Entrained snow
/// starts at rest and its acceleration slows the flow already, so that friction may take tau - E v_t only. J being the
/// column's friction impulse of this step and v its mean velocity, it gets
///   min(E v_J A dt, |J|) J / |J|,     v_J = max(0, v . J / |J|)
/// dense    inout: velocities of the standing columns
/// columns  in: of these particles in this order, with J of this step
/// Returns the impulse given to the snow [kg m s^-1].
/// Source: the jump condition at an eroding bed (Fraccarollo and Capart 2002; Iverson 2012).  Departure: R16.
template <int Dim>
Vec<Dim> share_traction(Particles<Dim>& dense, const Columns<Dim>& columns, std::span<const BedFlux<Dim>> fluxes,
                        double dt);

}  // namespace spindrift
