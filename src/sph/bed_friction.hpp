#pragma once
/// Coulomb and Voellmy friction of the dense flow on its bed, terrain or cover: after the pressure solve, before
/// the particles move. Contact with walls, the core's share of the air's impulse and the shared traction come later.

#include <span>

#include "sph/columns.hpp"
#include "sph/particles.hpp"

namespace spindrift {

struct BedFriction {
  double mu = 0.155;  ///< Coulomb coefficient
  double xi = 4000;   ///< turbulent coefficient [m s^-2]; 0: no turbulent part
};

/// Speed after dt of Coulomb and turbulent friction: never negative, and with the driving force in `speed` already, the
/// fixed point is the terminal speed at any dt.
///   v* = max(0, v - coulomb),   v' = 2 v* / (1 + sqrt(1 + 4 b v*))  (so that v' + b v'^2 = v*)
/// speed      v [m s^-1], >= 0
/// coulomb    mu g_n dt, or mu J_n / m with the normal impulse J_n [m s^-1]
/// turbulent  b = g dt / (xi h_flow) [s m^-1]; 0: no turbulent part
/// Source: the paper has no bed friction.  Departure: R18.
double slowed_by_bed(double speed, double coulomb, double turbulent);

/// Friction on every particle that stands in a column, with the column's own thickness, on its velocity tangential to
/// the bed; what flies over an air gap feels none. g_n = max(0, -g . n): none on an overhang or a cliff's face.
/// dense    inout: velocities
/// columns  inout: of these particles in this order; each gets the impulse that it gives
/// gravity  g [m s^-2]
/// Returns the impulse given to the bed [kg m s^-1].  Pre: dt >= 0. Without a terrain there are no columns, so the
/// closed floor of a plain box has no friction: give it a terrain line instead.  Departure: R18.
template <int Dim>
Vec<Dim> apply_column_friction(Particles<Dim>& dense, Columns<Dim>& columns, const BedFriction& friction,
                               const Vec<Dim>& gravity, double dt);

/// Friction on the basal row alone: particles within one spacing d of the bed, or pushed by it. The Coulomb part takes
/// the normal impulse of the pressure solver, the turbulent part the thickness d of the row.
/// normal_impulse  in: given to each particle by the bed in this step [kg m s^-1], >= 0, size n_dense
/// Otherwise as apply_column_friction.  Departure: R18, `acts_on = "base"`.
template <int Dim>
Vec<Dim> apply_base_friction(Particles<Dim>& dense, Columns<Dim>& columns, const BedFriction& friction,
                             const Vec<Dim>& gravity, std::span<const double> normal_impulse, double dt);

}  // namespace spindrift
