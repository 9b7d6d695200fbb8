#pragma once
/// Generation and adhesion of snow smoke (paper Sec. 4.4.1, Eqs. 12 and 13), exact over the step for the speed that
/// drag leaves, and together: they relax to their common equilibrium at any time step (R5, R6, R17)
/// as docs/physics.md says.

#include <optional>

#include "coupling/exchange.hpp"
#include "coupling/overlap_region.hpp"

namespace spindrift {

struct GenerationOptions {
  double constant = 0.02;      ///< C_g [kg m^-2 s^-1 (m/s)^-1.7]
  double threshold_speed = 0;  ///< no smoke below this slip speed [m s^-1]
};

struct AdhesionOptions {
  double constant = 0.2;  ///< C_a
};

struct SmokeOptions {
  std::optional<GenerationOptions> generation;
  std::optional<AdhesionOptions> adhesion;
  double radius = 0;                  ///< of a particle [m]
  double min_mass = 0, max_mass = 0;  ///< of a particle [kg]: it gives no more below, sweeps up no more above (R17);
                                      ///< smoke that the core shuts in sticks above it too, see CoreBoundary
};

/// Surface and section of a particle of radius r (R6):
///   2D, per metre of width: 2 pi r and 2 r          3D: 4 pi r^2 and pi r^2
template <int Dim>
double surface(double radius);
template <int Dim>
double section(double radius);

/// Smoke made by one particle in a step, Eq. (12), while drag slows it from w to w / (1 + b), b = (1 + phi) a w:
///   dm = C_g S_sur w^1.7 dt * integral of (1 + b s)^-1.7 over the part s of the step above the threshold [kg]
double generated_smoke(const GenerationOptions& generation, double slip, double b, double surface, double dt);

/// Mean over the step of the slip speed that drag slows from w to w / (1 + b):  w log(1 + b) / b  [m s^-1]
double mean_slip(double slip, double b);

/// Moves smoke between the particles of `region` and the cells around them, after drag and lift. What moves carries its
/// own velocity (R16). In each cell, with G the smoke made there and L = C_a sum S_sec |w| dt / V,
///   M' = M e^-L + G (1 - e^-L) / L,
/// what is missing sticks to the particles in proportion to S_sec |w|.
template <int Dim>
void exchange_smoke(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                    const Suspension<Dim>& suspension, const SmokeOptions& options, double dt);

/// Turns particles that are down to min_mass wholly into smoke (R17). Fills a whole exchange, faces and all; a particle
/// whose source is minus its mass is gone, and the caller removes it. Where no cell is open around it, it stays.
/// Returns how many.
template <int Dim>
std::size_t dissolve_spent(OverlapRegion<Dim>& region, Exchange<Dim>& exchange, const Particles<Dim>& particles,
                           const Suspension<Dim>& suspension, double min_mass);

/// Frozen air, after drag and lift: what they gave the region's faces goes to what holds the air.
template <int Dim>
void hold_faces(OverlapRegion<Dim>& region, Exchange<Dim>& exchange);

/// Lists the momentum that the region's faces were given in `exchange.on_grid`. Last call of the exchange.
template <int Dim>
void book_faces(const OverlapRegion<Dim>& region, Exchange<Dim>& exchange);

}  // namespace spindrift
