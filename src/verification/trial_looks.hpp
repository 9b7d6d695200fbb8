#pragma once
/// What trials look at when they end, in 2D and 3D.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "verification/stability.hpp"

namespace spindrift {

/// `look` takes a simulation of either dimension.
template <class F>
Trial with_look(Trial one, F look) {
  one.look = {look, look};
  return one;
}

/// The tolerance of the pressure solve is all that quiets snow without friction: a hundredth of its wave speed.
inline constexpr auto quiet = []<int Dim>(const Simulation<Dim>& end) -> std::string {
  const Particles<Dim>& p = end.dense()->particles;
  double squares = 0;
  for (const Vec<Dim>& v : p.velocity) squares += v.squaredNorm();
  const double speed = std::sqrt(squares / static_cast<double>(p.size())), wave = std::sqrt(9.81 * 0.8);
  return speed < 0.02 * wave ? "" : fmt::format("snow moves at {:.2g} of its wave speed", speed / wave);
};

/// Quiet, and what jitters has taken less than a hundredth of the cover with it.
inline constexpr auto quiet_on_cover = []<int Dim>(const Simulation<Dim>& end) -> std::string {
  const double share = end.masses().entrained / (end.masses().entrained + end.cover_mass());
  return share < 0.01 ? quiet(end) : fmt::format("snow at rest has entrained {:.2g} of its cover", share);
};

/// All snow is left of the first obstacle, and all smoke right of it.
inline constexpr auto held_by_the_wall = []<int Dim>(const Simulation<Dim>& end) -> std::string {
  const Box<Dim>& wall = end.walls().obstacles.front();
  for (const Vec<Dim>& x : end.dense()->particles.position)
    if (x[0] > wall.lower[0]) return fmt::format("snow {:.3g} m beyond the wall", x[0] - wall.lower[0]);
  const Suspension<Dim>& air = *end.suspension();
  double all = 0, left = 0;
  for_each_index<Dim>(air.grid().cells, [&](const Index<Dim>& cell) {
    all += air.smoke_mass()[cell];
    if (air.grid().cell_centre(cell)[0] + air.grid().dx < wall.lower[0]) left += air.smoke_mass()[cell];
  });
  return left <= 1e-12 * all ? "" : fmt::format("{:.2g} of the smoke came through the wall", left / all);
};

inline constexpr auto momentum_zero = []<int Dim>(const Simulation<Dim>& end) -> std::string {
  Vec<Dim> sum = Vec<Dim>::Zero();
  double size = 0;
  const Particles<Dim>& p = end.dense()->particles;
  for (std::size_t i = 0; i < p.size(); ++i) {
    sum += p.mass[i] * p.velocity[i];
    size += p.mass[i] * (1 + p.velocity[i].norm());
  }
  return sum.norm() <= 1e-9 * size ? "" : fmt::format("momentum {:.1e} out of nothing", sum.norm() / size);
};

}  // namespace spindrift
