#include "grid/suspension.hpp"

#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "grid/face_mass.hpp"
#include "grid/pack.hpp"

namespace spindrift {

template <int Dim>
Suspension<Dim>::Suspension(const MacGrid<Dim>& grid, const Sides& sides, const SuspensionOptions<Dim>& options)
    : grid_(grid),
      sides_(sides),
      options_(options),
      velocity_(make_face_field<Dim>(grid)),
      smoke_(grid.cells),
      kind_(grid.cells, CellKind::open),
      last_kind_(kind_),
      projection_(grid, sides),
      ground_(grid, options.air_density),
      active_(make_face_field<Dim, unsigned char>(grid)),
      flow_area_(make_face_field<Dim>(grid)),
      carrier_(velocity_),
      advection_(grid),
      smoke_transport_(grid, sides),
      core_boundary_(sides) {
  for (std::size_t axis = 0; axis < Dim; ++axis) carrier_speed_[axis].resize(velocity_[axis].n_rows());
  update_active(0, grid_.cells[0]);
  update_rows();
}

template <int Dim>
void Suspension<Dim>::set_velocity(const FaceField<Dim>& u) {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    SPINDRIFT_CHECK(u[axis].shape() == velocity_[axis].shape());
    std::ranges::copy(u[axis].values(), velocity_[axis].values().begin());
  }
  momentum_.reset();
  start_from_velocity();
}

template <int Dim>
void Suspension<Dim>::set_smoke_mass(const Field<Dim>& smoke) {
  SPINDRIFT_CHECK(smoke.shape() == grid_.cells);
  std::ranges::copy(smoke.values(), smoke_.values().begin());
  momentum_.reset();
}

template <int Dim>
void Suspension<Dim>::set_kind(const Field<Dim, CellKind>& kind) {
  SPINDRIFT_CHECK(kind.shape() == grid_.cells);
  std::ranges::copy(kind.values(), kind_.values().begin());
  kinds_are_old_ = true;
  update_active(0, grid_.cells[0]);
}

template <int Dim>
void Suspension<Dim>::save(SuspensionState<Dim>& state) const {
  state.grid = grid_;
  state.velocity = velocity_;
  state.carrier = carrier_;
  state.carrier_speed = carrier_speed_;
  state.smoke = smoke_;
  state.kind = kind_;
  state.pressure = projection_.guess();
  state.momentum = momentum_;
  state.still = still_;
  state.disturbed = disturbed_;
  state.kinds_are_old = kinds_are_old_;
}

template <int Dim>
void Suspension<Dim>::restore(const SuspensionState<Dim>& state) {
  SPINDRIFT_CHECK(same_window<Dim>(state.grid, grid_));
  set_still(state.still);
  velocity_ = state.velocity;
  carrier_ = state.carrier;
  carrier_speed_ = state.carrier_speed;
  smoke_ = state.smoke;
  kind_ = state.kind;
  projection_.set_guess(state.pressure);
  momentum_ = state.momentum;
  disturbed_ = state.disturbed;
  kinds_are_old_ = state.kinds_are_old;
  update_active(0, grid_.cells[0]);
  update_rows();
}

template <int Dim>
std::size_t SuspensionState<Dim>::bytes() const {
  std::size_t n = smoke.bytes() + kind.bytes() + spindrift::bytes(pressure);
  for (std::size_t axis = 0; axis < Dim; ++axis)
    n += velocity[axis].bytes() + carrier[axis].bytes() + spindrift::bytes(carrier_speed[axis]);
  return n;
}

template <int Dim>
void Suspension<Dim>::set_ground(const Field<Dim>& node_distance) {
  const std::array<Span, 1> all{Span{0, grid_.cells[0]}};
  set_ground(node_distance, all);
}

template <int Dim>
Vec<Dim> Suspension<Dim>::set_ground(const Field<Dim>& node_distance, std::span<const Span> columns) {
  const auto momentum_around = [&] {
    Vec<Dim> sum = Vec<Dim>::Zero();
    int done = 0;
    for (const Span span : columns) {
      sum += momentum({std::max(done, span.begin - Ground<Dim>::reach), span.end + Ground<Dim>::reach});
      done = span.end + Ground<Dim>::reach;
    }
    return sum;
  };
  const Vec<Dim> before = momentum_around();
  ground_.set(node_distance, columns);
  for (const auto& [begin, end] : columns) {
    ground_.clear_deep(velocity_, begin, end);
    ground_.clear_deep(carrier_, begin, end);
    advection_.clear_deep(ground_, begin, end);
    for (std::size_t r = 0; r < kind_.n_rows(); ++r) {
      const Index<Dim> start = kind_.row_start(r);
      for (auto i = static_cast<std::size_t>(begin); i < static_cast<std::size_t>(end); ++i) {
        CellKind& kind = kind_.row(r)[i];
        if (ground_.volume().row(r)[i] <= 0) {
          kind = CellKind::solid;
        } else if (kind == CellKind::solid) {
          kind = still_(shifted<Dim>(start, 0, static_cast<int>(i))) ? CellKind::still : CellKind::open;
        }
      }
    }
    update_active(begin, end);
  }
  update_rows();
  kinds_are_old_ = true;
  const Vec<Dim> change = momentum_around() - before;
  if (momentum_) *momentum_ += change;
  return change;
}

