#pragma once
/// The step of the dense flow, bare or on a cover that rests, put together from src/sph: what it costs where nothing
/// else was ever written.

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <stdexcept>

#include "absence/bits.hpp"
#include "core/parallel.hpp"
#include "sph/bed_friction.hpp"
#include "sph/dense_flow.hpp"
#include "sph/sampling.hpp"

namespace spindrift::absence {

struct DenseAlone {
  static constexpr double max_step = 0.01, cfl = 0.4, compaction_time = 0.1, cover_depth = 0.5;
  static constexpr double fastest = 300;  ///< a speed above is a runaway [m s^-1]
  static constexpr int steps_between_copies = 16;

  Walls<2> walls;
  Vec<2> gravity{0, -9.81};
  DenseFlow<2> dense{DenseFlowOptions{}};
  std::optional<Cover<2>> cover;
  Columns<2> columns;
  Particles<2> saved;  ///< to go back to from a step that fails
  int n_steps = 0;
  double time = 0;  ///< [s]
  double mass_left = 0;
  VelocitySolve<2> solved;
  Vec<2> from_gravity{0, 0}, from_bed{0, 0}, from_walls{0, 0};  ///< impulses of the last step [kg m s^-1]
  Stages stages;

  explicit DenseAlone(bool with_cover) {
    walls.domain = {{0, 0}, {40, 24}};
    walls.sides = {{{Side::open, Side::open}, {Side::closed, Side::open}}};
    walls.terrain.emplace(std::vector<Vec<2>>{{0, 20}, {24, 2}, {100, 1}});
    SnowKind<2> released{dense.options().spacing, dense.options().density, {4, -3}};
    dense.particles = sample_slab<2>(*walls.terrain, {1, 5, with_cover ? cover_depth : 0, 1.5, {}}, released);
    if (!with_cover) return;
    const auto ground_at = [&](double x) {
      return walls.terrain->foot({x, walls.terrain->profile()->height(x)}).place[0];
    };
    CoverLayer layer;
    layer.ground_from = ground_at(0), layer.ground_to = ground_at(40);
    layer.from = std::max(0.0, layer.ground_from), layer.to = layer.ground_to;
    layer.depth = cover_depth;
    cover =
        sample_cover<2>(*walls.terrain, layer, {dense.options().spacing, 100, Vec<2>::Zero(), dense.particles.size()});
  }

  void step() {
    const auto timed = stages.time("step");
    if (n_steps++ % steps_between_copies == 0) saved = dense.particles;
    const double dt = std::min(max_step, dense.time_step_limit(cfl, gravity.norm()));
    const CoverView<2> view =
        cover ? CoverView<2>{&cover->particles, &cover->cells, &cover->surface_normal} : CoverView<2>{};
    dense.sort(walls, stages);
    dense.find_neighbours(walls, view, stages);
    Particles<2>& p = dense.particles;
    parallel_for(p.size(), [&](std::size_t i) { p.velocity[i] += dt * gravity; });
    from_gravity = dt * parallel_sum(p.size(), 0.0, [&](std::size_t i) { return p.mass[i]; }) * gravity;
    solved = dense.solve_velocity(dt, stages);
    {
      const auto columns_timed = stages.time("dense_flow.columns");
      build_columns<2>(columns, *walls.terrain, dense.feet(), p, cover ? &*cover : nullptr, dense.options().spacing,
                       dense.options().support_radius);
    }
    {
      const auto friction_timed = stages.time("dense_flow.friction");
      from_bed = -apply_column_friction<2>(p, columns, BedFriction{}, gravity, dt);
    }
    from_walls = dense.move(dt, walls, stages);
    dense.compact(dt, compaction_time);
    mass_left += dense.remove_outside(walls).mass;
    time += dt;
    check();
  }

  /// As the simulation's check of particles (state_check.hpp): a step that does not look at its result costs less.
  void check() const {
    const Particles<2>& p = dense.particles;
    const double worst = parallel_max(p.size(), 0, [&](std::size_t i) {
      const bool sound = p.position[i].allFinite() && p.mass[i] > 0 && p.volume[i] > 0 &&
                         std::isfinite(p.mass[i] + p.volume[i] + p.pressure[i]);
      return sound ? p.velocity[i].squaredNorm() : std::numeric_limits<double>::quiet_NaN();
    });
    if (!(worst <= fastest * fastest)) throw std::runtime_error("unstable");
  }
};

inline std::uint64_t bits_of(const Particles<2>& p) {
  std::uint64_t hash = bits_of(std::span<const double>{});
  for (const auto* vectors : {&p.position, &p.velocity})
    for (const Vec<2>& v : *vectors) hash = bits_of({v.data(), 2}, hash);
  for (const auto* numbers : {&p.mass, &p.volume, &p.pressure}) hash = bits_of(*numbers, hash);
  return hash;
}

}  // namespace spindrift::absence
