#pragma once
/// What stands at one place feels: density, speed and pressure of flow and cloud over time, at a height over the
/// ground.

#include <optional>
#include <string>
#include <vector>

#include "simulation/simulation.hpp"
#include "sph/wall_kernel.hpp"

namespace spindrift {

/// Where a pylon's head is [m]: straight over the ground, without terrain over the domain's bottom.
template <int Dim>
Vec<Dim> pylon_place(const PylonSection& pylon, const Walls<Dim>& walls);

template <int Dim>
class Pylons {
 public:
  static constexpr double interval = 0.05;  ///< between samples, taken at the first step at or after each [s]

  /// Pre: the scene has a [[pylon]].
  explicit Pylons(const Simulation<Dim>& simulation);

  /// The columns of a row: time_s, then for each pylon, of the layers that the scene has, under its name
  ///   NAME_flow_density_kg_m3, NAME_flow_speed_m_s, NAME_flow_pressure_kPa
  ///   NAME_smoke_density_kg_m3, NAME_air_speed_m_s, NAME_cloud_pressure_kPa
  std::vector<std::string> headings() const;

  /// A row, where one is due; valid until the next call.
  ///   flow   rho = sum m W / (share of the kernel above the ground), v = sum m v W / sum m W over the particles within
  ///          the support radius; pressure rho v^2
  ///   cloud  smoke and air interpolated between cells; pressure (rho_air + rho_smoke) u^2
  const std::vector<double>* follow(const Simulation<Dim>& simulation);

 private:
  struct Point {
    std::string name;
    Vec<Dim> x;
    double above_ground;  ///< share of the kernel around x
  };
  void feel_flow(const Particles<Dim>& particles, const Point& point);
  void feel_air(const Suspension<Dim>& suspension, const Point& point);

  std::vector<Point> points_;
  bool flow_, air_;
  double support_radius_ = 0;  ///< [m]
  double next_ = 0;
  std::vector<double> row_;
};

}  // namespace spindrift
