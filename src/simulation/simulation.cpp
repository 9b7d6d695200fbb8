#include "simulation/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "simulation/local_origin.hpp"
#include "simulation/release.hpp"
#include "simulation/state_check.hpp"

namespace spindrift {
namespace {

constexpr double shortest_step = 1e-7;  // [s]: a limit below ends the run, it is never clamped

template <int Dim>
double total_mass(const Particles<Dim>& particles) {
  return parallel_sum(particles.size(), 0.0, [&](std::size_t i) { return particles.mass[i]; });
}

/// Impulse of the bed on each particle along the bed's normal in the last pressure solves [kg m s^-1].
template <int Dim>
void find_normal_impulse(std::vector<double>& impulse, const DenseFlow<Dim>& dense, const Columns<Dim>& columns,
                         double dt) {
  const Particles<Dim>& p = dense.particles;
  impulse.resize(p.size());
  parallel_for(p.size(), [&](std::size_t i) {
    const double into_bed = -dense.neighbours().boundary_gradient()[i].dot(columns.foot[i].normal);
    impulse[i] = std::max(0.0, 2 * dt * p.volume[i] * p.pressure[i] * into_bed);
  });
}

}  // namespace

template <int Dim>
Simulation<Dim>::Simulation(const Scene& scene)
    : scene_(around_local_origin(scene)),
      gravity_(make_gravity<Dim>(scene_)),
      walls_(make_walls<Dim>(scene_)),
      dense_(make_dense_flow<Dim>(scene_, walls_)),
      bed_friction_(make_bed_friction(scene_)),
      tiles_(make_tiles<Dim>(scene_, walls_)),
      coupling_(make_coupling(scene_)) {
  if (tiles_) {
    mark_tiles();
    const MacGrid<Dim> window = tiles_->window();
    suspension_ = make_suspension<Dim>(scene_, walls_, window, tiles_->sides(window));
  } else if (scene_.suspension) {
    suspension_ = make_suspension<Dim>(scene_, walls_, make_grid<Dim>(scene_, walls_), walls_.sides);
  }
  cover_ = make_cover<Dim>(scene_, walls_, dense_ ? dense_->particles.size() : 0);
  if (const auto options = make_entrainment(scene_)) entrainment_.emplace(*options);
  lay_first_cover();
  if (suspension_ && (walls_.terrain || !walls_.obstacles.empty())) {
    ground_.emplace(walls_, suspension_->grid(), cover_ ? &*cover_ : nullptr);
    suspension_->set_ground(ground_->node_distance());
  }
  if (suspension_ && !scene_.smoke.empty()) suspension_->set_smoke_mass(initial_smoke<Dim>(scene_, *suspension_));
  if (suspension_ && std::ranges::any_of(scene_.smoke, [](const SmokeSection& s) { return s.rate > 0; }))
    smoke_source_.emplace(smoke_rate<Dim>(scene_, *suspension_));
  if (tiles_) suspension_->set_still(tiles_->still(suspension_->grid()));
  if (suspension_ && dense_)
    n_interior_ = interior_number_density<Dim>(dense_->options().spacing, dense_->options().support_radius);
  n_dense_initial_ = dense_ ? dense_->particles.size() : 0;
  if (dense_)
    for (const Vec<Dim>& v : dense_->particles.velocity) first_speed_ = std::max(first_speed_, v.norm());
  if (suspension_) first_speed_ = std::max(first_speed_, suspension_->max_speed());
  masses_.initial = dense_mass() + cover_mass() + smoke_mass();
}

// Paper Fig. 3.
template <int Dim>
void Simulation<Dim>::try_step(const TimeStep& step) {
  report_ = {};
  report_.dt = dt_ = step.dt;
  report_.limiter = step.limiter;
  report_.n_rejected = std::exchange(back_off_.n_rejected, 0);
  if (tiles_) follow_cloud();
  predict_velocities();  // gravity: the f of Eq. (2), of the smoke by Eqs. (7)-(9)
  exchange_layers();     // 1: Secs. 4.1, 4.4.1, Eqs. (5), (6), (10)-(13)
  inject_smoke();
  advance_dense_flow();  // 2: Secs. 3.2, 4.3, Eq. (4)
  advance_suspension();  // 3: Secs. 3.1, 4.2, Eqs. (1)-(3), the swirl of Eq. (8)
  entrain_cover();       // 4: Sec. 4.4.2, Eqs. (14)-(16)
  remove_what_left();
  if (spoil_trial_) spoil_trial_(*this);
  check_state();
  time_ += dt_;
  ++n_steps_;
  back_off_.count_good_step();
}

/// One step for all layers, from the tightest limit.
template <int Dim>
typename Simulation<Dim>::TimeStep Simulation<Dim>::choose_time_step() const {
  TimeStep step{scene_.scene.max_step, "longest step"};
  const auto limit = [&](double dt, std::string_view name) {
    if (dt < step.dt) step = {dt, name};
  };
  if (dense_ && !dense_->particles.empty()) {
    limit(dense_->time_step_limit(scene_.dense_flow->cfl, gravity_.norm()),
          dense_->options().solver == DenseSolver::wcsph ? "particles or sound" : "particles");
  }
  if (suspension_) {
    const double speed = suspension_->max_speed();
    const double way = scene_.suspension->cfl * suspension_->grid().dx, g = gravity_.norm();
    if (speed > 0) limit(way / speed, "air");
    if (g > 0 && !scene_.suspension->frozen) limit(std::sqrt(way / g), "air");  // for a start from rest
  }
  if (!(step.dt >= shortest_step))
    throw Error(ExitCode::unstable,
                fmt::format("unstable: the time step fell to {:.3g} s (limit: {}) in step {} at t = {:.6g} s", step.dt,
                            step.limiter, n_steps_ + 1, time_));
  if (back_off_.halvings > 0) step = {step.dt * back_off_.factor(), "rejection"};
  return step;
}

/// How far the dense flow looks for the ground below it [m]: for columns all the way, else as far as walls act.
template <int Dim>
double Simulation<Dim>::ground_reach() const {
  if (bed_friction_ || entrainment_) return std::numeric_limits<double>::infinity();
  return dense_->options().support_radius;
}

/// Gravity on both media; the later stages add none.
template <int Dim>
void Simulation<Dim>::predict_velocities() {
  if (dense_) {
    dense_->sort(walls_, stages_, ground_reach());
    wake_cover_near_snow(dense_->feet());
    dense_->find_neighbours(walls_, cover_view(), stages_);
    Particles<Dim>& p = dense_->particles;
    parallel_for(p.size(), [&](std::size_t i) { p.velocity[i] += dt_ * gravity_; });
    report_.gravity_on_dense = dt_ * total_mass(p) * gravity_;
  }
  if (suspension_) report_.gravity_on_smoke = suspension_->add_gravity(dt_);
}

/// Which particles lie in the overlap region, and what they and the air give each other.
template <int Dim>
void Simulation<Dim>::exchange_layers() {
  if (!dense_ || !suspension_) return;
  Particles<Dim>& p = dense_->particles;
  {
    const auto timed = stages_.time("overlap");
    const double fraction = scene_.coupling ? scene_.coupling->overlap_fraction : CouplingSection{}.overlap_fraction;
    classify_overlap<Dim>(overlap_, *dense_, cover_view(), walls_, fraction, n_interior_);
  }
  if (!coupling_) return;
  const auto timed = stages_.time("exchange");
  const CouplingOptions& c = *coupling_;
  exchange_.clear(p.size());
  find_region<Dim>(region_, p, overlap_, *suspension_);
  report_.n_overlap = region_.size();
  if (c.drag)
    exchange_drag<Dim>(region_, exchange_, p, *c.drag, c.smoke.radius, c.air_density, dt_, gravity_.squaredNorm() > 0);
  if (c.lift) exchange_lift<Dim>(region_, exchange_, p, *suspension_, *c.lift, dt_);
  if (scene_.suspension->frozen) hold_faces<Dim>(region_, exchange_);
  if (c.smoke.generation || c.smoke.adhesion) exchange_smoke<Dim>(region_, exchange_, p, *suspension_, c.smoke, dt_);
  book_faces<Dim>(region_, exchange_);

  report_.exchange_on_particles = momentum_on_particles(exchange_);
  report_.exchange_on_fixed_faces = exchange_.on_fixed_faces;
  masses_.generated += exchange_.generated;
  masses_.adhered += exchange_.adhered;
  report_.exchange_on_grid = suspension_->apply(exchange_.on_grid);
  apply_sources(p, exchange_.on_particles);
}

template <int Dim>
void Simulation<Dim>::inject_smoke() {
  if (!smoke_source_) return;
  const auto timed = stages_.time("smoke_source");
  report_.smoke_source = suspension_->apply(smoke_source_->over(dt_, *suspension_));
  masses_.injected += smoke_source_->total_rate() * dt_;
}

template <int Dim>
void Simulation<Dim>::advance_dense_flow() {
  if (!dense_) return;
  report_.dense = dense_->solve_velocity(dt_, stages_);
  Particles<Dim>& p = dense_->particles;
  if (bed_friction_ || entrainment_) {
    const auto timed = stages_.time("dense_flow.columns");
    build_columns<Dim>(columns_, *walls_.terrain, dense_->feet(), p, cover_ ? &*cover_ : nullptr,
                       dense_->options().spacing, dense_->options().support_radius);
  }
  if (bed_friction_) {
    const auto timed = stages_.time("dense_flow.friction");
    if (scene_.dense_flow->friction_acts_on == "base") {
      find_normal_impulse(normal_impulse_, *dense_, columns_, dt_);
      report_.bed_friction = -apply_base_friction<Dim>(p, columns_, *bed_friction_, gravity_, normal_impulse_, dt_);
    } else {
      report_.bed_friction = -apply_column_friction<Dim>(p, columns_, *bed_friction_, gravity_, dt_);
    }
  }
  report_.wall_contact = dense_->move(dt_, walls_, stages_);
  if (scene_.dense_flow->compaction_time > 0) dense_->compact(dt_, scene_.dense_flow->compaction_time);
}

template <int Dim>
void Simulation<Dim>::advance_suspension() {
  if (!suspension_) return;
  if (dense_ && !scene_.suspension->frozen) core_.find(dense_->particles, overlap_, *suspension_);
  suspension_->advance(dt_, core_.cells(), stages_);
  report_.suspension = suspension_->budget();
  masses_.smoke_outflow += report_.suspension.outflow;
  masses_.deposited += report_.suspension.deposited;
  report_.n_core_cells = core_.cells().size();
  if (dense_) report_.core_reaction = core_.give_back(dense_->particles, masses_.adhered);
}

template <int Dim>
void Simulation<Dim>::entrain_cover() {
  if (!entrainment_) return;
  const auto timed = stages_.time("entrainment");
  const EntrainmentStep now{time_ + dt_, dt_, scene_.scene.seed, static_cast<std::uint32_t>(n_steps_)};
  const Particles<Dim>& taken = entrainment_->take(*cover_, dense_->particles, columns_, gravity_, now);
  if (scene_.entrainment->shared_traction)
    report_.bed_friction += share_traction<Dim>(dense_->particles, columns_, entrainment_->fluxes(), dt_);
  if (taken.empty()) return;
  for (std::size_t i = 0; i < taken.size(); ++i) dense_->particles.push_back_from(taken, i);
  if (!overlap_.empty()) overlap_.resize(dense_->particles.size(), 0);
  masses_.n_entrained += taken.size();
  masses_.entrained += entrainment_->mass_taken();
  if (ground_) {
    const std::span<const Span> moved = ground_->follow(*cover_, taken.position);
    report_.ground_on_air += suspension_->set_ground(ground_->node_distance(), moved);
  }
}

/// Particles that are spent turn into smoke (R17), particles beyond open sides leave (R23).
template <int Dim>
void Simulation<Dim>::remove_what_left() {
  if (!dense_) return;
  Particles<Dim>& p = dense_->particles;
  const auto remove = [&](auto&& gone) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < overlap_.size(); ++i)
      if (!gone(i)) overlap_[kept++] = overlap_[i];
    overlap_.resize(kept);
    return remove_if<Dim>(p, gone);
  };

  if (coupling_ && coupling_->smoke.generation &&
      dissolve_spent<Dim>(region_, exchange_, p, *suspension_, coupling_->smoke.min_mass) > 0) {
    report_.exchange_on_particles += momentum_on_particles(exchange_);
    report_.exchange_on_fixed_faces += exchange_.on_fixed_faces;
    report_.exchange_on_grid += suspension_->apply(exchange_.on_grid);
    masses_.generated += exchange_.generated;
    masses_.n_vanished += remove([&](std::size_t i) { return exchange_.on_particles.mass[i] < 0; }).count;
  }
  const Removed<Dim> left = remove([&](std::size_t i) { return walls_.outside(p.position[i]); });
  masses_.n_outflow += left.count;
  masses_.particle_outflow += left.mass;
  report_.outflow = left.momentum;
}

