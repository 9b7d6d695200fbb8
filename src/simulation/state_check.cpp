#include "simulation/state_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

template <int Dim>
std::string place(const Vec<Dim>& x) {
  std::string text = fmt::format("({:.6g}", x[0]);
  for (int k = 1; k < Dim; ++k) text += fmt::format(", {:.6g}", x[k]);
  return text + ") m";
}

[[noreturn]] void fail(const std::string& what, const StepStamp& stamp) {
  throw Error(ExitCode::unstable, fmt::format("unstable: {} in step {} from t = {:.6g} s with dt = {:.3g} s", what,
                                              stamp.step + 1, stamp.time, stamp.dt));
}

template <int Dim>
std::string fault(const Particles<Dim>& p, std::size_t i, double fastest) {
  if (!p.position[i].allFinite()) return "position is not finite";
  if (!p.velocity[i].allFinite()) return "velocity is not finite";
  if (!(p.mass[i] > 0)) return fmt::format("mass is {:.3g} kg", p.mass[i]);
  if (!(p.volume[i] > 0)) return fmt::format("volume is {:.3g}", p.volume[i]);
  if (!std::isfinite(p.mass[i] + p.volume[i] + p.pressure[i])) return "mass, volume or pressure is not finite";
  if (!(p.velocity[i].norm() <= fastest))
    return fmt::format("speed {:.4g} m/s is a runaway (limit {:.4g})", p.velocity[i].norm(), fastest);
  return {};
}

}  // namespace

double runaway_speed(double length, double gravity, double first_speed) {
  return std::max({300.0, 10 * first_speed, 10 * std::sqrt(2 * gravity * length)});
}

template <int Dim>
void check_particles(const Particles<Dim>& p, double fastest, const StepStamp& stamp) {
  const double worst = parallel_max(p.size(), 0, [&](std::size_t i) {
    const bool sound = p.position[i].allFinite() && p.mass[i] > 0 && p.volume[i] > 0 &&
                       std::isfinite(p.mass[i] + p.volume[i] + p.pressure[i]);
    return sound ? p.velocity[i].squaredNorm() : std::numeric_limits<double>::quiet_NaN();
  });
  if (worst <= fastest * fastest) return;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const std::string what = fault(p, i, fastest);
    if (!what.empty()) fail(fmt::format("particle {} at {}: {}", p.id[i], place<Dim>(p.position[i]), what), stamp);
  }
  fail("the particles' state is not finite", stamp);
}

template <int Dim>
void check_suspension(const Suspension<Dim>& suspension, double fastest, const StepStamp& stamp) {
  const Field<Dim>& smoke = suspension.smoke_mass();
  const double total = parallel_sum(smoke.size(), 0.0, [&](std::size_t cell) {
    return smoke[cell] >= 0 ? smoke[cell] : std::numeric_limits<double>::quiet_NaN();
  });
  if (suspension.max_speed() <= fastest && std::isfinite(total)) return;
  const MacGrid<Dim>& grid = suspension.grid();
  for (int axis = 0; axis < Dim; ++axis) {
    const auto& u = suspension.velocity()[axis];
    for (std::size_t f = 0; f < u.size(); ++f) {
      if (std::abs(u[f]) <= fastest) continue;
      const Vec<Dim> x = grid.face_centre(axis, unflat<Dim>(f, grid.faces(axis)));
      fail(fmt::format("air velocity at {}: component {} is {:.4g} m/s", place<Dim>(x), axis, u[f]), stamp);
    }
  }
  for (std::size_t c = 0; c < smoke.size(); ++c)
    if (!(smoke[c] >= 0) || !std::isfinite(smoke[c]))
      fail(fmt::format("smoke at {} is {:.4g} kg", place<Dim>(grid.cell_centre(unflat<Dim>(c, grid.cells))), smoke[c]),
           stamp);
}

#define INSTANTIATE(Dim)                                                               \
  template void check_particles<Dim>(const Particles<Dim>&, double, const StepStamp&); \
  template void check_suspension<Dim>(const Suspension<Dim>&, double, const StepStamp&);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
