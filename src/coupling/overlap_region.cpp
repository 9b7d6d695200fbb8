#include "coupling/overlap_region.hpp"

#include <limits>

namespace spindrift {
namespace {

/// The stencil's points that `open` accepts, their weights scaled to sum to 1 (R4).
template <int Dim, class Open>
Shares<Dim> shares_of(const Stencil<Dim>& stencil, PointSet<Dim>& points, Open&& open) {
  Shares<Dim> shares;
  double sum = 0;
  for (std::size_t c = 0; c < Shares<Dim>::n; ++c) {
    const bool takes_part = stencil.weight[c] > 0 && open(stencil.point[c]);
    shares.weight[c] = takes_part ? stencil.weight[c] : 0;
    shares.slot[c] = takes_part ? points.slot(stencil.point[c]) : 0;
    sum += shares.weight[c];
  }
  if (sum > 0)
    for (double& w : shares.weight) w /= sum;
  return shares;
}

/// Whether a cell may hold smoke: open, not filled by the core.
template <int Dim>
bool takes_smoke(const Suspension<Dim>& suspension, std::size_t cell) {
  return suspension.ground().volume()[cell] > 0 && suspension.kind()[cell] != CellKind::core;
}

}  // namespace

template <int Dim>
void find_region(OverlapRegion<Dim>& region, const Particles<Dim>& particles, std::span<const std::uint8_t> overlap,
                 const Suspension<Dim>& suspension) {
  const MacGrid<Dim>& grid = suspension.grid();
  region.particles.clear();
  for (std::size_t i = 0; i < particles.size(); ++i)
    if (overlap[i] && grid.box().contains(particles.position[i]))
      region.particles.push_back(static_cast<std::uint32_t>(i));

  const std::size_t n = region.size();
  region.velocity.resize(n);
  region.slip.resize(n);
  region.stiffness.assign(n, 0.0);
  region.loading.assign(n, 0.0);
  region.swept.assign(n, 0.0);
  for (std::size_t k = 0; k < n; ++k) region.velocity[k] = particles.velocity[region.particles[k]];

  region.cells.clear(count<Dim>(grid.cells));
  region.on_cells.resize(n);
  for (std::size_t k = 0; k < n; ++k)
    region.on_cells[k] = shares_of<Dim>(cell_stencil<Dim>(grid, particles.position[region.particles[k]]), region.cells,
                                        [&](std::size_t cell) { return takes_smoke(suspension, cell); });

  for_each_axis<Dim>([&](int axis) {
    PointSet<Dim>& faces = region.faces[axis];
    faces.clear(count<Dim>(grid.faces(axis)));
    region.on_faces[axis].resize(n);
    for (std::size_t k = 0; k < n; ++k)
      region.on_faces[axis][k] =
          shares_of<Dim>(face_stencil<Dim>(grid, axis, particles.position[region.particles[k]]), faces,
                         [&](std::size_t face) { return suspension.active_faces()[axis][face] != 0; });
    region.face_mass[axis].resize(faces.size());
    region.face_velocity[axis].resize(faces.size());
    region.face_momentum[axis].assign(faces.size(), 0.0);
    for (std::size_t s = 0; s < faces.size(); ++s) {
      region.face_mass[axis][s] = suspension.options().frozen ? std::numeric_limits<double>::infinity()
                                                              : suspension.face_mass(axis, faces.points()[s]);
      region.face_velocity[axis][s] = suspension.velocity()[axis][faces.points()[s]];
    }
    region.start_velocity[axis] = region.face_velocity[axis];
  });
  parallel_for(n, [&](std::size_t k) { region.slip[k] = (region.velocity[k] - region.air_velocity(k)).norm(); });
}

template <int Dim>
std::size_t OverlapRegion<Dim>::bytes() const {
  std::size_t sum = spindrift::bytes(particles) + spindrift::bytes(on_cells) + cells.bytes() +
                    spindrift::bytes(velocity) + spindrift::bytes(impulse) +
                    spindrift::bytes(slip, stiffness, loading, coupled_mass, swept);
  for (int axis = 0; axis < Dim; ++axis) {
    const auto& [lumped, residual, direction, image] = drag_system[axis];
    sum += spindrift::bytes(on_faces[axis]) + faces[axis].bytes() +
           spindrift::bytes(face_mass[axis], face_velocity[axis], start_velocity[axis], face_momentum[axis]) +
           spindrift::bytes(particle_mass[axis], lumped, residual, direction, image);
  }
  return sum;
}

template struct OverlapRegion<2>;
template struct OverlapRegion<3>;
template void find_region<2>(OverlapRegion<2>&, const Particles<2>&, std::span<const std::uint8_t>,
                             const Suspension<2>&);
template void find_region<3>(OverlapRegion<3>&, const Particles<3>&, std::span<const std::uint8_t>,
                             const Suspension<3>&);

}  // namespace spindrift
