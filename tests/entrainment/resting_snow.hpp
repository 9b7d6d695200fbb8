#pragma once
/// Resting snow on an incline, and snow that slides on it, for tests of entrainment.

#include <cmath>
#include <vector>

#include "entrainment/entrainment.hpp"
#include "sph/sampling.hpp"
#include "sph/standing_columns.hpp"

namespace spindrift {

inline constexpr double g = 9.81, d = 0.1;
inline constexpr FailureThreshold always{1e-30, 1e-30};

template <int Dim>
Vec<Dim> down() {
  return -g * up<Dim>();
}

template <int Dim>
Terrain<Dim> incline(double angle) {
  return Terrain<Dim>({{0, 0}, {500, -500 * std::tan(angle)}});
}

/// One particle of `kind` at each place (arc length[, y], normal distance).
template <int Dim>
Particles<Dim> particles_at(const Terrain<Dim>& terrain, const std::vector<Vec<Dim>>& places, SnowKind<Dim> kind) {
  Particles<Dim> all;
  for (const Vec<Dim>& place : places) {
    const Vec<Dim> x = terrain.position(Vec<Dim - 1>(place.template head<Dim - 1>()), place[Dim - 1]);
    const double half = kind.spacing / 2;
    all.push_back_from(sample_box<Dim>({x.array() - half, x.array() + half}, kind), 0);
    ++kind.first_id;
  }
  return all;
}

template <int Dim>
Cover<Dim> cover_at(const Terrain<Dim>& terrain, const std::vector<Vec<Dim>>& places, double thickness) {
  Cover<Dim> cover;
  cover.spacing = d;
  cover.density = 100;
  cover.thickness = thickness;
  cover.particles = particles_at<Dim>(terrain, places, {.spacing = d, .density = 100});
  for (const Vec<Dim>& x : cover.particles.position) cover.foot.push_back(terrain.foot(x));
  cover.hazard.assign(cover.particles.size(), 0);
  index_cover(cover);
  return cover;
}

/// A row of snow, `spacing` apart, that slides at 5 m/s on the cover, or on the ground where none is left.
template <int Dim>
Particles<Dim> sliding_on(const Terrain<Dim>& terrain, const Cover<Dim>& cover, double length, double breadth,
                          double spacing) {
  Particles<Dim> snow = sample_slab<Dim>(terrain, {.length = length, .thickness = spacing, .y = {0, breadth}},
                                         {.spacing = spacing, .density = 300, .first_id = 1u << 30});
  for (std::size_t i = 0; i < snow.size(); ++i) {
    const Foot<Dim> foot = terrain.foot(snow.position[i]);
    const double surface = cover.surface(ground_bin<Dim>(foot.place, 2 * spacing));
    snow.position[i] = terrain.position(foot.place, surface + spacing / 2);
    snow.velocity[i].setConstant(5);
  }
  return snow;
}

template <int Dim>
Vec<Dim> place(double s, double distance) {
  Vec<Dim> p = Vec<Dim>::Constant(0.05);
  p[0] = s, p[Dim - 1] = distance;
  return p;
}

template <int Dim>
Particles<Dim> take(const EntrainmentOptions& options, Cover<Dim>& cover, const Terrain<Dim>& terrain,
                    const Particles<Dim>& snow, double dt, double traction = 0) {
  Entrainment<Dim> entrainment(options);
  StandingColumns<Dim> columns;
  build_columns<Dim>(columns, terrain, snow, &cover, cover.spacing, 2 * cover.spacing);
  for (Column<Dim>& column : columns.columns) column.friction[0] = -traction * column.area * dt;
  return entrainment.take(cover, snow, columns, down<Dim>(), {.time = 3, .dt = dt});
}

inline constexpr double for_ever = 1e12;  ///< [s], at which every candidate goes

}  // namespace spindrift
