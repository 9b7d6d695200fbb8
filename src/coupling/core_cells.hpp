#pragma once
/// The dense core as a boundary of the suspension (paper Sec. 4.2, R10): which cells the core fills, how fast they
/// move, and how the air's answer goes back to the particles that fill them.

#include <span>
#include <vector>

#include "grid/suspension.hpp"
#include "sph/particles.hpp"

namespace spindrift {

template <int Dim>
class CoreCells {
 public:
  /// Finds the cells of which particles outside the overlap region fill at least half of the open volume.
  /// overlap   in: nonzero for particles of the overlap region, one entry a particle
  void find(const Particles<Dim>& particles, std::span<const std::uint8_t> overlap, const Suspension<Dim>& suspension);

  /// In the order of the grid's memory; the suspension writes impulses and adhered smoke into them.
  std::span<CoreCell<Dim>> cells() { return cells_; }

  /// Gives each cell's impulse and adhered smoke to its particles in proportion to their mass.
  /// Returns the momentum given [kg m s^-1] and adds the smoke's mass to `adhered` [kg].
  Vec<Dim> give_back(Particles<Dim>& particles, double& adhered) const;

  std::size_t bytes() const;

 private:
  struct Member {
    std::size_t cell;
    std::uint32_t particle;
  };
  std::vector<Member> members_;  ///< of all cells with particles outside overlap, by (cell, particle)
  std::vector<CoreCell<Dim>> cells_;
  std::vector<std::array<std::uint32_t, 2>> ranges_;  ///< of members_, one a core cell
};

}  // namespace spindrift
