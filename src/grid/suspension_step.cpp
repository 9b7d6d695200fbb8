#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "grid/face_mass.hpp"
#include "grid/suspension.hpp"

namespace spindrift {

template <int Dim>
void Suspension<Dim>::advance(double dt, std::span<CoreCell<Dim>> cores, Stages& stages) {
  budget_ = {};
  if (!std::isfinite(max_speed())) throw Error(ExitCode::unstable, "the air's velocity is not finite");
  if (at_rest(cores)) return move_smoke(dt, stages);
  const auto move_smoke_and_book = [&] {
    const Vec<Dim> before = momentum_of_smoke<Dim>(smoke_, velocity_, ground_);
    move_smoke(dt, stages);
    return Vec<Dim>(momentum_of_smoke<Dim>(smoke_, velocity_, ground_) - before);
  };
  if (options_.frozen) {
    budget_.smoke = move_smoke_and_book();
    return;
  }

  Vec<Dim> last = momentum_ ? *momentum_ : momentum();
  const auto book = [&](Vec<Dim>& entry, const Vec<Dim>& change) {
    entry += change;
    last += change;
  };
  const auto book_all = [&](Vec<Dim>& entry) { book(entry, momentum() - last); };

  // 1. The dense core moves its faces (R10).
  if (!cores.empty() || kinds_are_old_) {
    const auto timed = stages.time("suspension.core");
    classify(cores);
    book(budget_.core, core_boundary_.push_out_smoke(smoke_, cores, velocity_, kind_, ground_));
    book(budget_.core, core_boundary_.set_velocity(velocity_, cores, kind_, smoke_, ground_, options_.moving_core));
  }
  // 2. Air and smoke are carried along.
  carry_velocity(options_.reflection ? dt / 2 : dt, stages);
  book_all(budget_.advection);
  if (options_.reflection) {
    reflect(cores, dt, stages);
    book_all(budget_.projection);
    carry_velocity(dt / 2, stages);
    book_all(budget_.advection);
  }
  book(budget_.smoke, move_smoke_and_book());
  // 3. Forces.
  if (options_.viscosity > 0) {
    const auto timed = stages.time("suspension.viscosity");
    diffusion_.diffuse_velocity(velocity_, smoke_, flow_area_, grid_, ground_, {sides_, options_.no_slip, options_.lid},
                                options_.viscosity, dt);
    book_all(budget_.diffusion);
  }
  if (options_.confinement) {
    const auto timed = stages.time("suspension.confinement");
    book(budget_.confinement,
         confinement_.apply(velocity_, flow_area_, ground_, smoke_, grid_, *options_.confinement, dt));
  }
  // 4. Incompressibility.
  project(dt, 1, cores, stages);
  book_all(budget_.projection);
  const auto timed = stages.time("suspension.extrapolation");
  ground_.extrapolate(velocity_);
  start_from_velocity();
  momentum_ = last;
}

template <int Dim>
void Suspension<Dim>::carry_velocity(double dt, Stages& stages) {
  const auto timed = stages.time("suspension.advection");
  const AdvectionFrame<Dim> frame{grid_, rows_, carrier_, carrier_speed_, flow_area_};
  advection_.advect(velocity_, frame, dt, options_.scheme);
  let_in_ambient_air<Dim>(velocity_, carrier_, flow_area_, grid_, sides_, options_.wind, dt);
}

/// weight: how often the change counts for the cores.
template <int Dim>
void Suspension<Dim>::project(double dt, double weight, std::span<CoreCell<Dim>> cores, Stages& stages) {
  const auto timed = stages.time("suspension.pressure");
  set_density();
  const bool moving = options_.moving_core;
  const auto heavy = moving ? core_boundary_.heavy_cells(cores, kind_) : std::span<const HeavyCell<Dim>>{};
  budget_.pressure = projection_.project(velocity_, density_, ground_.open(), kind_, dt, options_.pressure, heavy);
  budget_.core_pressure +=
      core_boundary_.add_pressure(cores, projection_, kind_, smoke_, ground_, grid_.face_area(), weight * dt, moving);
}

/// The velocity at mid-step is the projected one, and carries the second half; what goes on is the unprojected one
/// mirrored at it, u <- 2 P u - u: the half step's error of splitting is undone by the second half.
/// Source: Zehnder, Narain, Thomaszewski, An Advection-Reflection Solver for Detail-Preserving Fluid Simulation (2018).
template <int Dim>
void Suspension<Dim>::reflect(std::span<CoreCell<Dim>> cores, double dt, Stages& stages) {
  unprojected_ = velocity_;
  project(dt, 2, cores, stages);
  const auto timed = stages.time("suspension.extrapolation");
  ground_.extrapolate(velocity_);
  start_from_velocity();
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    auto& u = velocity_[axis];
    const auto& before = unprojected_[axis];
    parallel_for(
        u.n_rows(),
        [&](std::size_t r) {
          const auto row = u.row(r);
          const auto old = before.row(r);
          for (std::size_t i = 0; i < row.size(); ++i) row[i] += row[i] - old[i];
        },
        u.rows_per_task());
  }
}

