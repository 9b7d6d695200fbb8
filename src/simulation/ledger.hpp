#pragma once
/// What moved between the layers, and out of them: every kilogram and newton-second is an entry (CONTRIBUTING.md).

#include <string_view>

#include "core/vec.hpp"
#include "grid/suspension.hpp"
#include "sph/dense_flow.hpp"

namespace spindrift {

/// Masses since the start [kg], in 2D per metre of width.
struct MassLedger {
  double initial = 0;                                          ///< released snow, cover and smoke at the start
  double laid = 0;                                             ///< sleeping cover that became particles
  double injected = 0;                                         ///< smoke from sources
  double generated = 0;                                        ///< particles to smoke
  double adhered = 0;                                          ///< smoke to particles
  double entrained = 0;                                        ///< cover to dense flow
  double particle_outflow = 0;                                 ///< dense flow out of the domain
  double smoke_outflow = 0;                                    ///< smoke out of the domain
  double deposited = 0;                                        ///< smoke that settled on the ground
  std::size_t n_entrained = 0, n_outflow = 0, n_vanished = 0;  ///< particles; vanished: wholly turned into smoke (R17)

  double outflow() const { return particle_outflow + smoke_outflow; }
};

/// One step's entries. Momenta [kg m s^-1], each the change that its cause made.
template <int Dim>
struct StepReport {
  double dt = 0;             ///< [s]
  std::string_view limiter;  ///< what ruled dt
  int n_rejected = 0;        ///< trials of this step, with longer dt, that failed
  std::size_t n_overlap = 0, n_core_cells = 0;

  VelocitySolve<Dim> dense;                  ///< iterations, errors and the boundary's impulse on the dense flow
  Vec<Dim> wall_contact = Vec<Dim>::Zero();  ///< walls on particles that ended in them
  Vec<Dim> bed_friction = Vec<Dim>::Zero();  ///< bed on the dense flow
  Vec<Dim> gravity_on_dense = Vec<Dim>::Zero();
  Vec<Dim> gravity_on_smoke = Vec<Dim>::Zero();
  Vec<Dim> exchange_on_particles = Vec<Dim>::Zero();
  Vec<Dim> exchange_on_grid = Vec<Dim>::Zero();
  Vec<Dim> exchange_on_fixed_faces = Vec<Dim>::Zero();  ///< on ground, core and what holds frozen air, see Exchange
  Vec<Dim> core_reaction = Vec<Dim>::Zero();            ///< air on the dense core
  Vec<Dim> outflow = Vec<Dim>::Zero();                  ///< with particles that left
  Vec<Dim> smoke_source = Vec<Dim>::Zero();             ///< with smoke from sources, which moves with the air
  Vec<Dim> ground_on_air = Vec<Dim>::Zero();            ///< air that the sinking cover uncovers
  Vec<Dim> forgotten = Vec<Dim>::Zero();                ///< of slow air that is not computed any more
  SuspensionBudget<Dim> suspension;
};

}  // namespace spindrift
