#include "grid/smoke_transport.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "grid/limited_flux.hpp"
#include "grid/pack.hpp"

namespace spindrift {
namespace {

constexpr double largest_share = 0.98;  ///< of a cell's volume that may leave it at once: room for round-off

template <int Dim>
std::size_t row_of(const Index<Dim>& cell, const Index<Dim>& shape) {
  return flat<Dim>(cell, shape) / static_cast<std::size_t>(shape[0]);
}

}  // namespace

template <int Dim>
SmokeTransport<Dim>::SmokeTransport(const MacGrid<Dim>& grid, const std::array<std::array<Side, 2>, Dim>& sides)
    : grid_(grid),
      sides_(sides),
      volume_(grid.cells),
      swept_volume_(grid.cells),
      density_(grid.cells),
      flux_(make_face_field<Dim>(grid)) {
  spans_.resize(volume_.n_rows());
  before_.resize(volume_.n_rows());
}

template <int Dim>
template <class T>
T SmokeTransport<Dim>::Flow::through(int axis, std::size_t face) const {
  return dt * load<T>(&flow_area[axis][face]) * (load<T>(&u[axis][face]) + settling[axis]);
}

template <int Dim>
SmokeFlow SmokeTransport<Dim>::advance(Field<Dim>& smoke, const FaceField<Dim>& u, const FaceField<Dim>& flow_area,
                                       const Ground<Dim>& ground, const Vec<Dim>& settling, double dt) {
  SmokeFlow done;
  if (!find_spans(smoke)) return done;
  small_cells_.find(flow_area, ground);
  Flow flow{u, flow_area, settling, dt};
  double largest = largest_outflow(flow, ground);
  if (largest > largest_share) {  // smoke may get anywhere
    std::fill(spans_.begin(), spans_.end(), Span{0, grid_.cells[0]});
    largest = largest_outflow(flow, ground);
  }
  if (!(largest < 1e6))
    throw Error(ExitCode::unstable, "smoke would have to cross more than a million cells in a step");
  if (largest > 0) {
    done.substeps = std::max(1, static_cast<int>(std::ceil(largest / largest_share)));
    flow.dt = dt / done.substeps;
    small_cells_.share(smoke, volume_);
    if (done.substeps == 1) find_spans(smoke);
    for (int substep = 0; substep < done.substeps; ++substep) {
      start_substep(smoke);
      for (int axis = 0; axis < Dim; ++axis) {
        widen_spans(axis);
        set_flux(axis, flow);
        update(axis, smoke, flow);
        done.outflow += outflow(axis);
      }
    }
    small_cells_.share(smoke, ground.volume());
  }
  if (!settling.isZero()) done.deposited = deposit(smoke, ground, settling, dt);
  return done;
}

template <int Dim>
bool SmokeTransport<Dim>::find_spans(const Field<Dim>& smoke) {
  bool any = false;
  for (std::size_t r = 0; r < spans_.size(); ++r) {
    spans_[r] = nonzero_span(smoke.row(r));
    any = any || !spans_[r].empty();
  }
  return any;
}

/// By the one cell that smoke can move along the axis.
template <int Dim>
void SmokeTransport<Dim>::widen_spans(int axis) {
  spans_.swap(before_);
  const auto step = axis == 0 ? 0 : static_cast<std::size_t>(volume_.stride(axis) / volume_.stride(1));
  for (std::size_t r = 0; r < spans_.size(); ++r) {
    Span span = before_[r];
    if (axis == 0) {
      if (!span.empty()) span = {std::max(span.begin - 1, 0), std::min(span.end + 1, grid_.cells[0])};
    } else {
      const int i = volume_.row_start(r)[axis];
      if (i > 0) span = joined(span, before_[r - step]);
      if (i + 1 < grid_.cells[axis]) span = joined(span, before_[r + step]);
    }
    spans_[r] = span;
  }
}

/// Largest part of its volume that leaves a cell in dt, after small cells and their roots have lent each other volume:
/// over all cells that smoke may reach in one substep. Sets volume_.
template <int Dim>
double SmokeTransport<Dim>::largest_outflow(const Flow& flow, const Ground<Dim>& ground) {
  for (int axis = 0; axis < Dim; ++axis) widen_spans(axis);
  Field<Dim>& out_of_cell = density_;  // which is not needed yet: volume that leaves a cell in dt through all faces
  parallel_for(
      spans_.size(),
      [&](std::size_t r) {
        std::ranges::copy(ground.volume().row(r), volume_.row(r).begin());
        std::ranges::fill(out_of_cell.row(r), 0.0);
        if (spans_[r].empty()) return;
        const Index<Dim> start = volume_.row_start(r);
        double* out = out_of_cell.row(r).data();
        for (int axis = 0; axis < Dim; ++axis) {
          const std::size_t first = flat<Dim>(start, grid_.faces(axis));
          const auto next = static_cast<std::size_t>(flux_[axis].stride(axis));
          for_each_pack(spans_[r].begin, spans_[r].end, [&]<class T>(int i) {
            const std::size_t face = first + static_cast<std::size_t>(i);
            const T below = flow.template through<T>(axis, face), above = flow.template through<T>(axis, face + next);
            store<T>(out + i, load<T>(out + i) + (larger(above, T{}) - smaller(below, T{})));
          });
        }
      },
      volume_.rows_per_task());
  small_cells_.lend(volume_, out_of_cell, largest_share);
  return parallel_max(spans_.size(), 0.0, [&](std::size_t r) {
    const double *out = out_of_cell.row(r).data(), *volume = volume_.row(r).data();
    return max_packs(spans_[r].begin, spans_[r].end,
                     [&]<class T>(int i) { return load<T>(out + i) / (load<T>(volume + i) + smallest_divisor); });
  });
}

/// A sweep along each axis widens the spans by one and reads two cells beyond.
template <int Dim>
void SmokeTransport<Dim>::find_surroundings() {
  around_ = spans_;
  spans_.swap(around_);
  for (int step = 0; step < 3; ++step)
    for (int axis = 0; axis < Dim; ++axis) widen_spans(axis);
  spans_.swap(around_);
}

template <int Dim>
void SmokeTransport<Dim>::start_substep(const Field<Dim>& smoke) {
  find_surroundings();
  parallel_for(
      spans_.size(),
      [&](std::size_t r) {
        const auto [begin, end] = around_[r];
        if (begin >= end) return;
        std::copy(volume_.row(r).begin() + begin, volume_.row(r).begin() + end, swept_volume_.row(r).begin() + begin);
        const double *mass = smoke.row(r).data(), *volume = volume_.row(r).data();
        double* density = density_.row(r).data();
        std::fill(density + begin, density + end, 0.0);
        for_each_pack(spans_[r].begin, spans_[r].end, [&]<class T>(int i) {
          const T v = load<T>(volume + i);
          store<T>(density + i, v > 0 ? load<T>(mass + i) / (v + smallest_divisor) : T{});
        });
      },
      volume_.rows_per_task());
}

/// Fluxes through all faces of the cells in spans_.
template <int Dim>
void SmokeTransport<Dim>::set_flux(int axis, const Flow& flow) {
  Field<Dim>& flux = flux_[axis];
  const int n = grid_.cells[axis];
  const auto cell = density_.stride(axis), face = flux.stride(axis);
  // Faces with less than two cells on a side: upwind.
  const auto upwind = [&](const Index<Dim>& i) {
    const double q = flow.template through<double>(axis, flat<Dim>(i, flux.shape()));
    const double below = i[axis] > 0 ? density_[shifted<Dim>(i, axis, -1)] : 0, above = i[axis] < n ? density_[i] : 0;
    const double mass = q > 0 ? q * below : q * above;
    flux[i] = std::abs(mass) > smallest_flux ? mass : 0;
  };
  const auto limited = [&](const Index<Dim>& start, int begin, int end) {
    const std::size_t first = flat<Dim>(start, flux.shape());
    const double* density = density_.values().data() + flat<Dim>(start, grid_.cells);
    const double* volume = swept_volume_.values().data() + flat<Dim>(start, grid_.cells);
    for_each_pack(begin, end, [&]<class T>(int i) {
      const std::size_t f = first + static_cast<std::size_t>(i);
      const T q = flow.template through<T>(axis, f);
      const T below = flow.template through<T>(axis, f - static_cast<std::size_t>(face));
      const T above = flow.template through<T>(axis, f + static_cast<std::size_t>(face));
      const T volume_l = load<T>(volume + i - cell), volume_r = load<T>(volume + i);
      const T room_l = volume_l - (larger(q, T{}) - smaller(below, T{}));
      const T room_r = volume_r - (larger(above, T{}) - smaller(q, T{}));
      store<T>(&flux[f],
               limited_flux<T>(q, load<T>(density + i - 2 * cell), load<T>(density + i - cell), load<T>(density + i),
                               load<T>(density + i + cell), volume_l, volume_r, room_l, room_r));
    });
  };
  parallel_for(
      flux.n_rows(),
      [&](std::size_t r) {
        const Index<Dim> start = flux.row_start(r);
        Span span;
        if (axis == 0) {
          span = spans_[r];
          if (span.empty()) return;
          ++span.end;
        } else {
          if (start[axis] > 0) span = spans_[row_of<Dim>(shifted<Dim>(start, axis, -1), grid_.cells)];
          if (start[axis] < n) span = joined(span, spans_[row_of<Dim>(start, grid_.cells)]);
        }
        Span inner{std::max(span.begin, axis == 0 ? 2 : 0), std::min(span.end, axis == 0 ? n - 1 : grid_.cells[0])};
        if (axis != 0 && (start[axis] < 2 || start[axis] > n - 2)) inner = {};
        if (inner.empty()) inner = {span.end, span.end};
        for (int i = span.begin; i < inner.begin; ++i) upwind(shifted<Dim>(start, 0, i));
        limited(start, inner.begin, inner.end);
        for (int i = inner.end; i < span.end; ++i) upwind(shifted<Dim>(start, 0, i));
      },
      flux.rows_per_task());
}

template <int Dim>
void SmokeTransport<Dim>::update(int axis, Field<Dim>& smoke, const Flow& flow) {
  const auto next = static_cast<std::size_t>(flux_[axis].stride(axis));
  parallel_for(
      smoke.n_rows(),
      [&](std::size_t r) {
        const std::size_t first = flat<Dim>(smoke.row_start(r), grid_.faces(axis));
        double *mass = smoke.row(r).data(), *volume = swept_volume_.row(r).data(), *density = density_.row(r).data();
        const double* flux = flux_[axis].values().data() + first;
        for_each_pack(spans_[r].begin, spans_[r].end, [&]<class T>(int i) {
          const std::size_t face = first + static_cast<std::size_t>(i);
          const T m = load<T>(mass + i) + (load<T>(flux + i) - load<T>(flux + i + next));
          const T v = load<T>(volume + i) +
                      (flow.template through<T>(axis, face) - flow.template through<T>(axis, face + next));
          store<T>(mass + i, m);
          store<T>(volume + i, v);
          store<T>(density + i, v > 0 ? m / (v + smallest_divisor) : T{});
        });
      },
      smoke.rows_per_task());
}

/// Mass through the open sides at the ends of the axis in this sweep [kg].
template <int Dim>
double SmokeTransport<Dim>::outflow(int axis) const {
  double mass = 0;
  Index<Dim> ends = flux_[axis].shape();
  ends[axis] = 1;
  for_each_index<Dim>(ends, [&](Index<Dim> i) {
    for (int side = 0; side < 2; ++side) {
      if (sides_[axis][side] == Side::closed) continue;
      Index<Dim> cell = i;
      cell[axis] = side == 0 ? 0 : grid_.cells[axis] - 1;
      const Span span = spans_[row_of<Dim>(cell, grid_.cells)];
      if (cell[0] < span.begin || cell[0] >= span.end) continue;
      mass += side == 0 ? -flux_[axis][cell] : flux_[axis][shifted<Dim>(cell, axis, 1)];
    }
  });
  return mass;
}

template <int Dim>
double SmokeTransport<Dim>::deposit(Field<Dim>& smoke, const Ground<Dim>& ground, const Vec<Dim>& settling,
                                    double dt) const {
  const auto open_area = [&](int axis, const Index<Dim>& face) {
    const bool closed = (face[axis] == 0 && sides_[axis][0] == Side::closed) ||
                        (face[axis] == grid_.cells[axis] && sides_[axis][1] == Side::closed);
    return closed ? 0.0 : grid_.face_area() * ground.open()[axis][face];
  };
  double deposited = 0;
  for_each_index<Dim>(grid_.cells, [&](const Index<Dim>& i) {
    if (smoke[i] <= 0 || ground.volume()[i] <= 0) return;
    double rate = 0;
    for (int axis = 0; axis < Dim; ++axis) {
      const double area = open_area(axis, i) - open_area(axis, shifted<Dim>(i, axis, 1));
      rate += std::max(settling[axis] * area, 0.0);
    }
    if (rate <= 0) return;
    const double before = smoke[i];
    smoke[i] = before / (1 + dt * rate / ground.volume()[i]);
    deposited += before - smoke[i];
  });
  return deposited;
}

template <int Dim>
std::size_t SmokeTransport<Dim>::bytes() const {
  std::size_t n = volume_.bytes() + swept_volume_.bytes() + density_.bytes();
  for (const auto& f : flux_) n += f.bytes();
  return n + spindrift::bytes(spans_, before_, around_) + small_cells_.bytes();
}

template class SmokeTransport<2>;
template class SmokeTransport<3>;

}  // namespace spindrift
