#pragma once
/// Particles as a structure of arrays. The dense flow and the cover are two of them.

#include <cstdint>
#include <span>
#include <vector>

#include "core/memory.hpp"
#include "core/vec.hpp"

namespace spindrift {

/// array[i] becomes what stood at order[i].
template <class Array>
void reorder(Array& array, std::span<const std::uint32_t> order) {
  Array sorted = array;
  for (std::size_t i = 0; i < order.size(); ++i) sorted[i] = array[order[i]];
  array.swap(sorted);
}

/// State of a set of particles; every array has one entry a particle. Everything that steers the next step is here.
template <int Dim>
struct Particles {
  std::vector<Vec<Dim>> position;    ///< x [m]
  std::vector<Vec<Dim>> velocity;    ///< v [m s^-1]
  std::vector<double> mass;          ///< m [kg], in 2D per metre of width
  std::vector<double> volume;        ///< V [m^Dim], the rest volume; relaxes to m / rho_dense by compaction (R20)
  std::vector<double> pressure;      ///< of the last solve [Pa], kept as the next step's first guess
  std::vector<double> entrained_at;  ///< time of entrainment [s]; -1 for released snow
  std::vector<std::uint64_t> id;     ///< unique over dense flow and cover, for life

  std::size_t size() const { return id.size(); }
  bool empty() const { return id.empty(); }

  void reserve(std::size_t n) {
    for_each_array([n](auto& array) { array.reserve(n); });
  }
  void resize(std::size_t n) {
    for_each_array([n](auto& array) { array.resize(n); });
  }
  /// Appends particle i of `other`.
  void push_back_from(const Particles& other, std::size_t i) {
    position.push_back(other.position[i]);
    velocity.push_back(other.velocity[i]);
    mass.push_back(other.mass[i]);
    volume.push_back(other.volume[i]);
    pressure.push_back(other.pressure[i]);
    entrained_at.push_back(other.entrained_at[i]);
    id.push_back(other.id[i]);
  }

  /// Calls f(array) for every array, always in the same order.
  template <class F>
  void for_each_array(F&& f) {
    f(position), f(velocity), f(mass), f(volume), f(pressure), f(entrained_at), f(id);
  }
  template <class F>
  void for_each_array(F&& f) const {
    f(position), f(velocity), f(mass), f(volume), f(pressure), f(entrained_at), f(id);
  }

  std::size_t bytes() const {
    return spindrift::bytes(position, velocity) + spindrift::bytes(mass, volume, pressure, entrained_at) +
           spindrift::bytes(id);
  }
};

/// What other layers did to the particles in this step. Equal and opposite to GridSources, see coupling.
template <int Dim>
struct ParticleSources {
  std::vector<Vec<Dim>> momentum;  ///< [kg m s^-1]
  std::vector<double> mass;        ///< [kg]
};

}  // namespace spindrift
