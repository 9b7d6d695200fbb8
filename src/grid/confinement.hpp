#pragma once
/// Vorticity confinement (Fedkiw, Stam, Jensen 2001): gives back some of the swirl that advection smears out.

#include <array>
#include <vector>

#include "grid/ground.hpp"

namespace spindrift {

/// Holds memory only once it has been used.
template <int Dim>
class Confinement {
 public:
  /// du = dt strength dx (N x omega),   N = grad |omega| / |grad |omega||
  /// with omega and N at cell centres (central differences), on the faces with a flow area whose two cells have open
  /// neighbours all around: nothing acts at walls, nor where |omega| is under 0.01 s^-1. Vanishes with dx.
  /// Source: paper Sec. 4.2, f^conf.
  /// u              in-out: [m/s]
  /// ground, smoke  in: give the faces their mass
  /// dt             [s]
  /// Returns the momentum given [kg m s^-1].
  Vec<Dim> apply(FaceField<Dim>& u, const FaceField<Dim>& flow_area, const Ground<Dim>& ground, const Field<Dim>& smoke,
                 const MacGrid<Dim>& grid, double strength, double dt);

  std::size_t bytes() const;

 private:
  void find_vorticity(const FaceField<Dim>& u, const MacGrid<Dim>& grid);
  void find_force(std::size_t row, const FaceField<Dim>& u, const FaceField<Dim>& flow_area, const MacGrid<Dim>& grid,
                  double strength);

  std::array<Field<Dim>, Dim> force_;  ///< at cell centres [m s^-2], in and beside the rows whose air turns
  Field<Dim> size_;                    ///< |omega| at cell centres [s^-1]
  std::vector<std::uint8_t> turning_;  ///< of each row: 1 where its air turns
};

}  // namespace spindrift
