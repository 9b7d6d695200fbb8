#include "verification/energy.hpp"

namespace spindrift {

template <int Dim>
double mechanical_energy(const Simulation<Dim>& s) {
  const Vec<Dim> g = s.gravity();
  const Box<Dim>& box = s.walls().domain;
  Vec<Dim> lowest;
  for (int k = 0; k < Dim; ++k) lowest[k] = g[k] > 0 ? box.upper[k] : box.lower[k];
  const auto height_energy = [&](double mass, const Vec<Dim>& x) { return mass * g.dot(lowest - x); };
  double energy = 0;
  if (s.dense()) {
    const Particles<Dim>& p = s.dense()->particles;
    for (std::size_t i = 0; i < p.size(); ++i)
      energy += p.mass[i] * p.velocity[i].squaredNorm() / 2 + height_energy(p.mass[i], p.position[i]);
  }
  if (s.cover()) {
    const Particles<Dim>& p = s.cover()->particles;
    for (std::size_t i = 0; i < p.size(); ++i) energy += height_energy(p.mass[i], p.position[i]);
  }
  if (!s.suspension()) return energy;
  const Suspension<Dim>& air = *s.suspension();
  for (std::size_t c = 0; c < air.smoke_mass().size(); ++c)
    energy += height_energy(air.smoke_mass()[c], air.grid().cell_centre(unflat<Dim>(c, air.grid().cells)));
  for (int axis = 0; axis < Dim; ++axis) {
    const auto& u = air.velocity()[static_cast<std::size_t>(axis)];
    for (std::size_t f = 0; f < u.size(); ++f) energy += air.face_mass(axis, f) * u[f] * u[f] / 2;
  }
  return energy;
}

template double mechanical_energy<2>(const Simulation<2>&);
template double mechanical_energy<3>(const Simulation<3>&);

}  // namespace spindrift
