#include "simulation/rasters.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "simulation/instruments.hpp"
#include "simulation/setup.hpp"

namespace spindrift {
namespace {

constexpr double pascal_per_kilopascal = 1000;
constexpr double decimals = 1e4;

/// When what moves at `speed` has gone `way` from `now` on, or sooner.
double next_sample(double now, double way, double speed) {
  return now + (speed > 0 ? std::min(way / speed, Rasters::longest_interval) : Rasters::longest_interval);
}

Vec<2> seen_from_above(const Foot<3>& foot, const Vec<3>& x) {
  return (x - foot.distance * foot.normal).head<2>();
}

}  // namespace

Rasters::Rasters(const Simulation<3>& simulation)
    : empty_(empty_map(simulation.scene())), cells_(cells_of(empty_, simulation.scene().origin)), blocks_(cells_) {
  if (const auto& dense = simulation.dense()) {
    const double least = 2 * dense->options().spacing;
    const int side = std::max(1, static_cast<int>(std::ceil(least / cells_.dx * (1 - 1e-9))));
    blocks_.dx = side * cells_.dx;
    for (int& n : blocks_.cells) n = (n + side - 1) / side;
    area_ = ground_areas(*simulation.walls().terrain, blocks_, 2 * side);
    least_thickness_ = dense->options().spacing / 8;
    sums_.resize(area_.size());
    peaks_.thickness.resize(area_.size());
    peaks_.speed.resize(area_.size());
    peaks_.pressure.resize(area_.size());
    if (simulation.cover()) taken_.resize(area_.size());
  }
  if (simulation.suspension()) {
    air_ = make_grid<3>(simulation.scene(), simulation.walls());
    columns_ = {air_.origin.head<2>(), air_.dx, {air_.cells[0], air_.cells[1]}};
    cloud_.densest.resize(count<2>(columns_.cells));
    cloud_.highest.resize(cloud_.densest.size(), -1);
  }
}

void Rasters::follow(const Simulation<3>& simulation) {
  const double now = simulation.time();
  if (simulation.taken()) add_taken(*simulation.taken(), *simulation.walls().terrain);
  if (simulation.dense() && now >= next_snow_) {
    next_snow_ = next_sample(now, blocks_.dx / 2, sum_up(simulation));
    raise(peaks_);
  }
  if (simulation.suspension() && now >= next_air_) {
    next_air_ = next_sample(now, columns_.dx, simulation.suspension()->max_speed());
    raise(cloud_, *simulation.suspension());
  }
}

/// Sums of the snow as it stands; returns its largest speed [m/s].
double Rasters::sum_up(const Simulation<3>& simulation) {
  const Particles<3>& p = simulation.dense()->particles;
  const Terrain<3>& terrain = *simulation.walls().terrain;
  constexpr double anywhere = std::numeric_limits<double>::infinity();
  const double certain = simulation.dense()->options().support_radius;  // as the flow itself sees the ground
  places_.resize(p.size());
  parallel_for(p.size(), [&](std::size_t i) {
    places_[i] = seen_from_above(terrain.foot(p.position[i], anywhere, certain), p.position[i]);
  });
  for (const std::uint32_t block : touched_) sums_[block] = {};
  touched_.clear();
  double fastest = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Stencil<2> around = cell_stencil<2>(blocks_, places_[i]);
    for (std::size_t c = 0; c < Stencil<2>::n; ++c) {
      const double weight = around.weight[c];
      if (weight == 0) continue;
      Sum& sum = sums_[around.point[c]];
      if (sum.volume == 0) touched_.push_back(static_cast<std::uint32_t>(around.point[c]));
      sum.volume += weight * p.volume[i];
      sum.mass += weight * p.mass[i];
      sum.momentum += weight * p.mass[i] * p.velocity[i];
    }
    fastest = std::max(fastest, p.velocity[i].squaredNorm());
  }
  return std::sqrt(fastest);
}

void Rasters::raise(Peaks& peaks) const {
  for (const std::uint32_t block : touched_) {
    const Sum& sum = sums_[block];
    const double thickness = sum.volume / area_[block];
    peaks.thickness[block] = std::max(peaks.thickness[block], thickness);
    if (thickness < least_thickness_) continue;
    const Vec<3> velocity = sum.momentum / sum.mass;
    const double pressure = sum.mass / sum.volume * velocity.squaredNorm() / pascal_per_kilopascal;
    peaks.speed[block] = std::max(peaks.speed[block], velocity.norm());
    peaks.pressure[block] = std::max(peaks.pressure[block], pressure);
  }
}

