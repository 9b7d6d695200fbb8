#include "simulation/pylons.hpp"

#include <cmath>

#include "core/parallel.hpp"

namespace spindrift {
namespace {

constexpr double pascal_per_kilopascal = 1000;

template <int Dim>
struct Felt {
  double density = 0;                    // sum m W [kg m^-Dim]
  Vec<Dim> momentum = Vec<Dim>::Zero();  // sum m v W
  Felt& operator+=(const Felt& other) {
    density += other.density;
    momentum += other.momentum;
    return *this;
  }
};

}  // namespace

template <int Dim>
Vec<Dim> pylon_place(const PylonSection& pylon, const Walls<Dim>& walls) {
  Vec<Dim> x = walls.domain.lower;
  for (int axis = 0; axis < up_axis<Dim>; ++axis) x[axis] = pylon.position[static_cast<std::size_t>(axis)];
  if (walls.terrain) x[up_axis<Dim>] = walls.terrain->height(x);
  x[up_axis<Dim>] += pylon.height;
  return x;
}

template <int Dim>
Pylons<Dim>::Pylons(const Simulation<Dim>& simulation)
    : flow_(simulation.dense().has_value()), air_(simulation.suspension().has_value()) {
  const Walls<Dim>& walls = simulation.walls();
  std::optional<WallKernel<Dim>> kernel;
  if (flow_) {
    support_radius_ = simulation.dense()->options().support_radius;
    kernel.emplace(support_radius_, simulation.dense()->options().spacing);
  }
  for (const PylonSection& pylon : simulation.scene().pylon) {
    Point point{pylon.name, pylon_place<Dim>(pylon, walls), 1};
    const double off = walls.terrain ? walls.terrain->foot(point.x).distance : pylon.height;
    if (kernel) point.above_ground = 1 - kernel->fraction(off);
    points_.push_back(point);
  }
}

template <int Dim>
std::vector<std::string> Pylons<Dim>::headings() const {
  std::vector<std::string> names{"time_s"};
  for (const Point& point : points_) {
    const auto add = [&](const char* what) { names.push_back(point.name + "_" + what); };
    if (flow_) add("flow_density_kg_m3"), add("flow_speed_m_s"), add("flow_pressure_kPa");
    if (air_) add("smoke_density_kg_m3"), add("air_speed_m_s"), add("cloud_pressure_kPa");
  }
  return names;
}

template <int Dim>
const std::vector<double>* Pylons<Dim>::follow(const Simulation<Dim>& simulation) {
  if (simulation.time() < next_) return nullptr;
  next_ = (std::floor(simulation.time() / interval) + 1) * interval;
  row_.assign(1, simulation.time());
  for (const Point& point : points_) {
    if (flow_) feel_flow(simulation.dense()->particles, point);
    if (air_) feel_air(*simulation.suspension(), point);
  }
  return &row_;
}

template <int Dim>
void Pylons<Dim>::feel_flow(const Particles<Dim>& p, const Point& point) {
  const CubicSpline<Dim> kernel(support_radius_);
  const Felt<Dim> felt = parallel_sum(p.size(), Felt<Dim>{}, [&](std::size_t i) {
    const double r = (p.position[i] - point.x).norm();
    if (r >= support_radius_) return Felt<Dim>{};
    const double m = p.mass[i] * kernel.value(r);
    return Felt<Dim>{m, m * p.velocity[i]};
  });
  const double speed = felt.density > 0 ? felt.momentum.norm() / felt.density : 0;
  const double density = felt.density / point.above_ground;
  row_.insert(row_.end(), {density, speed, density * speed * speed / pascal_per_kilopascal});
}

template <int Dim>
void Pylons<Dim>::feel_air(const Suspension<Dim>& suspension, const Point& point) {
  const MacGrid<Dim>& grid = suspension.grid();
  double smoke = 0, speed = suspension.options().wind.norm();  // beyond the grid there is nothing but wind
  if (grid.box().contains(point.x)) {
    const Stencil<Dim> around = cell_stencil<Dim>(grid, point.x);
    double open = 0;
    for (std::size_t c = 0; c < Stencil<Dim>::n; ++c) {
      if (suspension.ground().volume()[around.point[c]] == 0) continue;  // inside the ground there is no smoke to tell
      smoke += around.weight[c] * suspension.smoke_density(around.point[c]);
      open += around.weight[c];
    }
    if (open > 0) smoke /= open;
    speed = velocity_at<Dim>(grid, suspension.velocity(), point.x).norm();
  }
  const double density = suspension.options().air_density + smoke;
  row_.insert(row_.end(), {smoke, speed, density * speed * speed / pascal_per_kilopascal});
}

template Vec<2> pylon_place<2>(const PylonSection&, const Walls<2>&);
template Vec<3> pylon_place<3>(const PylonSection&, const Walls<3>&);
template class Pylons<2>;
template class Pylons<3>;

}  // namespace spindrift
