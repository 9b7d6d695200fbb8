#pragma once
/// The mechanical energy of a simulation.

#include "simulation/simulation.hpp"

namespace spindrift {

/// Kinetic energy of snow and air, and potential energy of snow, cover and smoke over the domain's lowest corner [J].
template <int Dim>
double mechanical_energy(const Simulation<Dim>& simulation);

}  // namespace spindrift