template <int Dim>
double Suspension<Dim>::face_mass(int axis, std::size_t face) const {
  const double air = ground_.air_mass()[axis][face];
  return air > 0 ? air + smoke_of_face<Dim>(smoke_, axis, unflat<Dim>(face, grid_.faces(axis))) : 0;
}

template <int Dim>
double Suspension<Dim>::smoke_density(std::size_t cell) const {
  const double volume = ground_.volume()[cell];
  return volume > 0 ? smoke_[cell] / volume : 0;
}

template <int Dim>
Vec<Dim> Suspension<Dim>::momentum(Span columns) const {
  Vec<Dim> sum;
  for (int axis = 0; axis < Dim; ++axis) {
    const double* u = velocity_[axis].values().data();
    sum[axis] = sum_over_faces<Dim>(
        axis, ground_, smoke_, [u]<class T>(std::size_t face, std::size_t, std::size_t) { return load<T>(u + face); },
        columns);
  }
  return sum;
}

template <int Dim>
double Suspension<Dim>::total_smoke() const {
  return parallel_sum(smoke_.size(), 0.0, [&](std::size_t cell) { return smoke_[cell]; });
}

template <int Dim>
double Suspension<Dim>::max_speed() const {
  double speed = 0;
  for (const auto& rows : carrier_speed_) {
    for (const double s : rows) {
      if (s != s) return s;
      speed = std::max(speed, s);
    }
  }
  return speed;
}

template <int Dim>
void Suspension<Dim>::start_from_velocity() {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const auto& u = velocity_[axis];
    parallel_for(
        u.n_rows(),
        [&](std::size_t r) {
          const Span span = moving_faces(axis, r);
          if (!span.empty())
            std::copy_n(u.row(r).data() + span.begin, span.end - span.begin, carrier_[axis].row(r).data() + span.begin);
          find_carrier_speed(axis, r);
        },
        u.rows_per_task());
  }
  disturbed_ = false;
}

template <int Dim>
void Suspension<Dim>::find_carrier_speeds() {
  for (std::size_t axis = 0; axis < Dim; ++axis)
    parallel_for(
        carrier_[axis].n_rows(), [&](std::size_t r) { find_carrier_speed(axis, r); }, carrier_[axis].rows_per_task());
}

template <int Dim>
void Suspension<Dim>::find_carrier_speed(std::size_t axis, std::size_t r) {
  const double* row = carrier_[axis].row(r).data();
  const Span span = moving_faces(axis, r);
  carrier_speed_[axis][r] =
      max_packs(span.begin, span.end, [&]<class T>(int i) { return magnitude(load<T>(row + i)); });
}

/// Of row r; where air is still, velocity and carrier are 0.
template <int Dim>
Span Suspension<Dim>::moving_faces(std::size_t axis, std::size_t r) const {
  return still_.any() ? rows_[axis][r] : Span{0, velocity_[axis].shape()[0]};
}

/// Rows without smoke, now and at the last call, keep the air's density.
template <int Dim>
void Suspension<Dim>::set_density() {
  if (density_.size() == 0) {
    density_ = Field<Dim>(grid_.cells, options_.air_density);
    dense_span_.resize(density_.n_rows());
  }
  parallel_for(
      smoke_.n_rows(),
      [&](std::size_t r) {
        const Span smoky = nonzero_span(smoke_.row(r)), span = joined(smoky, std::exchange(dense_span_[r], smoky));
        const double *mass = smoke_.row(r).data(), *volume = ground_.volume().row(r).data();
        double* density = density_.row(r).data();
        for_each_pack(span.begin, span.end, [&]<class T>(int i) {
          const T v = load<T>(volume + i), m = load<T>(mass + i);
          store<T>(density + i, options_.air_density + (v > 0 ? m / (v > 0 ? v : m) : T{}));
        });
      },
      smoke_.rows_per_task());
}

