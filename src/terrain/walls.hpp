#pragma once
/// Everything solid that particles meet: the terrain, where there is one, obstacles, and the closed sides of the
/// domain.

#include <array>
#include <optional>
#include <vector>

#include "terrain/known_ground.hpp"
#include "terrain/obstacle.hpp"
#include "terrain/terrain.hpp"

namespace spindrift {

enum class Side : std::uint8_t { open, closed };

template <int Dim>
struct Walls {
  std::optional<Terrain<Dim>> terrain;
  std::vector<Box<Dim>> obstacles;
  Box<Dim> domain;
  std::array<std::array<Side, 2>, Dim> sides{};  ///< [axis][0 lower, 1 upper]
  KnownGround known{};                           ///< of a height field in 3D

  /// Calls f(distance, normal) for the terrain, for every obstacle and for every closed side nearer than `reach` [m].
  template <class F>
  void for_each_near(const Vec<Dim>& x, double reach, F&& f) const {
    for_each_near(x, terrain && !terrain->clears(x, reach) ? terrain->foot(x) : nowhere<Dim>, reach, f);
  }

  /// The same with the terrain's foot of x, which somebody found before.
  template <class F>
  void for_each_near(const Vec<Dim>& x, const Foot<Dim>& foot, double reach, F&& f) const {
    if (foot.distance < reach) f(foot.distance, foot.normal);
    for (const Box<Dim>& obstacle : obstacles) {
      const BoxSurface<Dim> surface = surface_of<Dim>(obstacle, x);
      if (surface.distance < reach) f(surface.distance, surface.normal);
    }
    for (int axis = 0; axis < Dim; ++axis) {
      const double below = x[axis] - domain.lower[axis], above = domain.upper[axis] - x[axis];
      if (sides[axis][0] == Side::closed && below < reach) f(below, Vec<Dim>(Vec<Dim>::Unit(axis)));
      if (sides[axis][1] == Side::closed && above < reach) f(above, Vec<Dim>(-Vec<Dim>::Unit(axis)));
    }
  }

  /// Whether x lies beyond an open side, or over ground that is not known.
  bool outside(const Vec<Dim>& x) const {
    for (int axis = 0; axis < Dim; ++axis) {
      if (sides[axis][0] == Side::open && x[axis] < domain.lower[axis]) return true;
      if (sides[axis][1] == Side::open && x[axis] > domain.upper[axis]) return true;
    }
    if constexpr (Dim == 3) return !known.at(x.template head<2>());
    return false;
  }
};

}  // namespace spindrift
