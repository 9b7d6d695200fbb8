#include "simulation/initial_flow.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulation/scene_vectors.hpp"

namespace spindrift {
namespace {

/// X(s) = s^2 (1 - s)^2 and X'(s); at most 1/16 and 1 / sqrt(27).
double hill(double s) {
  return s * s * (1 - s) * (1 - s);
}
double slope_of_hill(double s) {
  return 2 * s * (1 - s) * (1 - 2 * s);
}

/// Samples velocity(place), of a place from the grid's lower corner [m].
template <int Dim, class F>
FaceField<Dim> sampled(const MacGrid<Dim>& grid, const Walls<Dim>& walls, F&& velocity) {
  FaceField<Dim> u = make_face_field<Dim>(grid);
  for (int axis = 0; axis < Dim; ++axis) {
    const auto k = static_cast<std::size_t>(axis);
    for_each_index<Dim>(u[k].shape(), [&](const Index<Dim>& face) {
      const bool closed = (face[k] == 0 && walls.sides[k][0] == Side::closed) ||
                          (face[k] == grid.cells[k] && walls.sides[k][1] == Side::closed);
      const Vec<Dim> place = grid.face_centre(axis, face) - grid.origin;
      u[k][face] = closed ? 0 : velocity(place)[axis];
    });
  }
  return u;
}

}  // namespace

template <int Dim>
FaceField<Dim> initial_flow(const SuspensionSection& suspension, const MacGrid<Dim>& grid, const Walls<Dim>& walls) {
  constexpr int vertical = up_axis<Dim>;
  const Vec<Dim> size = grid.box().size();
  const double speed = suspension.initial_speed, lx = size[0], lz = size[vertical];
  // velocity(x, z) is (u, w)
  const auto in_plane = [&](auto&& velocity) {
    return sampled<Dim>(grid, walls, [&](const Vec<Dim>& place) {
      const Vec<2> uw = velocity(place[0], place[vertical]);
      Vec<Dim> v = Vec<Dim>::Zero();
      v[0] = uw[0];
      v[vertical] = uw[1];
      return v;
    });
  };
  if (suspension.initial_flow == "vortices") {
    const double kx = std::numbers::pi / lx, kz = std::numbers::pi / lz;
    return in_plane([=](double x, double z) {
      return Vec<2>(speed * std::sin(kx * x) * std::cos(kz * z),
                    -speed * (lz / lx) * std::cos(kx * x) * std::sin(kz * z));
    });
  }
  if (suspension.initial_flow == "rotation") {
    const double rate = 2 * speed / lx;
    return in_plane([=](double x, double z) { return Vec<2>(-rate * (z - lz / 2), rate * (x - lx / 2)); });
  }
  if (suspension.initial_flow == "potential") {
    const double scale = 48 * std::numbers::sqrt3 * speed * std::min(lx, lz);
    return in_plane([=](double x, double z) {
      return Vec<2>(scale / lx * slope_of_hill(x / lx) * hill(z / lz),
                    scale / lz * hill(x / lx) * slope_of_hill(z / lz));
    });
  }
  const Vec<Dim> wind = vector_or<Dim>(suspension.wind);
  return sampled<Dim>(grid, walls, [&](const Vec<Dim>&) { return wind; });
}

template FaceField<2> initial_flow<2>(const SuspensionSection&, const MacGrid<2>&, const Walls<2>&);
template FaceField<3> initial_flow<3>(const SuspensionSection&, const MacGrid<3>&, const Walls<3>&);

}  // namespace spindrift
