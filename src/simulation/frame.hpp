#pragma once
/// The state of a simulation as arrays that own their values: what a frame file holds, ordered by id and free of how
/// the simulation stores it.

#include <string>
#include <vector>

#include "io/vtkhdf.hpp"
#include "simulation/simulation.hpp"

namespace spindrift {

struct ParticleFrame {
  StoredArray positions;
  std::vector<StoredArray> arrays;
  Attributes attributes;
  std::vector<std::byte> file() const;
};

struct SmokeFrame {
  Lattice lattice;
  std::vector<StoredArray> arrays;
  Attributes attributes;
  std::vector<std::byte> file() const;
};

/// Dense flow and cover by id: Points, velocity [m/s], density [kg/m^3] (mass over volume), pressure [Pa], mass [kg],
/// layer (0 dense flow, 1 cover), overlap (0, 1), entrained_at [s] (-1: released), id. The attributes "unit.NAME" tell
/// the units; in 2D a mass is per metre of width [kg/m].
template <int Dim>
ParticleFrame particle_frame(const Simulation<Dim>& simulation);

/// On cell centres: smoke density [kg/m^3], air velocity [m/s], solid (1: no open volume).   Pre: there is a
/// suspension.
template <int Dim>
SmokeFrame smoke_frame(const Simulation<Dim>& simulation);

/// Fingerprint of the whole state, by id and grid order: equal for runs that ended in the same bits.
template <int Dim>
std::string state_digest(const Simulation<Dim>& simulation);

}  // namespace spindrift
