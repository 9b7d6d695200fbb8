#pragma once
/// The bed in the grid: which part of each face and cell is open (R21: a cut-cell wall, not a staircase), and velocity
/// carried on into it, so that whatever interpolates near the wall sees a free-slip wall.

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "grid/mac_grid.hpp"
#include "grid/span.hpp"

namespace spindrift {

template <int Dim>
class Ground {
 public:
  /// Everything open.
  Ground(const MacGrid<Dim>& grid, double air_density);

  /// Signed distance at nodes [m], positive in the air, for the given columns of cells, apart from each other.
  /// Throws Error(bad_input): a distance that is not finite; then nothing has changed.
  void set(const Field<Dim>& node_distance, std::span<const Span> columns);

  /// Open area fraction of faces, 0..1; fractions under `smallest_opening` count as closed.
  const FaceField<Dim>& open() const { return open_; }
  /// Open volume of cells [m^Dim], 0 or at least `smallest_volume` of a cell: the volume that densities refer to.
  const Field<Dim>& volume() const { return volume_; }
  /// Mass of the air in the faces' control volumes [kg], half of each neighbour cell's; 0 on closed faces.
  const FaceField<Dim>& air_mass() const { return air_mass_; }
  /// Less than half a cell's volume.
  bool is_small(double volume) const { return volume < 0.5 * grid_.cell_volume(); }
  /// The open cells that are small, by flat number.
  const std::vector<std::uint32_t>& small_cells() const { return small_cells_; }
  /// The faces of each row of `axis` that are open or within `n_layers` of it.
  const std::vector<Span>& rows(int axis) const { return rows_[static_cast<std::size_t>(axis)]; }
  const std::array<std::vector<Span>, Dim>& rows() const { return rows_; }

  /// Closed faces within n_layers of open ones take the mean of their neighbours in the layer above.
  void extrapolate(FaceField<Dim>& u) const;
  /// Closed faces farther inside the ground become 0, in the neighbourhood of the cell columns [begin, end).
  void clear_deep(FaceField<Dim>& u, int begin, int end) const;

  std::size_t bytes() const;

  static constexpr double smallest_opening = 1e-9;  // rounding; what closes more leaves cells that a stream cannot pass
  static constexpr double smallest_volume = 0.1;
  static constexpr int n_layers = 3;
  /// Columns beyond those of set() or clear_deep() whose faces may change.
  static constexpr int reach = n_layers + 1;

 private:
  void set_fractions(const Field<Dim>& node_distance, int begin, int end);
  void set_air_mass(int axis, int begin, int end);
  void set_layers(int axis, int begin, int end);
  void set_lists();

  MacGrid<Dim> grid_;
  double air_density_;
  FaceField<Dim> open_;
  Field<Dim> volume_;
  FaceField<Dim> air_mass_;
  FaceField<Dim, std::uint8_t> layer_;  ///< 0: open face, 1..n_layers, deep
  Field<Dim, std::uint8_t> small_;      ///< 1: open and small
  std::array<std::array<std::vector<std::uint32_t>, n_layers>, Dim> faces_of_layer_;
  std::array<std::vector<Span>, Dim> rows_;
  std::vector<std::uint32_t> small_cells_;
};

/// Face mass [kg] of one face from its row data. axis: of the face; smoke of the cells on both sides, where they exist.
template <int Dim>
double smoke_of_face(const Field<Dim>& smoke, int axis, const Index<Dim>& face) {
  double mass = 0;
  if (face[axis] < smoke.shape()[axis]) mass += smoke[face];
  if (face[axis] > 0) mass += smoke[shifted<Dim>(face, axis, -1)];
  return 0.5 * mass;
}

}  // namespace spindrift
