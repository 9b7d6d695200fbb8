#include "grid/confinement.hpp"

#include <cmath>

#include "core/parallel.hpp"
#include "grid/pack.hpp"

namespace spindrift {
namespace {

/// Air that turns slower than this is left alone [s^-1]: far from the cloud it is the pressure solver's rounding.
constexpr double quiet_vorticity = 0.01;

/// Whether a row of cells has neighbours on all sides.
template <int Dim>
bool is_inner_row(const Index<Dim>& start, const Index<Dim>& shape) {
  for (std::size_t k = 1; k < Dim; ++k)
    if (start[k] == 0 || start[k] + 1 == shape[k]) return false;
  return true;
}

/// Central difference of the velocity at cell centres, along a row of cells, times 4 dx.
template <int Dim>
struct Difference {
  const double *low, *high;  ///< lower faces of the cells on both sides
  std::ptrdiff_t next;       ///< from a cell's lower to its upper face

  Difference(const FaceField<Dim>& u, int component, int axis, const Index<Dim>& start) {
    const Field<Dim>& field = u[static_cast<std::size_t>(component)];
    next = field.stride(component);
    low = &field[start] - field.stride(axis);
    high = &field[start] + field.stride(axis);
  }
  double operator()(int i) const { return (high[i] + high[i + next]) - (low[i] + low[i + next]); }
};

/// omega of the cells of an inner row [s^-1].
template <int Dim>
class RowVorticity;

template <>
class RowVorticity<2> {
 public:
  RowVorticity(const FaceField<2>& u, double dx, const Index<2>& start)
      : quarter_(0.25 / dx), xz_(u, 0, 1, start), zx_(u, 1, 0, start) {}
  Curl<2> operator()(int i) const { return Curl<2>(quarter_ * (xz_(i) - zx_(i))); }

 private:
  double quarter_;
  Difference<2> xz_, zx_;
};

template <>
class RowVorticity<3> {
 public:
  RowVorticity(const FaceField<3>& u, double dx, const Index<3>& start)
      : quarter_(0.25 / dx),
        zy_(u, 2, 1, start),
        yz_(u, 1, 2, start),
        xz_(u, 0, 2, start),
        zx_(u, 2, 0, start),
        yx_(u, 1, 0, start),
        xy_(u, 0, 1, start) {}
  Curl<3> operator()(int i) const {
    return {quarter_ * (zy_(i) - yz_(i)), quarter_ * (xz_(i) - zx_(i)), quarter_ * (yx_(i) - xy_(i))};
  }

