#pragma once
/// Maps of a 3D run seen from above: the largest of thickness, speed, pressure, smoke and cloud that each place saw,
/// the deposit and the erosion. They follow the simulation from outside, at times of their own.

#include <string>
#include <vector>

#include "simulation/map_cells.hpp"
#include "simulation/simulation.hpp"

namespace spindrift {

struct Raster {
  std::string name;
  ElevationGrid map;  ///< in the coordinates of the scene file
};

/// Snow is summed on cells of the map, or where these are finer than two particle spacings on blocks of them that are
/// not: each particle's volume, mass and momentum go to the four cells around its foot on the ground, with bilinear
/// weights, so that a layer of particles has no holes and no stripes. Thickness is volume over area of ground, hence
/// normal to the ground. All flowing snow over a cell counts, also what is in the air. Blocks repeat their value in
/// each of their cells. Smoke is taken on the columns of the air's grid, whose means by area make the map.
/// Cost: a sample is due when the fastest snow may have gone half a cell of its sums, or the fastest air one cell of
/// its grid, at the latest after 0.1 s; so no sample misses more than the front's last half cell.
class Rasters {
 public:
  static constexpr double longest_interval = 0.1;  ///< between samples [s]

  /// Pre: the scene has a terrain.   Throws Error(would_not_fit).
  explicit Rasters(const Simulation<3>& simulation);

  /// After every step: takes the samples that are due.
  void follow(const Simulation<3>& simulation);

  /// The maps so far, of the layers that the scene has; the state as it stands counts among the peaks. To four
  /// decimals.
  ///   flow_thickness  [m]; flow_speed [m s^-1]: of the column's centre of mass; flow_pressure [kPa]: rho v^2, rho the
  ///                   column's mass over its volume. Both count where at least an eighth of a spacing lies.
  ///   deposit         thickness of the flow as it stands [m]
  ///   erosion         thickness of the cover that was taken [m]
  ///   smoke_density   largest of the column [kg m^-3]
  ///   cloud_height    of smoke above 0.1 kg m^-3 in the column, its distance from the ground [m]
  std::vector<Raster> maps(const Simulation<3>& simulation);

  std::size_t bytes() const;

 private:
  struct Sum {
    double volume = 0, mass = 0;
    Vec<3> momentum = Vec<3>::Zero();
  };
  struct Peaks {
    std::vector<double> thickness, speed, pressure;
  };
  struct Cloud {
    std::vector<double> densest;  ///< smoke that each column had [kg m^-3]
    std::vector<int> highest;     ///< cell that was cloud; -1: none
  };

  double sum_up(const Simulation<3>& simulation);
  void raise(Peaks& peaks) const;
  void raise(Cloud& cloud, const Suspension<3>& suspension) const;
  void add_taken(const Particles<3>& taken, const Terrain<3>& terrain);
  Raster raster(const std::string& name, const MacGrid<2>& from, std::span<const double> values) const;

  ElevationGrid empty_;
  MacGrid<2> cells_;          ///< of the map
  MacGrid<2> blocks_;         ///< of the sums, one or more cells of the map each
  std::vector<double> area_;  ///< of the ground under each block [m^2]
  double next_snow_ = 0, next_air_ = 0;

  std::vector<Sum> sums_;               ///< of the snow as it stands; zero but in touched_
  std::vector<std::uint32_t> touched_;  ///< blocks that have snow
  std::vector<Vec<2>> places_;          ///< scratch: of each particle's foot
  double least_thickness_ = 0;          ///< for speed and pressure [m]
  Peaks peaks_;
  std::vector<double> taken_;  ///< volume of the cover that was taken [m^3]

  MacGrid<3> air_;      ///< the whole grid of the air, of which the suspension may hold a part
  MacGrid<2> columns_;  ///< of that grid
  Cloud cloud_;
};

}  // namespace spindrift
