#pragma once
/// The particles of the overlap region and the grid points around them, numbered compactly: the exchange costs what the
/// region holds, not what the domain holds.

#include <array>
#include <span>
#include <vector>

#include "core/parallel.hpp"
#include "grid/mac_grid.hpp"
#include "grid/suspension.hpp"
#include "sph/particles.hpp"

namespace spindrift {

/// Grid points that take part, in the order in which particles touch them.
template <int Dim>
class PointSet {
 public:
  /// The compact number of a point, given at its first use.
  std::uint32_t slot(std::size_t point) {
    if (slot_[point] == none) {
      slot_[point] = static_cast<std::uint32_t>(points_.size());
      points_.push_back(point);
    }
    return slot_[point];
  }
  void clear(std::size_t n_points) {
    for (const std::size_t point : points_) slot_[point] = none;
    points_.clear();
    slot_.resize(n_points, none);
  }
  std::span<const std::size_t> points() const { return points_; }
  std::size_t size() const { return points_.size(); }
  std::size_t bytes() const { return spindrift::bytes(points_) + spindrift::bytes(slot_); }

 private:
  static constexpr std::uint32_t none = 0xffffffff;
  std::vector<std::size_t> points_;
  std::vector<std::uint32_t> slot_;
};

/// A particle's share in up to 2^Dim points of a PointSet. Weights sum to 1, or are all 0 where no point is open.
template <int Dim>
struct Shares {
  static constexpr std::size_t n = std::size_t{1} << Dim;
  std::array<std::uint32_t, n> slot;
  std::array<double, n> weight;

  double gather(const std::vector<double>& values) const {
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c)
      if (weight[c] > 0) sum += weight[c] * values[slot[c]];
    return sum;
  }
  void spread(double amount, std::vector<double>& values) const {
    for (std::size_t c = 0; c < n; ++c)
      if (weight[c] > 0) values[slot[c]] += weight[c] * amount;
  }
  bool any() const {
    for (const double w : weight)
      if (w > 0) return true;
    return false;
  }
};

/// Sums over the region's cells while smoke moves.
template <int Dim>
struct SmokeScratch {
  std::vector<double> generated;                  ///< smoke made in the cell [kg]
  std::array<std::vector<double>, Dim> momentum;  ///< that it brings [kg m s^-1]
  std::vector<double> swept;                      ///< sum of S_sec |w| [m^Dim s^-1]
  std::vector<double> taken;                      ///< smoke that sticks, per swept rate
  std::array<std::vector<double>, Dim> taken_momentum;

  void clear(std::size_t n) {
    for (auto* array : {&generated, &swept, &taken}) array->assign(n, 0.0);
    for (auto& axis : momentum) axis.assign(n, 0.0);
    for (auto& axis : taken_momentum) axis.assign(n, 0.0);
  }
};

/// What solve_face_velocity() works with, one entry a face of its axis.
struct DragSystem {
  std::vector<double> lumped, residual, direction, image;
};

/// Working state of one step's exchange. k counts the region's particles, not the dense flow's.
template <int Dim>
struct OverlapRegion {
  std::vector<std::uint32_t> particles;                ///< numbers in the dense flow, ascending
  std::array<std::vector<Shares<Dim>>, Dim> on_faces;  ///< [axis][k]
  std::vector<Shares<Dim>> on_cells;                   ///< [k]
  std::array<PointSet<Dim>, Dim> faces;
  PointSet<Dim> cells;
  std::array<std::vector<double>, Dim>
      face_mass;  ///< m_f = air + smoke of the face's control volume [kg]; infinite in frozen air
  std::array<std::vector<double>, Dim> start_velocity;  ///< u_f before the exchange [m s^-1]
  std::array<std::vector<double>, Dim> face_velocity;   ///< u_f, changed by drag and lift [m s^-1]
  std::array<std::vector<double>, Dim> face_momentum;   ///< given to the face so far [kg m s^-1]

  std::vector<Vec<Dim>> velocity;                      ///< v of the particle, changed by drag and lift [m s^-1]
  std::vector<double> slip;                            ///< |w| before drag [m s^-1]
  std::vector<double> stiffness;                       ///< a of drag_stiffness(); 0 without drag [s m^-1]
  std::vector<double> loading;                         ///< phi, particle over air mass around the particle
  std::vector<double> coupled_mass;                    ///< m gamma of drag [kg]
  std::vector<double> swept;                           ///< S_sec |w| where smoke sticks [m^Dim s^-1], scratch
  std::vector<std::uint8_t> spent;                     ///< scratch
  std::vector<Vec<Dim>> impulse;                       ///< on the particle, of drag or lift [kg m s^-1]
  std::array<std::vector<double>, Dim> particle_mass;  ///< spread to the faces [kg], scratch
  std::array<DragSystem, Dim> drag_system;
  SmokeScratch<Dim> smoke;

  std::size_t size() const { return particles.size(); }
  Vec<Dim> air_velocity(std::size_t k) const {
    Vec<Dim> u;
    for (int axis = 0; axis < Dim; ++axis) u[axis] = on_faces[axis][k].gather(face_velocity[axis]);
    return u;
  }
  std::size_t bytes() const;
};

/// f(axis) for all axes side by side: what one's faces are given does not touch another's.
template <int Dim, class F>
void for_each_axis(F&& f) {
  parallel_for(
      Dim, [&](std::size_t axis) { f(static_cast<int>(axis)); }, 1);
}

/// Numbers the grid points around the overlap particles and reads the air's state there.
/// overlap   in: nonzero for particles of the overlap region, one entry a particle
template <int Dim>
void find_region(OverlapRegion<Dim>& region, const Particles<Dim>& particles, std::span<const std::uint8_t> overlap,
                 const Suspension<Dim>& suspension);

}  // namespace spindrift