void Rasters::raise(Cloud& cloud, const Suspension<3>& suspension) const {
  const Index<3>&cells = suspension.grid().cells, &lower = suspension.grid().lower;
  const auto smoke = suspension.smoke_mass().values();
  const auto look_at_row = [&](std::size_t row) {
    const int j = static_cast<int>(row);
    const std::size_t column = flat<2>({lower[0], lower[1] + j}, columns_.cells);
    double* const densest = cloud.densest.data() + column;
    int* const highest = cloud.highest.data() + column;
    for (int k = 0; k < cells[2]; ++k) {
      const std::size_t first = flat<3>({0, j, k}, cells);
      for (std::size_t i = 0; i < static_cast<std::size_t>(cells[0]); ++i) {
        if (smoke[first + i] == 0) continue;
        const double density = suspension.smoke_density(first + i);
        densest[i] = std::max(densest[i], density);
        if (density >= cloud_density) highest[i] = std::max(highest[i], lower[2] + k);
      }
    }
  };
  parallel_for(static_cast<std::size_t>(cells[1]), look_at_row, 1);
}

void Rasters::add_taken(const Particles<3>& taken, const Terrain<3>& terrain) {
  for (std::size_t i = 0; i < taken.size(); ++i) {
    const Vec<3>& x = taken.position[i];
    const Stencil<2> around = cell_stencil<2>(blocks_, seen_from_above(terrain.foot(x), x));
    for (std::size_t c = 0; c < Stencil<2>::n; ++c) taken_[around.point[c]] += around.weight[c] * taken.volume[i];
  }
}

Raster Rasters::raster(const std::string& name, const MacGrid<2>& from, std::span<const double> values) const {
  Raster raster{name, empty_};
  raster.map.z = on_cells(from, values, cells_);
  for (double& z : raster.map.z) z = std::round(z * decimals) / decimals;
  return raster;
}

std::vector<Raster> Rasters::maps(const Simulation<3>& simulation) {
  std::vector<Raster> all;
  const auto add = [&](const char* name, const MacGrid<2>& from, std::span<const double> values) {
    all.push_back(raster(name, from, values));
  };
  if (simulation.dense()) {
    sum_up(simulation);
    Peaks peaks = peaks_;
    raise(peaks);
    add("flow_thickness", blocks_, peaks.thickness);
    add("flow_speed", blocks_, peaks.speed);
    add("flow_pressure", blocks_, peaks.pressure);
    std::vector<double> thickness(area_.size());
    for (const std::uint32_t block : touched_) thickness[block] = sums_[block].volume / area_[block];
    add("deposit", blocks_, thickness);
  }
  if (simulation.cover()) {
    std::vector<double> thickness(area_.size());
    for (std::size_t block = 0; block < thickness.size(); ++block) thickness[block] = taken_[block] / area_[block];
    add("erosion", blocks_, thickness);
  }
  if (const auto& air = simulation.suspension()) {
    Cloud cloud = cloud_;
    raise(cloud, *air);
    std::vector<double> height(cloud.highest.size());
    parallel_for(height.size(), [&](std::size_t column) {
      if (cloud.highest[column] < 0) return;
      const Index<2> at = unflat<2>(column, columns_.cells);
      const Vec<3> top = air_.cell_centre({at[0], at[1], cloud.highest[column]});
      height[column] = std::max(0.0, simulation.walls().terrain->foot(top).distance);
    });
    add("smoke_density", columns_, cloud.densest);
    add("cloud_height", columns_, height);
  }
  return all;
}

std::size_t Rasters::bytes() const {
  return spindrift::bytes(area_, taken_, cloud_.densest) +
         spindrift::bytes(peaks_.thickness, peaks_.speed, peaks_.pressure) + spindrift::bytes(sums_) +
         spindrift::bytes(touched_) + spindrift::bytes(places_) + spindrift::bytes(cloud_.highest);
}

}  // namespace spindrift
