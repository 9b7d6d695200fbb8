#include "simulation/diagnostics.hpp"

#include "io/component_names.hpp"

namespace spindrift {

template <int Dim>
std::vector<Diagnostic> diagnostics(const Simulation<Dim>& s, const Instruments<Dim>& instruments) {
  std::vector<Diagnostic> row;
  const auto number = [&](std::string_view name, double value) { row.push_back({name, -1, value}); };
  const auto vector = [&](std::string_view name, const Vec<Dim>& value) {
    for (int axis = 0; axis < Dim; ++axis) row.push_back({name, axis, value[axis]});
  };
  const StepReport<Dim>& r = s.report();
  const MassLedger& m = s.masses();
  number("step", static_cast<double>(s.n_steps()));
  number("time_s", s.time());
  number("dt_s", r.dt);
  number("rejected", r.n_rejected);
  number("n_dense", s.dense() ? static_cast<double>(s.dense()->particles.size()) : 0.0);
  number("n_overlap", static_cast<double>(r.n_overlap));
  number("n_core_cells", static_cast<double>(r.n_core_cells));
  number("n_entrained", static_cast<double>(m.n_entrained));
  number("n_vanished", static_cast<double>(m.n_vanished));
  number("n_outflow", static_cast<double>(m.n_outflow));
  number("mass_dense_kg", s.dense_mass());
  number("mass_cover_kg", s.cover_mass());
  number("mass_smoke_kg", s.smoke_mass());
  number("mass_injected_kg", m.injected);
  number("mass_outflow_kg", m.outflow());
  number("mass_deposited_kg", m.deposited);
  number("mass_error", s.mass_error());
  number("smoke_generated_kg", m.generated);
  number("smoke_adhered_kg", m.adhered);
  number("front_m", instruments.front);
  number("front_speed_m_s", instruments.front_speed);
  number("cloud_height_m", instruments.cloud_height);
  number("density_iterations", r.dense.density.iterations);
  number("density_error", r.dense.density.error);
  number("divergence_iterations", r.dense.divergence.iterations);
  number("viscosity_iterations", r.dense.viscosity.iterations);
  number("pressure_iterations", r.suspension.pressure.iterations);
  number("pressure_residual", r.suspension.pressure.residual);
  number("smoke_substeps", r.suspension.smoke_substeps);
  vector("exchange_on_particles", r.exchange_on_particles);
  vector("exchange_on_grid", r.exchange_on_grid);
  vector("exchange_on_fixed_faces", r.exchange_on_fixed_faces);
  vector("gravity_on_dense", r.gravity_on_dense);
  vector("boundary_on_dense", Vec<Dim>(r.dense.boundary_impulse + r.wall_contact));
  vector("bed_friction", r.bed_friction);
  vector("core_reaction", r.core_reaction);
  vector("particle_outflow", r.outflow);
  vector("gravity_on_smoke", r.gravity_on_smoke);
  vector("smoke_source", r.smoke_source);
  vector("ground_on_air", r.ground_on_air);
  vector("forgotten_air", r.forgotten);
  vector("air_core", r.suspension.core);
  vector("air_advection", r.suspension.advection);
  vector("air_smoke_transport", r.suspension.smoke);
  vector("air_diffusion", r.suspension.diffusion);
  vector("air_confinement", r.suspension.confinement);
  vector("air_projection", r.suspension.projection);
  return row;
}

template <int Dim>
std::string heading(const Diagnostic& diagnostic) {
  return component_name(std::string(diagnostic.name), diagnostic.axis < 0 ? 1 : Dim, diagnostic.axis);
}

template std::vector<Diagnostic> diagnostics<2>(const Simulation<2>&, const Instruments<2>&);
template std::vector<Diagnostic> diagnostics<3>(const Simulation<3>&, const Instruments<3>&);
template std::string heading<2>(const Diagnostic&);
template std::string heading<3>(const Diagnostic&);

}  // namespace spindrift
