#pragma once
/// Square cells seen from above: of maps, and of what they are made from.

#include <span>
#include <vector>

#include "grid/mac_grid.hpp"
#include "io/esri_grid.hpp"
#include "simulation/scene.hpp"
#include "terrain/terrain.hpp"

namespace spindrift {

/// The map of a scene without its values, in the coordinates of the scene file. output.raster_cell 0: the cells of an
/// elevation model that lie over the domain, themselves; over other grounds cells from the domain's lower corner on, of
/// terrain.cell_size, over a profile of two particle spacings (without snow: the air's cells).
/// Throws Error(would_not_fit): more than 5e7 cells.   Pre: in 3D, with a terrain.
ElevationGrid empty_map(const Scene& scene);

/// Its cells in the solver's coordinates.   origin: Scene::origin [m]
MacGrid<2> cells_of(const ElevationGrid& map, const std::array<double, 3>& origin);

/// Area of the ground under each cell [m^2], from its heights at parts x parts places a cell.
std::vector<double> ground_areas(const Terrain<3>& terrain, const MacGrid<2>& cells, int parts);

/// The values of `from` on the cells of `to`: means by the area that they share. Where cells are larger they average,
/// where they are smaller they repeat, and the integral is kept. 0 off the cells of `from`.
std::vector<double> on_cells(const MacGrid<2>& from, std::span<const double> values, const MacGrid<2>& to);

}  // namespace spindrift
