#pragma once
/// When resting snow fails: its strain rate against a threshold (paper Sec. 4.4.2).

namespace spindrift {

/// Viscosity of the cover [Pa s], Eq. (15), Kojima's law:  eta = 8.5e6 exp(0.021 rho_a).
/// density  rho_a [kg m^-3].   Departure: R12 (unit).
double cover_viscosity(double density);

/// Strain rate of a cover particle [s^-1], Eq. (14):  gamma = W g sin(theta) / eta + gamma_f.
/// overburden         W, mass of dense flow and cover above the particle per area of ground [kg m^-2]
/// g_tangential       g sin(theta), gravity along the ground [m s^-2]
/// viscosity          eta [Pa s]
/// friction_traction  tau_f, that of the moving snow on the particle [Pa]; gamma_f = factor tau_f / eta
/// Departure: R12 (W g is a stress), R14 (gamma_f).
double strain_rate(double overburden, double g_tangential, double viscosity, double friction_traction = 0,
                   double friction_factor = 1);

/// Strain rates at which the cover fails [s^-1].
struct FailureThreshold {
  double surface = 1e-6, base = 1e-4;
};

/// gamma_0 [s^-1]:  surface (base / surface)^(depth / thickness), log-linear over the cover's initial depth.
/// depth      below the initial surface [m], held to [0, thickness]
/// thickness  of the cover at the start [m]
/// Departure: R13.
double failure_strain_rate(const FailureThreshold& threshold, double depth, double thickness);

}  // namespace spindrift