 private:
  double quarter_;
  Difference<3> zy_, yz_, xz_, zx_, yx_, xy_;
};

}  // namespace

template <int Dim>
void Confinement<Dim>::find_vorticity(const FaceField<Dim>& u, const MacGrid<Dim>& grid) {
  turning_.assign(size_.n_rows(), 0);
  parallel_for(
      size_.n_rows(),
      [&](std::size_t r) {
        const Index<Dim> start = size_.row_start(r);
        if (!is_inner_row<Dim>(start, grid.cells)) return;
        const int n = grid.cells[0];
        const RowVorticity<Dim> omega(u, grid.dx, start);
        double* size = size_.row(r).data();
        for (int i = 1; i < n - 1; ++i) size[i] = std::sqrt(omega(i).squaredNorm());
        turning_[r] = max_packs(1, n - 1, [&]<class T>(int i) { return load<T>(size + i); }) > quiet_vorticity;
      },
      size_.rows_per_task());
}

/// Of the cells of row r; 0 where the air is quiet or a neighbour has a closed face.
template <int Dim>
void Confinement<Dim>::find_force(std::size_t r, const FaceField<Dim>& u, const FaceField<Dim>& flow_area,
                                  const MacGrid<Dim>& grid, double strength) {
  for (auto& force : force_) std::fill(force.row(r).begin(), force.row(r).end(), 0.0);
  if (!turning_[r]) return;
  const auto open = [&](const Index<Dim>& cell) {
    for (int k = 0; k < Dim; ++k) {
      const Field<Dim>& area = flow_area[static_cast<std::size_t>(k)];
      if (!(area[cell] > 0) || !(area[shifted<Dim>(cell, k, 1)] > 0)) return false;
    }
    return true;
  };
  Index<Dim> i = size_.row_start(r);
  const RowVorticity<Dim> omega(u, grid.dx, i);
  for (i[0] = 1; i[0] + 1 < grid.cells[0]; ++i[0]) {
    if (!(size_[i] > quiet_vorticity)) continue;
    bool inner = open(i);
    Vec<Dim> gradient;
    for (int k = 0; k < Dim; ++k) {
      const Index<Dim> below = shifted<Dim>(i, k, -1), above = shifted<Dim>(i, k, 1);
      inner = inner && open(below) && open(above);
      gradient[k] = size_[above] - size_[below];
    }
    const double steepness = gradient.norm();
    if (!inner || !(steepness > 0)) continue;
    const Vec<Dim> force = strength * grid.dx * cross<Dim>(Vec<Dim>(gradient / steepness), omega(i[0]));
    for (std::size_t k = 0; k < Dim; ++k) force_[k][i] = force[static_cast<int>(k)];
  }
}

template <int Dim>
Vec<Dim> Confinement<Dim>::apply(FaceField<Dim>& u, const FaceField<Dim>& flow_area, const Ground<Dim>& ground,
                                 const Field<Dim>& smoke, const MacGrid<Dim>& grid, double strength, double dt) {
  if (size_.size() == 0) {
    size_ = Field<Dim>(grid.cells);
    force_.fill(size_);
  }
  find_vorticity(u, grid);
  // A face takes half of the force of each cell beside it: rows beside one whose air turns have a share in it.
  const std::size_t row_length = static_cast<std::size_t>(grid.cells[0]);
  const auto any_turns = [&](std::size_t r, bool above_too) {
    bool any = turning_[r] != 0;
    for (int k = 1; k < Dim; ++k) {
      const std::size_t rows = static_cast<std::size_t>(size_.stride(k)) / row_length;
      any = any || (r >= rows && turning_[r - rows]) || (above_too && r + rows < turning_.size() && turning_[r + rows]);
    }
    return any;
  };
  parallel_for(
      size_.n_rows(),
      [&](std::size_t r) {
        if (any_turns(r, true)) find_force(r, u, flow_area, grid, strength);
      },
      size_.rows_per_task());

  const auto push_row = [&](std::size_t r) -> Vec<Dim> {
    Vec<Dim> given = Vec<Dim>::Zero();
    const Index<Dim> start = size_.row_start(r);
    if (!any_turns(r, false) || !is_inner_row<Dim>(start, grid.cells)) return given;
    for (int k = 0; k < Dim; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      const std::ptrdiff_t stride = size_.stride(k);
      double* speed = &u[axis][start];
      const double *area = &flow_area[axis][start], *air = &ground.air_mass()[axis][start];
      const double *force = &force_[axis][start], *mass = &smoke[start];
      for (int i = 1; i + 1 < grid.cells[0]; ++i) {
        const double change = area[i] > 0 ? dt * 0.5 * (force[i] + force[i - stride]) : 0;
        speed[i] += change;
        given[k] += (air[i] + 0.5 * (mass[i] + mass[i - stride])) * change;
      }
    }
    return given;
  };
  return parallel_reduce(
      size_.n_rows(), Vec<Dim>(Vec<Dim>::Zero()),
      [&](std::size_t begin, std::size_t end) {
        Vec<Dim> given = Vec<Dim>::Zero();
        for (std::size_t r = begin; r < end; ++r) given += push_row(r);
        return given;
      },
      [](const Vec<Dim>& a, const Vec<Dim>& b) -> Vec<Dim> { return a + b; }, size_.rows_per_task());
}

template <int Dim>
std::size_t Confinement<Dim>::bytes() const {
  std::size_t n = size_.bytes() + spindrift::bytes(turning_);
  for (const auto& f : force_) n += f.bytes();
  return n;
}

template class Confinement<2>;
template class Confinement<3>;

}  // namespace spindrift
