#pragma once
/// Vectors, indices and boxes in Dim dimensions. The last axis points up; in 2D the axes are x and z.

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>
#include <cstddef>
#include <cstdint>

namespace spindrift {

template <int Dim>
using Vec = Eigen::Matrix<double, Dim, 1>;
template <int Dim>
using Mat = Eigen::Matrix<double, Dim, Dim>;

/// Vorticity: one out-of-plane component in 2D, three in 3D.
template <int Dim>
inline constexpr int n_curl = Dim == 2 ? 1 : 3;
template <int Dim>
using Curl = Eigen::Matrix<double, n_curl<Dim>, 1>;

template <int Dim>
inline constexpr int up_axis = Dim - 1;

template <int Dim>
Vec<Dim> up() {
  return Vec<Dim>::Unit(up_axis<Dim>);
}

/// w x omega. In 2D the plane is x-z with y into the page, so omega = du_x/dz - du_z/dx is the y component and
/// (w x omega) = (-w_z omega, w_x omega).
template <int Dim>
Vec<Dim> cross(const Vec<Dim>& w, const Curl<Dim>& omega) {
  if constexpr (Dim == 2) {
    return {-w[1] * omega[0], w[0] * omega[0]};
  } else {
    return w.cross(omega);
  }
}

/// A position in a grid of cells; the first axis runs fastest in memory.
template <int Dim>
using Index = std::array<int, Dim>;

template <int Dim>
std::size_t count(const Index<Dim>& shape) {
  std::size_t n = 1;
  for (int k = 0; k < Dim; ++k) n *= static_cast<std::size_t>(shape[k]);
  return n;
}

template <int Dim>
std::size_t flat(const Index<Dim>& i, const Index<Dim>& shape) {
  std::size_t n = static_cast<std::size_t>(i[Dim - 1]);
  for (int k = Dim - 2; k >= 0; --k) n = n * static_cast<std::size_t>(shape[k]) + static_cast<std::size_t>(i[k]);
  return n;
}

template <int Dim>
Index<Dim> unflat(std::size_t n, const Index<Dim>& shape) {
  Index<Dim> i;
  for (int k = 0; k < Dim; ++k) {
    i[k] = static_cast<int>(n % static_cast<std::size_t>(shape[k]));
    n /= static_cast<std::size_t>(shape[k]);
  }
  return i;
}

/// The neighbour of `i` by `step` along `axis`.
template <int Dim>
Index<Dim> shifted(Index<Dim> i, int axis, int step) {
  i[axis] += step;
  return i;
}

template <int Dim>
bool inside(const Index<Dim>& i, const Index<Dim>& shape) {
  for (int k = 0; k < Dim; ++k)
    if (i[k] < 0 || i[k] >= shape[k]) return false;
  return true;
}

/// Calls f(Index<Dim>) for every index of `shape`, first axis fastest.
template <int Dim, class F>
void for_each_index(const Index<Dim>& shape, F&& f) {
  const std::size_t n = count<Dim>(shape);
  Index<Dim> i{};
  for (std::size_t k = 0; k < n; ++k) {
    f(i);
    for (int axis = 0; axis < Dim; ++axis) {
      if (++i[axis] < shape[axis]) break;
      i[axis] = 0;
    }
  }
}

/// An axis-aligned box, lower and upper corner [m].
template <int Dim>
struct Box {
  Vec<Dim> lower = Vec<Dim>::Zero();
  Vec<Dim> upper = Vec<Dim>::Zero();

  Vec<Dim> size() const { return upper - lower; }
  bool contains(const Vec<Dim>& x) const {
    return (x.array() >= lower.array()).all() && (x.array() <= upper.array()).all();
  }
};

/// What two boxes have in common; of negative size along some axis where they have nothing.
template <int Dim>
Box<Dim> common(const Box<Dim>& a, const Box<Dim>& b) {
  return {a.lower.cwiseMax(b.lower), a.upper.cwiseMin(b.upper)};
}

}  // namespace spindrift
