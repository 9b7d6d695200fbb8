#pragma once
/// The ground of a scene, and how much of it there is.

#include <functional>
#include <string>

#include "simulation/scene.hpp"
#include "terrain/height_field.hpp"
#include "terrain/known_ground.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// Pre: the scene has a terrain.   Throws Error(bad_input): numbers that describe no ground.
template <int Dim>
Terrain<Dim> make_terrain(const Scene& scene);

/// The heights of a scene's height field: of its shape, sampled, or of its elevation model, of which the part under the
/// domain and a rim is kept; holes get the nearest known height. Obstacles of shape "area" are part of it.
HeightGrid ground_heights(const Scene& scene);

/// Where the scene's elevation model has heights, around the domain.   Pre: there is one.
KnownGround known_ground(const Scene& scene);

/// First coordinate of the place from which ways along the ground are counted [m].
template <int Dim>
double way_begins(const Walls<Dim>& walls) {
  return walls.terrain->height_field() ? walls.domain.lower[0] : 0;
}

/// Columns and rows of an elevation model from which the ground inside the domain is made.
struct GridPart {
  Index<2> first, last;
};
GridPart part_under(const Box<2>& domain, const ElevationGrid& grid);

/// The domain seen from above [m].   Pre: in 3D.
Box<2> domain_in_plan(const Scene& scene);

/// Area of the ground under the places of `extent` that `counts` accepts, to about 1 % [m^2].
double ground_area(const HeightField& ground, const Box<2>& extent, const std::function<bool(const Vec<2>&)>& counts);

}  // namespace spindrift
