#include "simulation/instruments.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace spindrift {
namespace {

constexpr double head_length = 20;    // [m]: the head is what lies within it of the front
constexpr double front_share = 0.99;  // of the mass lies behind the front

struct MassAt {
  double along, mass;
};

template <int Dim>
Vec<Dim> middle_of_mass(const Particles<Dim>& p) {
  Vec<Dim> moment = Vec<Dim>::Zero();
  double mass = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    moment += p.mass[i] * p.position[i];
    mass += p.mass[i];
  }
  return moment / mass;
}

template <int Dim>
Vec<Dim> highest(const Particles<Dim>& p) {
  return *std::max_element(p.position.begin(), p.position.end(),
                           [](const Vec<Dim>& a, const Vec<Dim>& b) { return a[up_axis<Dim>] < b[up_axis<Dim>]; });
}

/// Area of the ground, in bins of two spacings, under the particles whose numbers `counts` accepts [m^2].
template <int Dim, class F>
double ground_under(const Simulation<Dim>& simulation, F&& counts) {
  const Particles<Dim>& p = simulation.dense()->particles;
  const double size = 2 * simulation.dense()->options().spacing;
  std::vector<GroundBin<Dim>> bins;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (counts(i)) bins.push_back(ground_bin<Dim>(p.position[i].template head<Dim - 1>(), size));
  std::sort(bins.begin(), bins.end());
  bins.erase(std::unique(bins.begin(), bins.end()), bins.end());
  double area = 0;
  for (const GroundBin<Dim>& bin : bins)
    area += ground_bin_area<Dim>(size) * simulation.walls().terrain->area_ratio(ground_bin_centre<Dim>(bin, size));
  return area;
}

double percentile(const std::vector<MassAt>& masses, double share) {
  double total = 0, sum = 0;
  for (const MassAt& m : masses) total += m.mass;
  for (const MassAt& m : masses)
    if ((sum += m.mass) >= share * total) return m.along;
  return masses.empty() ? 0 : masses.back().along;
}

/// Calls f(centre) for the highest cell of the cloud in each column of the grid.
template <int Dim, class F>
void for_each_cloud_top(const Suspension<Dim>& suspension, F&& f) {
  Index<Dim> columns = suspension.grid().cells;
  columns[up_axis<Dim>] = 1;
  for_each_index<Dim>(columns, [&](Index<Dim> i) {
    for (int k = suspension.grid().cells[up_axis<Dim>] - 1; k >= 0; --k) {
      i[up_axis<Dim>] = k;
      const std::size_t cell = flat<Dim>(i, suspension.grid().cells);
      if (suspension.smoke_mass()[cell] == 0 || suspension.smoke_density(cell) < cloud_density) continue;
      f(suspension.grid().cell_centre(i));
      return;
    }
  });
}

}  // namespace

template <int Dim>
double Instruments<Dim>::way(const Walls<Dim>& walls, const Vec<Dim>& x) const {
  if (!walls.terrain) return x[0];
  if (!walls.terrain->height_field()) return walls.terrain->foot(x).place[0];
  return path_ ? path_->along(x.template head<2>()) : (x - *middle_).norm();
}

template <int Dim>
void Instruments<Dim>::prepare(const Simulation<Dim>& simulation) {
  const Particles<Dim>& p = simulation.dense()->particles;
  if (!top_) top_ = highest(p);
  if constexpr (Dim == 3) {
    const Box<3>& domain = simulation.walls().domain;
    const auto& terrain = simulation.walls().terrain;
    if (!terrain || !terrain->height_field()) return;
    if (!middle_) middle_ = middle_of_mass(p);
    if (const auto& path = simulation.scene().path; path && !path_)
      path_.emplace(path->points, *terrain->height_field(), Box<2>{domain.lower.head<2>(), domain.upper.head<2>()});
  }
}

template <int Dim>
void Instruments<Dim>::follow(const Simulation<Dim>& simulation) {
  if (simulation.time() < next_) return;
  next_ = (std::floor(simulation.time() / sample_interval) + 1) * sample_interval;
  const auto& terrain = simulation.walls().terrain;

  if (simulation.dense() && !simulation.dense()->particles.empty()) {
    const Particles<Dim>& p = simulation.dense()->particles;
    prepare(simulation);
    std::vector<double> ways(p.size());
    parallel_for(p.size(), [&](std::size_t i) { ways[i] = way(simulation.walls(), p.position[i]); });
    std::vector<MassAt> masses(p.size());
    for (std::size_t i = 0; i < p.size(); ++i) masses[i] = {ways[i], p.mass[i]};
    std::sort(masses.begin(), masses.end(), [](const MassAt& a, const MassAt& b) { return a.along < b.along; });
    front = percentile(masses, front_share);
    samples_.push_back({simulation.time(), front});
    while (samples_.size() > 2 && simulation.time() - samples_[1].time >= speed_window) samples_.pop_front();
    const double elapsed = simulation.time() - samples_.front().time;
    if (elapsed >= 0.99 * speed_window) {
      front_speed = (front - samples_.front().front) / elapsed;
      front_speed_max = std::max(front_speed_max, front_speed);
    }
    double head_mass = 0;
    const auto in_head = [&](double along) { return along > front - head_length && along <= front; };
    for (const MassAt& m : masses)
      if (in_head(m.along)) head_mass += m.mass;
    const double width = Dim == 3 ? simulation.walls().domain.size()[1] : 1;
    const double area =
        middle_ ? ground_under(simulation, [&](std::size_t i) { return in_head(ways[i]); }) : head_length * width;
    head_depth = head_mass / simulation.dense()->options().density / area;
  }

  if (simulation.suspension()) {
    cloud_height = head_cloud = 0;
    for_each_cloud_top<Dim>(*simulation.suspension(), [&](const Vec<Dim>& x) {
      if (!terrain) {
        cloud_height = std::max(cloud_height, x[up_axis<Dim>] - simulation.walls().domain.lower[up_axis<Dim>]);
        return;
      }
      const Foot<Dim> foot = terrain->foot(x);
      cloud_height = std::max(cloud_height, foot.distance);
      const double along = middle_ ? way(simulation.walls(), x - foot.distance * foot.normal) : foot.place[0];
      if (std::abs(along - front) < head_length) head_cloud = std::max(head_cloud, foot.distance);
    });
    cloud_height_max = std::max(cloud_height_max, cloud_height);
  }
}

template <int Dim>
RunOut Instruments<Dim>::run_out(const Simulation<Dim>& simulation) const {
  if (!top_ || simulation.dense()->particles.empty()) return {};
  struct Piece {
    double away, mass, below;
  };
  const Particles<Dim>& p = simulation.dense()->particles;
  std::vector<Piece> pieces(p.size());
  double total = 0, sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec<Dim> way = p.position[i] - *top_;
    pieces[i] = {way.template head<up_axis<Dim>>().norm(), p.mass[i], -way[up_axis<Dim>]};
    total += p.mass[i];
  }
  std::sort(pieces.begin(), pieces.end(), [](const Piece& a, const Piece& b) { return a.away < b.away; });
  const auto farthest = std::find_if(pieces.begin(), pieces.end() - 1,
                                     [&](const Piece& piece) { return (sum += piece.mass) >= front_share * total; });
  return {farthest->away, farthest->below, std::atan2(farthest->below, farthest->away)};
}

template struct Instruments<2>;
template struct Instruments<3>;

}  // namespace spindrift
