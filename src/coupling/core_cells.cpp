#include "coupling/core_cells.hpp"

#include <algorithm>

namespace spindrift {

template <int Dim>
void CoreCells<Dim>::find(const Particles<Dim>& particles, std::span<const std::uint8_t> overlap,
                          const Suspension<Dim>& suspension) {
  const MacGrid<Dim>& grid = suspension.grid();
  members_.clear();
  cells_.clear();
  ranges_.clear();
  for (std::size_t i = 0; i < particles.size(); ++i) {
    if (overlap[i]) continue;
    const Index<Dim> cell = grid.cell_of(particles.position[i]);
    if (inside<Dim>(cell, grid.cells)) members_.push_back({flat<Dim>(cell, grid.cells), static_cast<std::uint32_t>(i)});
  }
  std::sort(members_.begin(), members_.end(), [](const Member& a, const Member& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.particle < b.particle;
  });

  for (std::size_t begin = 0; begin < members_.size();) {
    std::size_t end = begin;
    double mass = 0, volume = 0;
    Vec<Dim> momentum = Vec<Dim>::Zero();
    for (; end < members_.size() && members_[end].cell == members_[begin].cell; ++end) {
      const std::uint32_t i = members_[end].particle;
      mass += particles.mass[i];
      volume += particles.volume[i];
      momentum += particles.mass[i] * particles.velocity[i];
    }
    if (volume >= 0.5 * suspension.ground().volume()[members_[begin].cell]) {
      CoreCell<Dim> cell{};
      cell.cell = unflat<Dim>(members_[begin].cell, grid.cells);
      cell.velocity = momentum / mass;
      cell.mass = mass;
      cell.impulse.setZero();
      cell.adhered_momentum.setZero();
      cells_.push_back(cell);
      ranges_.push_back({static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)});
    }
    begin = end;
  }
}

template <int Dim>
Vec<Dim> CoreCells<Dim>::give_back(Particles<Dim>& particles, double& adhered) const {
  Vec<Dim> given = Vec<Dim>::Zero();
  for (std::size_t c = 0; c < cells_.size(); ++c) {
    const CoreCell<Dim>& cell = cells_[c];
    // One velocity change and one growth for all: momentum and mass reach the particles whole.
    const double growth = 1 + cell.adhered / cell.mass;
    const Vec<Dim> gained = (cell.impulse + cell.adhered_momentum) / cell.mass;
    for (std::uint32_t m = ranges_[c][0]; m < ranges_[c][1]; ++m) {
      const std::uint32_t i = members_[m].particle;
      particles.velocity[i] = (particles.velocity[i] + gained) / growth;
      particles.mass[i] *= growth;
    }
    given += cell.impulse + cell.adhered_momentum;
    adhered += cell.adhered;
  }
  return given;
}

template <int Dim>
std::size_t CoreCells<Dim>::bytes() const {
  return spindrift::bytes(members_) + spindrift::bytes(cells_) + spindrift::bytes(ranges_);
}

template class CoreCells<2>;
template class CoreCells<3>;

}  // namespace spindrift