template <int Dim>
void Simulation<Dim>::check_state() const {
  const StepStamp stamp{n_steps_, time_, dt_};
  const double fastest = runaway_speed(walls_.domain.size().norm(), gravity_.norm(), first_speed_);
  if (dense_) check_particles<Dim>(dense_->particles, fastest, stamp);
  if (suspension_) check_suspension<Dim>(*suspension_, fastest, stamp);
}

template <int Dim>
CoverView<Dim> Simulation<Dim>::cover_view() const {
  if (!cover_) return {};
  return {&cover_->particles, &cover_->cells, &cover_->surface_normal};
}

template <int Dim>
double Simulation<Dim>::dense_mass() const {
  return dense_ ? total_mass(dense_->particles) : 0;
}

template <int Dim>
double Simulation<Dim>::cover_mass() const {
  return cover_ ? total_mass(cover_->particles) : 0;
}

template <int Dim>
double Simulation<Dim>::smoke_mass() const {
  return suspension_ ? suspension_->total_smoke() : 0;
}

template <int Dim>
double Simulation<Dim>::mass_error() const {
  const double now = dense_mass() + cover_mass() + smoke_mass() + masses_.outflow() + masses_.deposited;
  const double brought = masses_.initial + masses_.laid + masses_.injected;
  return brought > 0 ? now / brought - 1 : now;
}