/// No air moves and none will.
template <int Dim>
bool Suspension<Dim>::at_rest(std::span<const CoreCell<Dim>> cores) const {
  return cores.empty() && !kinds_are_old_ && !disturbed_ && max_speed() == 0 && options_.lid.isZero();
}

/// Sets the kind of every cell, and what follows from it.
template <int Dim>
void Suspension<Dim>::classify(std::span<CoreCell<Dim>> cores) {
  std::ranges::copy(kind_.values(), last_kind_.values().begin());
  parallel_for(
      kind_.n_rows(),
      [&](std::size_t r) {
        const auto kinds = kind_.row(r);
        const double* volume = ground_.volume().row(r).data();
        still_.for_each_run(kind_.row_start(r), grid_.cells, [&](Span run, bool still) {
          const CellKind air = still ? CellKind::still : CellKind::open;
          for (auto i = static_cast<std::size_t>(run.begin); i < static_cast<std::size_t>(run.end); ++i)
            kinds[i] = volume[i] > 0 ? air : CellKind::solid;
        });
      },
      kind_.rows_per_task());
  for (const CoreCell<Dim>& core : cores)
    if (kind_[core.cell] == CellKind::open) kind_[core.cell] = CellKind::core;
  if (!cores.empty()) {
    // A sliver between core and ground would answer the smallest movement of the core with a jet.
    for (const std::uint32_t cell : ground_.small_cells())
      if (kind_[cell] == CellKind::open &&
          kind_[root_of_small_cell<Dim>(cell, ground_.open(), ground_)] == CellKind::core)
        kind_[cell] = CellKind::pocket;
    mark_pockets<Dim>(kind_, ground_.open(), sides_, components_);
  }
  kinds_are_old_ = !cores.empty();
  Span changed;
  for (std::size_t r = 0; r < kind_.n_rows(); ++r) {
    const auto now = kind_.row(r), last = last_kind_.row(r);
    const auto first = std::ranges::mismatch(now, last).in1;
    if (first == now.end()) continue;
    auto end = static_cast<int>(now.size());
    while (now[static_cast<std::size_t>(end) - 1] == last[static_cast<std::size_t>(end) - 1]) --end;
    changed = joined(changed, {static_cast<int>(first - now.begin()), end});
  }
  if (!changed.empty()) update_active(changed.begin, changed.end);
}

/// Of the faces of the cell columns [begin, end).
template <int Dim>
void Suspension<Dim>::update_active(int begin, int end) {
  for (int axis = 0; axis < Dim; ++axis) {
    auto& active = active_[axis];
    const int n = grid_.cells[axis];
    const auto below = static_cast<std::size_t>(kind_.stride(axis));
    const double area = grid_.face_area();
    parallel_for(
        active.n_rows(),
        [&](std::size_t r) {
          const Index<Dim> start = active.row_start(r);
          const double* open = ground_.open()[axis].row(r).data();
          unsigned char* flag = active.row(r).data();
          double* flow = flow_area_[axis].row(r).data();
          const std::size_t cell = flat<Dim>(start, grid_.cells);
          const auto last = static_cast<std::size_t>(axis == 0 ? end + 1 : end);
          for (auto i = static_cast<std::size_t>(begin); i < last; ++i) {
            const int along = axis == 0 ? static_cast<int>(i) : start[axis];
            // A cell of air and what lets it through: air, still air, an open side.
            const CellKind low = along > 0                       ? kind_[cell + i - below]
                                 : sides_[axis][0] == Side::open ? CellKind::still
                                                                 : CellKind::solid;
            const CellKind high = along < n                       ? kind_[cell + i]
                                  : sides_[axis][1] == Side::open ? CellKind::still
                                                                  : CellKind::solid;
            const bool on =
                open[i] > 0 && ((low == CellKind::open && (high == CellKind::open || high == CellKind::still)) ||
                                (low == CellKind::still && high == CellKind::open));
            flag[i] = on ? 1 : 0;
            flow[i] = on ? area * open[i] : 0;
          }
        },
        active.rows_per_task());
  }
}

template <int Dim>
void Suspension<Dim>::move_smoke(double dt, Stages& stages) {
  Vec<Dim> settling = Vec<Dim>::Zero();
  if (options_.settling_speed > 0 && !options_.gravity.isZero())
    settling = options_.settling_speed * options_.gravity.normalized();
  if (max_speed() > 0 || !settling.isZero()) {
    const auto timed = stages.time("suspension.smoke");
    const SmokeFlow moved = smoke_transport_.advance(smoke_, carrier_, flow_area_, ground_, settling, dt);
    budget_.outflow = moved.outflow;
    budget_.deposited = moved.deposited;
    budget_.smoke_substeps = moved.substeps;
  }
  if (options_.diffusivity > 0) {
    const auto timed = stages.time("suspension.diffusion");
    diffusion_.diffuse_smoke(smoke_, flow_area_, grid_, ground_, options_.diffusivity, dt);
  }
}

template class Suspension<2>;
template class Suspension<3>;

}  // namespace spindrift
