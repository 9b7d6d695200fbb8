#include "grid/pressure_projection.hpp"

#include <cmath>
#include <utility>

#include "core/error.hpp"

namespace spindrift {

template <int Dim>
PressureProjection<Dim>::PressureProjection(const MacGrid<Dim>& grid, const Sides& sides)
    : sides_(sides), dx_(grid.dx), poisson_(grid.cells, sides), solver_(poisson_.layout) {}

template <int Dim>
ProjectionResult PressureProjection<Dim>::project(FaceField<Dim>& u, const Field<Dim>& density,
                                                  const FaceField<Dim>& open, const Field<Dim, CellKind>& kind,
                                                  double dt, const ProjectionOptions& options,
                                                  std::span<const HeavyCell<Dim>> heavy) {
  SPINDRIFT_CHECK(dt > 0);
  SPINDRIFT_CHECK(kind.shape() == poisson_.layout.cells && density.shape() == poisson_.layout.cells);
  poisson_.build(density, open, kind, heavy, std::pow(dx_, Dim));
  components_.find(kind, open, sides_);
  anchor_closed_components();
  set_right_side(u, open, kind, dt);
  ProjectionResult result;
  result.unmatched_flux = subtract_closed_means(solver_.right_side) * dt / dx_;
  const auto solved = solver_.solve(poisson_, options.tolerance, options.max_iterations);
  result.iterations = solved.iterations;
  result.residual = solved.residual;
  result.converged = solved.converged;
  if (!std::isfinite(solved.residual)) {
    solver_.clear();
    return result;
  }
  subtract_closed_means(solver_.solution);
  if (solved.iterations > 0 || solved.residual > 0) {
    correct(u, open, dt);
    yield(u, open, kind, heavy, dt);
  }
  return result;
}

/// b_c = - dx / dt sum_f open_f u_f . n, zero where a cell is not open.
template <int Dim>
void PressureProjection<Dim>::set_right_side(const FaceField<Dim>& u, const FaceField<Dim>& open,
                                             const Field<Dim, CellKind>& kind, double dt) {
  const double scale = dx_ / dt;
  const ParityLayout<Dim>& layout = poisson_.layout;
  layout.for_each_row([&](std::size_t number, const Index<Dim>& start) {
    const RowSpan span = poisson_.spans[number];
    const CellKind* kinds = kind.row(start).data();
    std::array<const double*, Dim> lower_u, upper_u, lower_open, upper_open;
    for (int k = 0; k < Dim; ++k) {
      const Index<Dim> above = k == 0 ? start : shifted<Dim>(start, k, 1);
      const int right = k == 0 ? 1 : 0;
      lower_u[k] = u[k].row(start).data();
      upper_u[k] = u[k].row(above).data() + right;
      lower_open[k] = open[k].row(start).data();
      upper_open[k] = open[k].row(above).data() + right;
    }
    const auto inflow = [&](int i) {
      double sum = 0;
      for (int k = 0; k < Dim; ++k) sum += lower_open[k][i] * lower_u[k][i] - upper_open[k][i] * upper_u[k][i];
      return kinds[i] == CellKind::open ? scale * sum : 0.0;
    };
    double* even = solver_.right_side.data() + layout.row(start);
    double* odd = even + layout.pitch;
    const int pairs = std::min(span.end, layout.cells[0] / 2);
    for (int m = span.begin; m < pairs; ++m) {
      even[m] = inflow(2 * m);
      odd[m] = inflow(2 * m + 1);
    }
    for (int m = std::max(pairs, span.begin); m < span.end; ++m) even[m] = inflow(2 * m);
  });
}

/// A component without an open side whose pressure the core's yielding faces hold is as good as one with an open side.
template <int Dim>
void PressureProjection<Dim>::anchor_closed_components() {
  auto& components = components_.all();
  if (poisson_.yields.empty()) return;
  if (std::all_of(components.begin(), components.end(), [](const auto& c) { return c.reaches_open_side; })) return;
  components_.for_each_run([&](const Index<Dim>& start, const auto& run) {
    for (const YieldTerm<Dim>& yielding : poisson_.yields) {
      Index<Dim> row = yielding.cell;
      row[0] = 0;
      if (row == start && yielding.cell[0] >= run.begin && yielding.cell[0] < run.end)
        components[run.component].reaches_open_side = true;
    }
  });
}

/// Makes the mean over each component without an open side zero; returns the largest of these means.
template <int Dim>
double PressureProjection<Dim>::subtract_closed_means(std::vector<double>& values) {
  const auto& components = components_.all();
  if (std::all_of(components.begin(), components.end(), [](const auto& c) { return c.reaches_open_side; })) return 0;
  const ParityLayout<Dim>& layout = poisson_.layout;
  const auto for_each_closed = [&](auto&& f) {
    components_.for_each_run([&](const Index<Dim>& start, const auto& run) {
      if (components[run.component].reaches_open_side) return;
      const std::ptrdiff_t row = layout.row(start);
      for (int i = run.begin; i < run.end; ++i) {
        f(run.component, values[static_cast<std::size_t>(row + (i & 1) * layout.pitch + i / 2)]);
      }
    });
  };
  mean_.assign(components.size(), 0.0);
  for_each_closed([&](std::size_t component, double value) { mean_[component] += value; });
  double largest = 0;
  for (std::size_t c = 0; c < mean_.size(); ++c) {
    mean_[c] /= static_cast<double>(components[c].n_cells);
    largest = std::max(largest, std::abs(mean_[c]));
  }
  for_each_closed([&](std::size_t component, double& value) { value -= mean_[component]; });
  return largest;
}

/// u_f -= dt / dx (p_upper - p_lower) / rho_f on the faces that conduct.
template <int Dim>
void PressureProjection<Dim>::correct(FaceField<Dim>& u, const FaceField<Dim>& open, double dt) const {
  const double scale = dt / dx_;
  const ParityLayout<Dim>& layout = poisson_.layout;
  for (int axis = 0; axis < Dim; ++axis) {
    face_rows<Dim>(layout.cells, axis).for_each_row([&](std::size_t, const Index<Dim>& start) {
      double* v = u[axis].row(start).data();
      const double* fraction = open[axis].row(start).data();
      const RowSpan span = poisson_.face_span(axis, start);
      struct Parity {
        const double *c, *p, *p_below;
      };
      std::array<Parity, 2> of;
      for (int parity = 0; parity < 2; ++parity) {
        const std::ptrdiff_t own = layout.own(start, parity);
        const std::ptrdiff_t below = axis > 0 ? own - layout.stride[axis] : layout.left(start, parity);
        of[static_cast<std::size_t>(parity)] = {poisson_.conductance[axis].data() + own, solver_.solution.data() + own,
                                                solver_.solution.data() + below};
      }
      const auto push = [&](const Parity& at, int m, int i) {
        v[i] -= scale * at.c[m] / (at.c[m] > 0 ? fraction[i] : 1.0) * (at.p[m] - at.p_below[m]);
      };
      const int n_faces = u[axis].shape()[0], pairs = std::min(span.end, n_faces / 2);
      for (int m = span.begin; m < pairs; ++m) {
        push(of[0], m, 2 * m);
        push(of[1], m, 2 * m + 1);
      }
      if (n_faces % 2 == 1 && span.begin <= n_faces / 2 && n_faces / 2 < span.end)
        push(of[0], n_faces / 2, n_faces - 1);
    });
  }
}

template <int Dim>
void PressureProjection<Dim>::yield(FaceField<Dim>& u, const FaceField<Dim>& open, const Field<Dim, CellKind>& kind,
                                    std::span<const HeavyCell<Dim>> heavy, double dt) const {
  const double cell_volume = std::pow(dx_, Dim);
  for (const HeavyCell<Dim>& core : heavy) {
    for_each_open_neighbour<Dim>(
        core.cell, open, kind, [&](int axis, const Index<Dim>& face, const Index<Dim>& cell, int sign) {
          u[axis][face] -= sign * dt / dx_ * pressure(cell) * open[axis][face] * cell_volume / core.mass;
        });
  }
}

template <int Dim>
double PressureProjection<Dim>::pressure(const Index<Dim>& cell) const {
  return solver_.solution[static_cast<std::size_t>(poisson_.layout.at(cell))];
}

template <int Dim>
void PressureProjection<Dim>::set_pressure(const Field<Dim>& pressure) {
  SPINDRIFT_CHECK(pressure.shape() == poisson_.layout.cells);
  for_each_index<Dim>(pressure.shape(), [&](const Index<Dim>& cell) {
    solver_.solution[static_cast<std::size_t>(poisson_.layout.at(cell))] = pressure[cell];
  });
}

template <int Dim>
void PressureProjection<Dim>::set_guess(const std::vector<double>& guess) {
  SPINDRIFT_CHECK(guess.size() == solver_.solution.size());
  solver_.clear();
  solver_.solution = guess;
}

template <int Dim>
Field<Dim> PressureProjection<Dim>::pressure() const {
  Field<Dim> field(poisson_.layout.cells);
  for_each_index<Dim>(field.shape(), [&](const Index<Dim>& cell) { field[cell] = pressure(cell); });
  return field;
}

template <int Dim>
std::size_t PressureProjection<Dim>::bytes() const {
  return components_.bytes() + poisson_.bytes() + solver_.bytes() + spindrift::bytes(mean_);
}

template class PressureProjection<2>;
template class PressureProjection<3>;

}  // namespace spindrift
