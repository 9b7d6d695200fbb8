#include "grid/poisson_operator.hpp"

#include <algorithm>
#include <atomic>
#include <limits>

#include "core/parallel.hpp"

namespace spindrift {

namespace {

constexpr double closed = std::numeric_limits<double>::infinity();

/// Sets the ghost cells beyond one side of the box.
template <int Dim>
void set_ghosts(std::vector<double>& resistance, const ParityLayout<Dim>& layout, int axis, int beyond, double value) {
  Index<Dim> shape = layout.cells;
  shape[axis] = 1;
  for_each_index<Dim>(shape, [&](Index<Dim> i) {
    i[axis] = beyond;
    resistance[static_cast<std::size_t>(layout.at(i))] = value;
  });
}

template <int Dim>
RowSpan open_span(std::span<const CellKind> kind) {
  const auto is_open = [](CellKind k) { return k == CellKind::open; };
  const auto first = std::find_if(kind.begin(), kind.end(), is_open);
  if (first == kind.end()) return {};
  const auto last = std::find_if(kind.rbegin(), kind.rend(), is_open);
  return {static_cast<int>(first - kind.begin()) / 2, static_cast<int>(kind.rend() - last - 1) / 2 + 1};
}

}  // namespace

template <int Dim>
PoissonOperator<Dim>::PoissonOperator(const Index<Dim>& cells, const std::array<std::array<Side, 2>, Dim>& sides)
    : layout(cells), spans(layout.n_rows), resistance_(layout.size, closed) {
  for (auto& c : conductance) c.assign(layout.size, 0.0);
  for (int axis = 0; axis < Dim; ++axis) {
    set_ghosts(resistance_, layout, axis, -1, sides[axis][0] == Side::open ? 0 : closed);
    set_ghosts(resistance_, layout, axis, cells[axis], sides[axis][1] == Side::open ? 0 : closed);
  }
}

template <int Dim>
void PoissonOperator<Dim>::build(const Field<Dim>& density, const FaceField<Dim>& open,
                                 const Field<Dim, CellKind>& kind, std::span<const HeavyCell<Dim>> heavy,
                                 double cell_volume) {
  find_yields(open, kind, heavy, cell_volume);
  const int n = layout.cells[0];
  std::atomic<bool> any_still = false;
  layout.for_each_row([&](std::size_t number, const Index<Dim>& start) {
    const auto kinds = kind.row(start);
    const auto rho = density.row(start);
    spans[number] = open_span<Dim>(kinds);
    double* even = resistance_.data() + layout.row(start);
    double* odd = even + layout.pitch;
    if (std::ranges::find(kinds, CellKind::still) != kinds.end()) any_still = true;
    const auto value = [&](int i) {
      return kinds[i] == CellKind::open ? rho[i] : kinds[i] == CellKind::still ? 0 : closed;
    };
    for (int m = 0; m < n / 2; ++m) {
      even[m] = value(2 * m);
      odd[m] = value(2 * m + 1);
    }
    if (n % 2 == 1) even[n / 2] = value(n - 1);
  });
  has_still_ = any_still;

  for (int axis = 0; axis < Dim; ++axis) {
    face_rows<Dim>(layout.cells, axis).for_each_row([&](std::size_t, const Index<Dim>& start) {
      const RowSpan span = face_span(axis, start);
      const std::ptrdiff_t row = layout.row(start);
      double* even = conductance[axis].data() + row;
      double* odd = even + layout.pitch;
      const auto [begin, end] = span;
      std::fill(even, even + begin, 0.0);
      std::fill(odd, odd + begin, 0.0);
      std::fill(even + end, even + layout.pitch, 0.0);
      std::fill(odd + end, odd + layout.pitch, 0.0);

      const double* fraction = open[axis].row(start).data();
      const int n_faces = open[axis].shape()[0];
      const double* r_even = resistance_.data() + row;
      const double* r_odd = r_even + layout.pitch;
      const double* below_even = axis == 0 ? r_odd - 1 : r_even - layout.stride[axis];
      const double* below_odd = axis == 0 ? r_even : r_odd - layout.stride[axis];
      // Between two still cells, as between an open side and a still one, nothing is conducted.
      const auto conductance_of = [](double part, double below, double above) {
        const double resistance = below + above;
        return 2 * part / (resistance > 0 ? resistance : closed);
      };
      const int pairs = std::min(end, n_faces / 2);
      for (int m = begin; m < pairs; ++m) {
        even[m] = conductance_of(fraction[2 * m], below_even[m], r_even[m]);
        odd[m] = conductance_of(fraction[2 * m + 1], below_odd[m], r_odd[m]);
      }
      for (int m = std::max(pairs, begin); m < end; ++m) {
        even[m] = 2 * m < n_faces ? conductance_of(fraction[2 * m], below_even[m], r_even[m]) : 0;
        odd[m] = 0;
      }
    });
  }
}

template <int Dim>
void PoissonOperator<Dim>::find_yields(const FaceField<Dim>& open, const Field<Dim, CellKind>& kind,
                                       std::span<const HeavyCell<Dim>> heavy, double cell_volume) {
  yields.clear();
  for (const HeavyCell<Dim>& core : heavy) {
    for_each_open_neighbour<Dim>(
        core.cell, open, kind, [&](int axis, const Index<Dim>& face, const Index<Dim>& cell, int) {
          const double fraction = open[axis][face];
          yields.push_back({cell, layout.at(cell), fraction * fraction * cell_volume / core.mass});
        });
  }
  merge_yields(yields);
}

template <int Dim>
RowSpan PoissonOperator<Dim>::face_span(int axis, const Index<Dim>& start) const {
  if (axis == 0) {
    const RowSpan span = spans[layout.row_number(start)];
    return span.empty() ? RowSpan{} : RowSpan{span.begin, span.end + 1};
  }
  const RowSpan above = start[axis] < layout.cells[axis] ? spans[layout.row_number(start)] : RowSpan{};
  return start[axis] > 0 ? united(above, spans[layout.row_number(shifted<Dim>(start, axis, -1))]) : above;
}

/// The sum of f(place, what the conductances alone make of A x) over the cells in the spans, in a fixed order.
template <int Dim>
template <class F>
double PoissonOperator<Dim>::sum_over_products(const std::vector<double>& x, F&& f) const {
  if (!has_still_) return sum_over_cells_in_spans(x, f);
  const double* resistance = resistance_.data();
  return sum_over_cells_in_spans(x,
                                 [&](std::ptrdiff_t n, double value) { return f(n, resistance[n] > 0 ? value : 0.0); });
}

template <int Dim>
template <class F>
double PoissonOperator<Dim>::sum_over_cells_in_spans(const std::vector<double>& x, F&& f) const {
  return layout.sum_over_rows([&](std::size_t number, const Index<Dim>& start) {
    double sum = 0;
    for (int parity = 0; parity < 2; ++parity) {
      const RowSpan span = layout.in_parity(spans[number], parity);
      const std::ptrdiff_t own = layout.own(start, parity), left = layout.left(start, parity), right = left + 1;
      const double* xc = x.data() + own;
      const double* xl = x.data() + left;
      const double* xr = x.data() + right;
      const double* cl = conductance[0].data() + own;
      const double* cr = conductance[0].data() + right;
      sum += lane_sum(span.begin, span.end, [&](int m) {
        double value = cl[m] * (xc[m] - xl[m]) + cr[m] * (xc[m] - xr[m]);
        for (int k = 1; k < Dim; ++k) {
          const std::ptrdiff_t s = layout.stride[k];
          const double* c = conductance[k].data() + own;
          value += c[m] * (xc[m] - xc[m - s]) + c[m + s] * (xc[m] - xc[m + s]);
        }
        return f(own + m, value);
      });
    }
    return sum;
  });
}

template <int Dim>
double PoissonOperator<Dim>::apply(std::vector<double>& y, const std::vector<double>& x) const {
  double* out = y.data();
  const double* in = x.data();
  double product = sum_over_products(x, [=](std::ptrdiff_t n, double value) {
    out[n] = value;
    return in[n] * value;
  });
  for (const YieldTerm<Dim>& term : yields) {
    out[term.place] += term.value * in[term.place];
    product += term.value * in[term.place] * in[term.place];
  }
  return product;
}

template <int Dim>
double PoissonOperator<Dim>::residual(std::vector<double>& y, const std::vector<double>& x,
                                      const std::vector<double>& b) const {
  double* out = y.data();
  const double* right = b.data();
  double norm2 = sum_over_products(x, [=](std::ptrdiff_t n, double value) {
    out[n] = right[n] - value;
    return out[n] * out[n];
  });
  for (const YieldTerm<Dim>& term : yields) {
    double& r = out[term.place];
    norm2 -= r * r;
    r -= term.value * x[static_cast<std::size_t>(term.place)];
    norm2 += r * r;
  }
  return norm2;
}

template <int Dim>
bool PoissonOperator<Dim>::is_open(std::ptrdiff_t place) const {
  const double resistance = resistance_[static_cast<std::size_t>(place)];
  return resistance > 0 && resistance < closed;
}

template <int Dim>
void PoissonOperator<Dim>::clear_closed(std::vector<double>& x) const {
  parallel_for(
      layout.size, [&](std::size_t n) { x[n] = resistance_[n] > 0 && resistance_[n] < closed ? x[n] : 0; }, 8192);
}

template <int Dim>
std::size_t PoissonOperator<Dim>::bytes() const {
  std::size_t sum = spindrift::bytes(spans, resistance_) + spindrift::bytes(yields);
  for (const auto& c : conductance) sum += spindrift::bytes(c);
  return sum;
}

template <int Dim>
void merge_yields(std::vector<YieldTerm<Dim>>& yields) {
  std::sort(yields.begin(), yields.end(),
            [](const YieldTerm<Dim>& a, const YieldTerm<Dim>& b) { return a.place < b.place; });
  std::size_t n = 0;
  for (const YieldTerm<Dim>& term : yields) {
    if (n > 0 && yields[n - 1].place == term.place) {
      yields[n - 1].value += term.value;
    } else {
      yields[n++] = term;
    }
  }
  yields.resize(n);
}

template void merge_yields<2>(std::vector<YieldTerm<2>>&);
template void merge_yields<3>(std::vector<YieldTerm<3>>&);
template struct PoissonOperator<2>;
template struct PoissonOperator<3>;

}  // namespace spindrift
