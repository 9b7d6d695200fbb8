#pragma once
/// Blocks of snow on a lattice, boxes, and steps of the dense flow, for the tests of sph.

#include <random>

#include "sph/dense_flow.hpp"

namespace spindrift::test {

template <int Dim>
void add_particle(Particles<Dim>& p, const Vec<Dim>& x, const Vec<Dim>& v, double volume, double density) {
  p.position.push_back(x);
  p.velocity.push_back(v);
  p.volume.push_back(volume);
  p.mass.push_back(density * volume);
  p.pressure.push_back(0);
  p.entrained_at.push_back(-1);
  p.id.push_back(p.id.size());
}

/// n particles along each axis, spacing d, the lower corner of the block at `corner`.
template <int Dim>
void add_block(Particles<Dim>& p, const Index<Dim>& n, double d, double density, const Vec<Dim>& corner) {
  for_each_index<Dim>(n, [&](const Index<Dim>& i) {
    Vec<Dim> x = corner;
    for (int k = 0; k < Dim; ++k) x[k] += (i[k] + 0.5) * d;
    add_particle<Dim>(p, x, Vec<Dim>::Zero(), std::pow(d, Dim), density);
  });
}

/// Displaces every particle by up to `amount` along each axis, and gives it a random velocity up to `speed`.
template <int Dim>
void shake(Particles<Dim>& p, double amount, double speed, unsigned seed = 7) {
  std::mt19937 engine(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  for (std::size_t i = 0; i < p.size(); ++i)
    for (int k = 0; k < Dim; ++k) {
      p.position[i][k] += amount * uniform(engine);
      p.velocity[i][k] += speed * uniform(engine);
    }
}

template <int Dim>
Walls<Dim> box(const Vec<Dim>& size, Side side = Side::closed) {
  Walls<Dim> walls;
  walls.domain.upper = size;
  for (auto& axis : walls.sides) axis = {side, side};
  return walls;
}

template <int Dim>
Walls<Dim> no_walls() {
  Walls<Dim> walls = box<Dim>(Vec<Dim>::Constant(2e4), Side::open);
  walls.domain.lower = Vec<Dim>::Constant(-2e4);
  return walls;
}

template <int Dim>
DenseFlowOptions options_for(double d) {
  DenseFlowOptions options;
  options.support_radius = 2 * d;
  options.spacing = d;
  return options;
}

/// One step of the dense flow alone. Returns the impulse of walls and cover.
template <int Dim>
Vec<Dim> step(DenseFlow<Dim>& flow, double dt, const Walls<Dim>& walls, const Vec<Dim>& gravity, Stages& stages,
              const CoverView<Dim>& cover = {}) {
  flow.sort(walls, stages);
  flow.find_neighbours(walls, cover, stages);
  for (auto& v : flow.particles.velocity) v += dt * gravity;
  const Vec<Dim> solve = flow.solve_velocity(dt, stages).boundary_impulse;
  return solve + flow.move(dt, walls, stages);
}

template <int Dim>
Vec<Dim> momentum(const Particles<Dim>& p) {
  Vec<Dim> sum = Vec<Dim>::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) sum += p.mass[i] * p.velocity[i];
  return sum;
}

}  // namespace spindrift::test
