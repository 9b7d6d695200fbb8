#pragma once
/// The staggered (marker-and-cell) grid: scalars at cell centres, the velocity's component k on the faces normal to k,
/// signed distance to the ground at nodes.

#include <algorithm>
#include <array>
#include <cmath>

#include "grid/field.hpp"

namespace spindrift {

/// Geometry of a uniform staggered grid, or of a window in one: places of the same cell have the same bits in both.
template <int Dim>
struct MacGrid {
  Vec<Dim> origin = Vec<Dim>::Zero();  ///< lower corner of the whole grid [m]
  double dx = 1;                       ///< cell size [m]
  Index<Dim> cells{};                  ///< number of cells along each axis
  Index<Dim> lower{};                  ///< of the window's first cell in the whole grid

  double cell_volume() const { return std::pow(dx, Dim); }
  double face_area() const { return std::pow(dx, Dim - 1); }
  Index<Dim> faces(int axis) const { return shifted<Dim>(cells, axis, 1); }
  Index<Dim> nodes() const {
    Index<Dim> n = cells;
    for (int& k : n) ++k;
    return n;
  }
  Vec<Dim> cell_centre(const Index<Dim>& i) const { return point(i, Vec<Dim>::Constant(0.5)); }
  Vec<Dim> face_centre(int axis, const Index<Dim>& i) const { return point(i, face_offset(axis)); }
  Vec<Dim> node(const Index<Dim>& i) const { return point(i, Vec<Dim>::Zero()); }
  Vec<Dim> face_offset(int axis) const {
    Vec<Dim> o = Vec<Dim>::Constant(0.5);
    o[axis] = 0;
    return o;
  }
  Box<Dim> box() const { return {node({}), node(cells)}; }
  /// The cell that holds x; may lie outside the grid.
  Index<Dim> cell_of(const Vec<Dim>& x) const {
    Index<Dim> i;
    for (int k = 0; k < Dim; ++k) i[k] = static_cast<int>(std::floor((x[k] - origin[k]) / dx)) - lower[k];
    return i;
  }

 private:
  Vec<Dim> point(const Index<Dim>& i, const Vec<Dim>& offset) const {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = origin[k] + dx * (lower[k] + i[k] + offset[k]);
    return x;
  }
};

/// Of two windows in one whole grid.
template <int Dim>
bool same_window(const MacGrid<Dim>& a, const MacGrid<Dim>& b) {
  return a.lower == b.lower && a.cells == b.cells;
}

/// (Bi/tri)linear interpolation stencil at a position: 2^Dim points and their weights, which sum to 1. At the border
/// the points are clamped, so a weight may repeat a point. The same stencil gathers and spreads.
template <int Dim>
struct Stencil {
  static constexpr int n = 1 << Dim;
  std::array<std::size_t, n> point;  ///< flat numbers in a field of the given shape
  std::array<double, n> weight;

  /// shape, offset: of the field's points in cells (0.5: centres along that axis, 0: faces or nodes).
  Stencil(const MacGrid<Dim>& grid, const Index<Dim>& shape, const Vec<Dim>& offset, const Vec<Dim>& x) {
    Index<Dim> base;
    Vec<Dim> fraction;
    for (int k = 0; k < Dim; ++k) {
      const double s = std::clamp((x[k] - grid.origin[k]) / grid.dx - offset[k] - grid.lower[k], 0.0, shape[k] - 1.0);
      base[k] = std::min(static_cast<int>(s), std::max(shape[k] - 2, 0));
      fraction[k] = s - base[k];
    }
    for (int corner = 0; corner < n; ++corner) {
      Index<Dim> i = base;
      double w = 1;
      for (int k = 0; k < Dim; ++k) {
        const int bit = (corner >> k) & 1;
        i[k] = std::min(base[k] + bit, shape[k] - 1);
        w *= bit ? fraction[k] : 1 - fraction[k];
      }
      point[static_cast<std::size_t>(corner)] = flat<Dim>(i, shape);
      weight[static_cast<std::size_t>(corner)] = w;
    }
  }

  template <class T>
  double gather(const Field<Dim, T>& field) const {
    double sum = 0;
    for (std::size_t c = 0; c < n; ++c) sum += weight[c] * field[point[c]];
    return sum;
  }
};

template <int Dim>
Stencil<Dim> cell_stencil(const MacGrid<Dim>& grid, const Vec<Dim>& x) {
  return Stencil<Dim>(grid, grid.cells, Vec<Dim>::Constant(0.5), x);
}
template <int Dim>
Stencil<Dim> face_stencil(const MacGrid<Dim>& grid, int axis, const Vec<Dim>& x) {
  return Stencil<Dim>(grid, grid.faces(axis), grid.face_offset(axis), x);
}

/// One scalar field a face direction.
template <int Dim, class T = double>
using FaceField = std::array<Field<Dim, T>, Dim>;

template <int Dim, class T = double>
FaceField<Dim, T> make_face_field(const MacGrid<Dim>& grid, T value = T{}) {
  FaceField<Dim, T> f;
  for (int axis = 0; axis < Dim; ++axis) f[axis] = Field<Dim, T>(grid.faces(axis), value);
  return f;
}

/// Velocity at x by (bi/tri)linear interpolation of each component on its own faces.
template <int Dim>
Vec<Dim> velocity_at(const MacGrid<Dim>& grid, const FaceField<Dim>& u, const Vec<Dim>& x) {
  Vec<Dim> v;
  for (int axis = 0; axis < Dim; ++axis) v[axis] = face_stencil<Dim>(grid, axis, x).gather(u[axis]);
  return v;
}

}  // namespace spindrift
