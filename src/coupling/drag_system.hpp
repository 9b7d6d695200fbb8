#pragma once
/// The air's velocity at the end of an implicit drag step, one linear system for each axis.

#include "coupling/overlap_region.hpp"

namespace spindrift {

/// Solves  (m_f u_f' - m_f u_f) = sum_p w_pf c_p (v_p - sum_g w_pg u_g')  for the faces of one axis, by conjugate
/// gradients preconditioned with the lumped matrix m_f + sum_p w_pf c_p. The force of a particle is one, and is spread
/// with the weights it was gathered with (R4): lumped alone, the drag would also tie the faces around a particle to one
/// another, however small their weights, and converge with order one half in the time step where it is stiff.
/// region     on_faces, face_mass, velocity and coupled_mass c_p of its particles; in and out: face_velocity
/// Ends at a residual of 1e-10 in the preconditioner's norm, or after 200 iterations with less drag than there should
/// be: no iterate makes energy.
template <int Dim>
void solve_face_velocity(OverlapRegion<Dim>& region, int axis);

}  // namespace spindrift
