#pragma once
/// Drag and lift between the overlap particles and the air (paper Sec. 4.4.1), two-way, stable at any time step and
/// mass ratio, momentum-exact: docs/physics.md, departures R2, R3, R4.

#include "coupling/exchange.hpp"
#include "coupling/overlap_region.hpp"

namespace spindrift {

/// Which mass the force laws scale with (R2): the particle's own (Eqs. 10 and 11 literally) or the displaced air's.
enum class ForceLaw : std::uint8_t { paper, air };

struct ForceOptions {
  double constant = 0;  ///< k_drag or k_lift
  ForceLaw law = ForceLaw::air;
};

/// The drag law's stiffness a [s m^-1], so that dw/dt = -(a / dt) |w| w for a particle in a given wind:
///   paper: a = k dt / r            air: a = k dt rho_air V / (m r)
double drag_stiffness(const ForceOptions& drag, double dt, double radius, double air_density, double volume,
                      double mass);

/// The implicit rate beta of the drag exchange for slip speed w.
///   without gravity   beta = a w, exact for one pair at any dt and mass ratio (test cases C1, C2)
///   on velocities that hold g dt already   beta = (sqrt(1 + 4 a (1 + phi) w) - 1) / (2 (1 + phi)), which settles at
///   the right terminal speed at any dt (C3)
double drag_rate(double stiffness, double loading, double slip, bool gravity_predicted);

/// One step of the damped rotation dw/dt = -w x omega k: backward Euler, |w'| = |w| / sqrt(1 + theta^2) for w normal to
/// theta (C4).   theta: rotation angle vector k omega dt
template <int Dim>
Vec<Dim> damped_rotation(const Vec<Dim>& w, const Curl<Dim>& theta);

/// Drag, Eq. (10):  f_i = -k_drag (m_i / r_i) |v_i - u_i| (v_i - u_i), u_i = sum_f w_if u_f, two-way and implicit:
///   v_p' = v_p - J_p / m_p,   u_f' = u_f + sum_p w_pf J_p / m_f,   J_p = m_p gamma_p (v_p - u_p'),
/// w_pf the weights of region.on_faces, gamma = beta / (1 + beta); u' by solve_face_velocity().
/// Changes the velocities in `region`, fills its stiffness and loading, and books both sides in `exchange`.
template <int Dim>
void exchange_drag(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                   const ForceOptions& drag, double radius, double air_density, double dt, bool gravity_predicted);

/// Lift, Eq. (11):  f_i = -k_lift m_i (v_i - u_i) x omega_i, after drag. The slip of particle and air is turned by
/// theta (1 + phi) about their common velocity, limited to one radian, and the impulse booked on both sides.
template <int Dim>
void exchange_lift(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                   const Suspension<Dim>& suspension, const ForceOptions& lift, double dt);

}  // namespace spindrift
