#pragma once
/// Neighbour lists of the dense flow, and what one look at all neighbours yields: volume sums and the boundary.

#include <array>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "core/vec.hpp"
#include "sph/cell_list.hpp"
#include "sph/particles.hpp"
#include "sph/wall_kernel.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// The resting snow as the dense flow sees it: sorted particles and their cell list. A particle of volume 0 is dead.
template <int Dim>
struct CoverView {
  const Particles<Dim>* particles = nullptr;
  const CellList<Dim>* cells = nullptr;
  const std::vector<Vec<Dim>>* surface_normal = nullptr;  ///< n_c, of the smoothed surface at each particle
  bool present() const { return particles != nullptr && !particles->empty(); }
};

/// How the pairs are looked for; what is found is the same to the bit.
enum class NeighbourSearch { cell_list, kd_tree };

/// The pairs (i, j) with 0 <= |x_i - x_j| < h, i != j, in rows; all arrays are in the order of the sorted particles.
template <int Dim>
class Neighbours {
 public:
  /// The neighbours of one particle.
  struct Row {
    std::span<const std::uint32_t> index;  ///< j
    const float* gradients;                ///< grad_i W_ij [m^-(Dim+1)], Dim floats a pair; bitwise -grad_j W_ji
    std::size_t size() const { return index.size(); }
    const float* gradient(std::size_t k) const { return gradients + k * static_cast<std::size_t>(Dim); }
  };

  /// Finds all pairs of the particles, which `cells` has sorted, and per particle
  ///   delta = V W(0) + sum_j V_j W_ij + sum_c V_c W_ic + J
  ///   b     = n n . sum_c V_c grad W_ic + grad J / 2                                [m^-1]
  ///   G     = sum_j V_j grad W_ij + 2 b                                             [m^-1]
  /// over neighbours j, cover c and walls (J of WallKernel); n is the mean of n_c weighted with V_c |grad W_ic|, since
  /// single particles that stand out of the cover are roughness, which the friction law stands for. Cover and walls are
  /// mirrors to the solvers (mirrored velocity, same pressure), so that one vector b stands for all of them. no_slip:
  /// also finds the viscous coefficient of the boundary, c = sum_c 2 V_c |dW/dr| / r + the walls' (WallKernel).
  /// feet: of the terrain, one a particle, or none where there is no terrain.
  /// search: of the particles; the cover, which rests, is always looked up in its own cell list.
  void find(const Particles<Dim>& particles, const CellList<Dim>& cells, const Walls<Dim>& walls,
            const WallKernel<Dim>& wall_kernel, std::span<const Foot<Dim>> feet, const CoverView<Dim>& cover,
            bool no_slip, NeighbourSearch search = NeighbourSearch::cell_list);

  std::size_t size() const { return volume_sum_.size(); }
  Row row(std::size_t i) const {
    const Block& block = blocks_[i / block_size];
    const std::uint32_t first = i % block_size == 0 ? 0 : row_end_[i - 1];
    return {{block.index.data() + first, row_end_[i] - first},
            block.gradient.data() + static_cast<std::size_t>(first) * Dim};
  }
  std::size_t n_pairs() const;

  const std::vector<double>& volume_sum() const { return volume_sum_; }  ///< delta
  /// The volume sum that counts as full: that of WallKernel, or what cover, walls and the particle alone make up where
  /// that is more. Snow that is wedged in between them cannot get thinner, and pressure that tried would grow without
  /// bound.
  const std::vector<double>& full() const { return full_; }
  const std::vector<Vec<Dim>>& boundary_gradient() const { return boundary_; }  ///< b [m^-1]
  const std::vector<Vec<Dim>>& gradient_sum() const { return gradient_sum_; }   ///< G [m^-1]
  const std::vector<double>& no_slip_coefficient() const { return no_slip_; }   ///< c [m^-2], or empty
  std::size_t bytes() const;

  /// Particles whose rows lie together in memory; sweeps go over blocks of this size.
  static constexpr std::size_t block_size = 256;

 private:
  struct Block {
    std::vector<std::uint32_t> index;
    std::vector<float> gradient;
    std::array<std::vector<double>, Dim> x;        ///< of the candidates of one cell, contiguous
    std::vector<double> volume, distance_squared;  ///< of the candidates
    std::vector<std::uint32_t> candidate, hit;     ///< their numbers; which of them are neighbours of one particle
    std::vector<float> value;                      ///< W / sigma of each hit
    std::vector<std::pair<std::uint32_t, double>> found;  ///< by the tree, scratch; empty with the cell list
    void gather(const Particles<Dim>& particles);         ///< what the candidates are
    std::size_t bytes() const;
  };
  struct Input;
  template <class K>
  void find_block(std::size_t begin, std::size_t end, const Input& input, const K& kernel);
  void find_candidates(std::size_t i, Block& block, const Input& input);
  template <class K>
  void find_row(std::size_t i, Block& block, const Input& input, const K& kernel);
  template <class K>
  void add_boundary(std::size_t i, const typename CellList<Dim>::Runs& cover_runs, const Input& input, const K& kernel);

  std::vector<Block> blocks_;
  std::vector<std::uint32_t> row_end_;  ///< within the particle's block
  std::vector<double> volume_sum_, full_, no_slip_;
  std::vector<Vec<Dim>> boundary_, gradient_sum_;
};

}  // namespace spindrift
