#pragma once
/// Particles sorted by cells of the size of the support radius; memory is proportional to particles, not to the domain.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <tuple>
#include <vector>

#include "core/vec.hpp"
#include "sph/particles.hpp"

namespace spindrift {

/// Integer cell coordinates floor(x / h) are packed into one 64-bit key, x in the lowest bits and the up axis in the
/// highest; particles are sorted by (key, id), so their order is a function of the state alone. Three cells in a row
/// along x hold one contiguous run of particles, so the neighbourhood of a cell is 3^(Dim-1) runs.
template <int Dim>
class CellList {
 public:
  struct Run {
    std::uint32_t begin = 0, end = 0;  ///< of particles
  };
  static constexpr std::size_t n_runs = Dim == 2 ? 3 : 9;
  using Runs = std::array<Run, n_runs>;

  explicit CellList(double cell_size) : inverse_size_(1 / cell_size) {}

  /// Sorts the particles and indexes them; no particles are fine.
  /// Throws Error(unstable) naming the id and position of a particle that is not finite or over 10^6 cells away.
  void build(Particles<Dim>& particles);

  /// order()[i]: where the particle that is now i stood before the last build.
  std::span<const std::uint32_t> order() const { return order_; }
  std::size_t n_particles() const { return order_.size(); }
  std::size_t n_cells() const { return keys_.size(); }
  /// The particles of an occupied cell; cells are in the order of their particles.
  Run cell(std::size_t c) const { return {starts_[c], starts_[c + 1]}; }
  /// All particles that can lie within one cell size of a particle of cell c; the runs may be empty.
  const Runs& runs(std::size_t c) const { return runs_[c]; }
  /// The occupied cell of particle i.
  std::size_t cell_of(std::uint32_t i) const;

  /// The runs around any position; all empty if there is none, or if the position is absurd.
  Runs runs_near(const Vec<Dim>& x) const;
  /// f(j) for all particles that can lie within one cell size of x.
  template <class F>
  void for_each_near(const Vec<Dim>& x, F&& f) const {
    for (const Run& run : runs_near(x))
      for (std::uint32_t j = run.begin; j < run.end; ++j) f(j);
  }

  /// Frees what only the next build would reuse: for particles that are sorted once.
  void release_scratch();
  std::size_t bytes() const;

 private:
  using Key = std::uint64_t;
  struct Entry {
    Key key;
    std::uint32_t index;
  };
  static constexpr int bits = Dim == 2 ? 31 : 21;        ///< of one coordinate in the key
  static constexpr double reach = Dim == 2 ? 1e9 : 1e6;  ///< largest |coordinate|, well inside the bits

  Index<Dim> coordinates(const Vec<Dim>& x) const {
    Index<Dim> c;
    for (int k = 0; k < Dim; ++k) c[k] = static_cast<int>(std::floor(x[k] * inverse_size_));
    return c;
  }
  bool absurd(const Vec<Dim>& x) const { return !((x * inverse_size_).array().abs() < reach).all(); }
  static Key pack(const Index<Dim>& c);
  static Key row_shift(std::size_t run);
  void check_positions(const Particles<Dim>& particles) const;
  bool sort_entries(const Particles<Dim>& particles);
  void permute(Particles<Dim>& particles);
  void index_cells();
  void find_runs();

  double inverse_size_;
  std::vector<std::uint32_t> order_;
  std::vector<Key> keys_;              ///< of the occupied cells, ascending
  std::vector<std::uint32_t> starts_;  ///< first particle of each occupied cell, and the end
  std::vector<Runs> runs_;
  std::vector<Entry> entries_, other_entries_;
  /// Takes a sorted array of its type, and is left with the unsorted one.
  std::tuple<std::vector<Vec<Dim>>, std::vector<double>, std::vector<std::uint64_t>> others_;
};

}  // namespace spindrift
