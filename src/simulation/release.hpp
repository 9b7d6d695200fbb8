#pragma once
/// What is there when the clock starts: the snow that a scene releases, and smoke in the air; and the smoke that keeps
/// coming.

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "grid/suspension.hpp"
#include "simulation/scene.hpp"
#include "simulation/scene_vectors.hpp"
#include "sph/particles.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// Whether (x, z), or (x, y), lies inside a polygon, by the even-odd rule.
bool inside(const std::vector<std::array<double, 2>>& corners, double x, double z);

/// The box around a release, or smoke, that does not lie on the ground.
template <int Dim, class Shaped>
Box<Dim> box_around(const Shaped& shaped, const Walls<Dim>& walls) {
  if (shaped.shape == "box") return box_of<Dim>(shaped.lower, shaped.upper);
  if (shaped.shape == "ball") {
    const Vec<Dim> center = vector_or<Dim>(shaped.center);
    return {center - Vec<Dim>::Constant(shaped.radius), center + Vec<Dim>::Constant(shaped.radius)};
  }
  Box<Dim> box = walls.domain;
  for (const auto& [k, axis] : {std::pair{0, 0}, std::pair{1, up_axis<Dim>}}) {
    const auto of_axis = [k = static_cast<std::size_t>(k)](const auto& a, const auto& b) { return a[k] < b[k]; };
    const auto [least, most] = std::minmax_element(shaped.points.begin(), shaped.points.end(), of_axis);
    box.lower[axis] = (*least)[static_cast<std::size_t>(k)];
    box.upper[axis] = (*most)[static_cast<std::size_t>(k)];
  }
  return box;
}

/// What became of the particles of one release.
struct ReleaseCount {
  std::size_t placed = 0;   ///< in the dense flow
  std::size_t buried = 0;   ///< left out: in the ground, the cover, an obstacle or a closed side
  std::size_t doubled = 0;  ///< left out: in an earlier release
  std::size_t outside = 0;  ///< of those placed: beyond an open side, gone after the first step
};

template <int Dim>
struct ReleasedSnow {
  Particles<Dim> particles;            ///< ids from 0
  std::vector<ReleaseCount> releases;  ///< in the order of the scene
};

/// Lattices of the particle spacing d in every shape, an area's snow evenly spread instead; ids in the order of the
/// scene. Places nearer than d/4 to something solid, or inside an earlier release, are left out. Velocity: velocity +
/// shear (z - z_least) e_x + rotation (x - middle) turned from x to z.
template <int Dim>
ReleasedSnow<Dim> released_snow(const Scene& scene, const Walls<Dim>& walls);

/// Smoke of each cell [kg], from the shapes of [smoke]: density times open volume times the share of the cell that the
/// shape fills. Later ones replace earlier ones, but where they have none.   Pre: the suspension's ground is set.
template <int Dim>
Field<Dim> initial_smoke(const Scene& scene, const Suspension<Dim>& suspension);

/// Smoke that each cell is given [kg s^-1], from the shapes of [smoke] in the same way, but that all of them add up.
/// The open volume is that of the call: ground that sinks later gives off nothing.
template <int Dim>
Field<Dim> smoke_rate(const Scene& scene, const Suspension<Dim>& suspension);

}  // namespace spindrift
