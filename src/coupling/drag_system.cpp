#include "coupling/drag_system.hpp"

namespace spindrift {
namespace {

constexpr double tolerance = 1e-10;
constexpr int max_iterations = 200;

/// image_f = m_f x_f + sum_p w_pf c_p sum_g w_pg x_g
template <int Dim>
void apply(std::vector<double>& image, const std::vector<double>& x, const OverlapRegion<Dim>& region, int axis) {
  const std::vector<double>& mass = region.face_mass[axis];
  for (std::size_t s = 0; s < x.size(); ++s) image[s] = mass[s] * x[s];
  for (std::size_t k = 0; k < region.size(); ++k) {
    const Shares<Dim>& shares = region.on_faces[axis][k];
    shares.spread(region.coupled_mass[k] * shares.gather(x), image);
  }
}

}  // namespace

template <int Dim>
void solve_face_velocity(OverlapRegion<Dim>& region, int axis) {
  auto& [lumped, residual, direction, image] = region.drag_system[axis];
  const std::vector<double>& mass = region.face_mass[axis];
  std::vector<double>& u = region.face_velocity[axis];
  const std::size_t n = u.size();
  lumped = mass;
  residual.resize(n);
  image.resize(n);
  direction.assign(n, 0.0);
  for (std::size_t s = 0; s < n; ++s) residual[s] = mass[s] * u[s];
  for (std::size_t k = 0; k < region.size(); ++k) {
    region.on_faces[axis][k].spread(region.coupled_mass[k], lumped);
    region.on_faces[axis][k].spread(region.coupled_mass[k] * region.velocity[k][axis], residual);
  }
  // The lumped system's answer, the right one where all slips are alike, is the first guess.
  double b_norm2 = 0;
  for (std::size_t s = 0; s < n; ++s) {
    b_norm2 += residual[s] * residual[s] / lumped[s];
    u[s] = residual[s] / lumped[s];
  }
  apply<Dim>(image, u, region, axis);
  const auto take_norm2 = [&] {
    double sum = 0;
    for (std::size_t s = 0; s < n; ++s) sum += residual[s] * residual[s] / lumped[s];
    return sum;
  };
  for (std::size_t s = 0; s < n; ++s) residual[s] -= image[s];
  double r_norm2 = take_norm2(), last = r_norm2;
  for (int i = 0; i < max_iterations && r_norm2 > tolerance * tolerance * b_norm2; ++i) {
    for (std::size_t s = 0; s < n; ++s) direction[s] = residual[s] / lumped[s] + r_norm2 / last * direction[s];
    apply<Dim>(image, direction, region, axis);
    double curvature = 0;
    for (std::size_t s = 0; s < n; ++s) curvature += direction[s] * image[s];
    const double step = r_norm2 / curvature;
    for (std::size_t s = 0; s < n; ++s) {
      u[s] += step * direction[s];
      residual[s] -= step * image[s];
    }
    last = r_norm2;
    r_norm2 = take_norm2();
  }
}

template void solve_face_velocity<2>(OverlapRegion<2>&, int);
template void solve_face_velocity<3>(OverlapRegion<3>&, int);

}  // namespace spindrift