template <int Dim>
Vec<Dim> Suspension<Dim>::add_gravity(double dt) {
  Vec<Dim> change = Vec<Dim>::Zero();
  if (options_.gravity.isZero() || options_.frozen) return change;
  smoke_span_.resize(smoke_.n_rows());
  for (std::size_t r = 0; r < smoke_.n_rows(); ++r) smoke_span_[r] = nonzero_span(smoke_.row(r));
  if (std::ranges::all_of(smoke_span_, &Span::empty)) return change;
  disturbed_ = true;
  const double air = options_.air_density;
  const auto density = [&](const Index<Dim>& cell) {
    const double volume = ground_.volume()[cell];
    return volume > 0 ? air + smoke_[cell] / volume : air;
  };
  for (int axis = 0; axis < Dim; ++axis) {
    if (options_.gravity[axis] == 0) continue;
    Field<Dim>& u = velocity_[axis];
    const int n = grid_.cells[axis];
    const auto pull = [&](std::size_t r) {
      const Index<Dim> start = u.row_start(r);
      const auto span_of = [&](const Index<Dim>& row) {
        return smoke_span_[flat<Dim>(row, grid_.cells) / static_cast<std::size_t>(grid_.cells[0])];
      };
      Span span;
      if (start[axis] < n) span = span_of(start);
      if (axis == 0 && !span.empty()) ++span.end;
      if (axis != 0 && start[axis] > 0) span = joined(span, span_of(shifted<Dim>(start, axis, -1)));
      double gained = 0;
      Index<Dim> face = start;
      for (face[0] = span.begin; face[0] < span.end; ++face[0]) {
        if (!(flow_area_[axis][face] > 0)) continue;
        const Index<Dim> below = face[axis] > 0 ? shifted<Dim>(face, axis, -1) : face;
        const Index<Dim> above = face[axis] < n ? face : below;
        const double total = 0.5 * (density(below) + density(above));
        const double du = dt * options_.gravity[axis] * (total - air) / total;
        u[face] += du;
        gained += (ground_.air_mass()[axis][face] + smoke_of_face<Dim>(smoke_, axis, face)) * du;
      }
      return gained;
    };
    change[axis] = parallel_reduce(
        u.n_rows(), 0.0,
        [&](std::size_t begin, std::size_t end) {
          double sum = 0;
          for (std::size_t r = begin; r < end; ++r) sum += pull(r);
          return sum;
        },
        [](double a, double b) { return a + b; }, u.rows_per_task());
  }
  if (momentum_) *momentum_ += change;
  return change;
}

template <int Dim>
Vec<Dim> Suspension<Dim>::apply(const GridSources<Dim>& sources) {
  face_momentum_.clear();
  for (int axis = 0; axis < Dim; ++axis)
    for (const PointSource& source : sources.momentum[axis])
      face_momentum_.push_back(face_mass(axis, source.point) * velocity_[axis][source.point]);
  for (const PointSource& source : sources.smoke)
    smoke_[source.point] = std::max(0.0, smoke_[source.point] + source.amount);
  Vec<Dim> change = Vec<Dim>::Zero();
  std::size_t n = 0;
  for (int axis = 0; axis < Dim; ++axis) {
    for (const PointSource& source : sources.momentum[axis]) {
      double& u = velocity_[axis][source.point];
      const double mass = face_mass(axis, source.point), before = face_momentum_[n++];
      if (active_[axis][source.point] && !options_.frozen) u = (before + source.amount) / mass;
      change[axis] += mass * u - before;
    }
  }
  disturbed_ = disturbed_ || n > 0;
  if (momentum_) *momentum_ += change;
  return change;
}

template <int Dim>
std::size_t Suspension<Dim>::bytes() const {
  std::size_t n = smoke_.bytes() + kind_.bytes() + last_kind_.bytes() + density_.bytes() + projection_.bytes() +
                  ground_.bytes() + advection_.bytes() + smoke_transport_.bytes() + diffusion_.bytes() +
                  confinement_.bytes() + core_boundary_.bytes() + components_.bytes() +
                  spindrift::bytes(face_momentum_) + spindrift::bytes(smoke_span_, dense_span_);
  for (std::size_t axis = 0; axis < Dim; ++axis)
    n += velocity_[axis].bytes() + carrier_[axis].bytes() + unprojected_[axis].bytes() + active_[axis].bytes() +
         flow_area_[axis].bytes() + spindrift::bytes(carrier_speed_[axis]);
  return n;
}

template struct SuspensionState<2>;
template struct SuspensionState<3>;
template class Suspension<2>;
template class Suspension<3>;

}  // namespace spindrift
