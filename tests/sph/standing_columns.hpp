#pragma once
/// Columns together with the feet that they refer to.

#include <vector>

#include "sph/columns.hpp"

namespace spindrift {

template <int Dim>
struct StandingColumns : Columns<Dim> {
  std::vector<Foot<Dim>> feet;
};

template <int Dim>
void build_columns(StandingColumns<Dim>& columns, const Terrain<Dim>& terrain, const Particles<Dim>& snow,
                   const Cover<Dim>* cover, double spacing, double support_radius) {
  terrain.find_feet(columns.feet, snow.position);
  build_columns<Dim>(columns, terrain, columns.feet, snow, cover, spacing, support_radius);
}

}  // namespace spindrift
