#include "entrainment/shared_traction.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace spindrift {

template <int Dim>
Vec<Dim> share_traction(Particles<Dim>& dense, const Columns<Dim>& columns, std::span<const BedFlux<Dim>> fluxes,
                        double dt) {
  SPINDRIFT_CHECK(columns.foot.size() == dense.size());
  Vec<Dim> given = Vec<Dim>::Zero();
  for (const BedFlux<Dim>& bed : fluxes) {
    const Column<Dim>* column = columns.find(bed.bin);
    if (column == nullptr || !(column->friction.norm() > 0)) continue;
    const Vec<Dim> along = column->friction.normalized();
    const double joining = bed.flux * std::max(0.0, column->velocity.dot(along)) * column->area * dt;
    const Vec<Dim> impulse = std::min(joining, column->friction.norm()) * along;
    double mass = 0;  // not the column's: snow may have stuck to it since
    for (const std::uint32_t i : columns.standing(*column)) mass += dense.mass[i];
    for (const std::uint32_t i : columns.standing(*column)) dense.velocity[i] += impulse / mass;
    given += impulse;
  }
  return given;
}

template Vec<2> share_traction<2>(Particles<2>&, const Columns<2>&, std::span<const BedFlux<2>>, double);
template Vec<3> share_traction<3>(Particles<3>&, const Columns<3>&, std::span<const BedFlux<3>>, double);

}  // namespace spindrift
