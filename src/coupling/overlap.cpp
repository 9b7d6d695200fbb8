#include "coupling/overlap.hpp"

#include <cmath>

#include "core/parallel.hpp"
#include "sph/kernels.hpp"

namespace spindrift {

template <int Dim>
double interior_number_density(double spacing, double support_radius) {
  const int reach = static_cast<int>(std::ceil(support_radius / spacing));
  Index<Dim> block;
  block.fill(2 * reach + 1);
  double n = 0;
  for_each_index<Dim>(block, [&](const Index<Dim>& i) {
    double square = 0;
    for (int k = 0; k < Dim; ++k) square += (i[k] - reach) * (i[k] - reach);
    if (square > 0) n += number_density_kernel(spacing * std::sqrt(square), support_radius, spacing);
  });
  return n;
}

template <int Dim>
void classify_overlap(std::vector<std::uint8_t>& overlap, const DenseFlow<Dim>& dense, const CoverView<Dim>& cover,
                      const Walls<Dim>& walls, double overlap_fraction, double n_interior) {
  const Particles<Dim>& particles = dense.particles;
  const double h = dense.options().support_radius, d = dense.options().spacing;
  const double lattice_volume = std::pow(d, Dim);
  const double threshold = overlap_fraction * n_interior;
  overlap.resize(particles.size());
  parallel_for(particles.size(), [&](std::size_t i) {
    const Vec<Dim>& x = particles.position[i];
    double n = 0;
    for (const std::uint32_t j : dense.neighbours().row(i).index)
      n += particles.volume[j] * number_density_kernel((x - particles.position[j]).norm(), h, d);
    const auto full = [&] { return n / lattice_volume >= threshold; };
    if (cover.present() && !full())
      cover.cells->for_each_near(x, [&](std::uint32_t c) {
        const double square = (x - cover.particles->position[c]).squaredNorm();
        if (square < h * h) n += cover.particles->volume[c] * number_density_kernel(std::sqrt(square), h, d);
      });
    if (!full())
      n += dense.wall_kernel().number_density_share(walls, x, dense.foot(i)) *
           dense.wall_kernel().number_density_integral();
    overlap[i] = !full();
  });
}

#define INSTANTIATE(Dim)                                                                                        \
  template double interior_number_density<Dim>(double, double);                                                 \
  template void classify_overlap<Dim>(std::vector<std::uint8_t>&, const DenseFlow<Dim>&, const CoverView<Dim>&, \
                                      const Walls<Dim>&, double, double);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
