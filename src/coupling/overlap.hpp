#pragma once
/// Which particles of the dense flow lie in the overlap region (paper Sec. 4.1, Eqs. 5 and 6; R1).

#include <vector>

#include "sph/dense_flow.hpp"

namespace spindrift {

/// n in the interior of a lattice of spacing d with support h: what the threshold is a fraction of.
template <int Dim>
double interior_number_density(double spacing, double support_radius);

/// The number density is taken at the particles, not at grid points, which at h < dx hardly see any:
///   n_i = sum_j (V_j / d^Dim) W_n(|x_i - x_j|, h)
/// over dense particles j != i, cover particles and the ground's share of the kernel. Particle i is in the overlap
/// region where n_i < overlap_fraction * n_interior; so is a particle that flies alone.
/// overlap   out: 1 or 0, one a particle
/// dense     in: its neighbours must be those of the present positions
/// Source: paper Eqs. (5), (6).   Departure: R1.
template <int Dim>
void classify_overlap(std::vector<std::uint8_t>& overlap, const DenseFlow<Dim>& dense, const CoverView<Dim>& cover,
                      const Walls<Dim>& walls, double overlap_fraction, double n_interior);

}  // namespace spindrift