template <int Dim>
std::vector<std::pair<std::string, std::size_t>> Simulation<Dim>::memory() const {
  std::vector<std::pair<std::string, std::size_t>> parts;
  if (walls_.terrain) parts.emplace_back("terrain", walls_.terrain->bytes());
  if (dense_) parts.emplace_back("dense_flow", dense_->bytes() + columns_.bytes() + bytes(normal_impulse_));
  if (cover_) parts.emplace_back("cover", cover_->bytes() + (sleeping_ ? sleeping_->bytes() : 0));
  if (suspension_)
    parts.emplace_back("suspension",
                       suspension_->bytes() + (ground_ ? ground_->bytes() : 0) + (tiles_ ? tiles_->bytes() : 0));
  if (smoke_source_) parts.emplace_back("smoke_source", smoke_source_->bytes());
  if (suspension_ && dense_) parts.emplace_back("core", core_.bytes() + bytes(overlap_));
  if (coupling_)
    parts.emplace_back("coupling",
                       region_.bytes() + bytes(exchange_.on_particles.momentum) + bytes(exchange_.on_particles.mass));
  if (entrainment_) parts.emplace_back("entrainment", entrainment_->bytes());
  if (saved_.bytes() > 0) parts.emplace_back("saved_state", saved_.bytes());
  return parts;
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace spindrift
