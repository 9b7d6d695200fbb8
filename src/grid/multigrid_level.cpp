#include "grid/multigrid_level.hpp"

namespace spindrift {

namespace {

/// The rows of faces that a coarse row of faces normal to `axis` covers.
template <int Dim, class F>
void for_each_fine_face_row(const Index<Dim>& coarse, int axis, const Index<Dim>& fine_cells, F&& f) {
  Index<Dim> layer = fine_cells;
  Index<Dim> in_layer = coarse;
  if (axis > 0) {
    layer[axis] = 1;
    in_layer[axis] = 0;
  }
  for_each_fine_row<Dim>(in_layer, layer, [&](Index<Dim> row) {
    if (axis > 0) row[axis] = std::min(2 * coarse[axis], fine_cells[axis]);
    f(row);
  });
}

}  // namespace

template <int Dim>
MultigridLevel<Dim>::MultigridLevel(const Index<Dim>& cells)
    : layout(cells),
      inverse_diagonal(layout.size, 0.0f),
      solution(layout.size, 0.0f),
      right_side(layout.size, 0.0f),
      spans(layout.n_rows) {
  for (auto& c : conductance) c.assign(layout.size, 0.0f);
}

template <int Dim>
void set_diagonal(MultigridLevel<Dim>& level) {
  const ParityLayout<Dim>& layout = level.layout;
  layout.for_each_row([&](std::size_t number, const Index<Dim>& start) {
    for (int parity = 0; parity < 2; ++parity) {
      const RowSpan span = layout.in_parity(level.spans[number], parity);
      const std::ptrdiff_t own = layout.own(start, parity), right = layout.left(start, parity) + 1;
      const float* cl = level.conductance[0].data() + own;
      const float* cr = level.conductance[0].data() + right;
      float* d = level.inverse_diagonal.data() + own;
      for (int m = span.begin; m < span.end; ++m) {
        float sum = cl[m] + cr[m];
        for (int k = 1; k < Dim; ++k) {
          const float* c = level.conductance[k].data() + own;
          sum += c[m] + c[m + layout.stride[k]];
        }
        d[m] = sum > 0 ? 1 / sum : 0;
      }
    }
  });
  for (const YieldTerm<Dim>& term : level.yields) {
    float& d = level.inverse_diagonal[static_cast<std::size_t>(term.place)];
    d = static_cast<float>(1 / ((d > 0 ? 1.0 / static_cast<double>(d) : 0.0) + term.value));
  }
}

template <int Dim>
void coarsen(MultigridLevel<Dim>& coarse, const MultigridLevel<Dim>& fine) {
  const Index<Dim>& cells = fine.layout.cells;
  coarse.layout.for_each_row([&](std::size_t number, const Index<Dim>& start) {
    RowSpan span;
    for_each_fine_row<Dim>(start, cells, [&](const Index<Dim>& row) {
      const RowSpan s = fine.spans[fine.layout.row_number(row)];
      if (!s.empty()) span = united(span, {s.begin / 2, (s.end + 1) / 2});
    });
    coarse.spans[number] = span;
  });
  for (int axis = 0; axis < Dim; ++axis) {
    const int half = fine.layout.half();
    const float upper_factor = cells[axis] % 2 == 0 ? 0.5f : 1.0f;
    face_rows<Dim>(coarse.layout.cells, axis).for_each_row([&](std::size_t, const Index<Dim>& start) {
      float* even = coarse.conductance[axis].data() + coarse.layout.row(start);
      float* odd = even + coarse.layout.pitch;
      std::fill(even, even + 2 * coarse.layout.pitch, 0.0f);
      const float factor = axis > 0 && start[axis] == coarse.layout.cells[axis] ? upper_factor : 0.5f;
      float upper = 0;
      for_each_fine_face_row<Dim>(start, axis, cells, [&](const Index<Dim>& row) {
        const float* c_even = fine.conductance[axis].data() + fine.layout.row(row);
        const float* c_odd = c_even + fine.layout.pitch;
        // Along a row, a face is one of the fine faces; across, it has both columns.
        const auto fine_sum = [&](int i) { return axis == 0 ? c_even[i] : c_even[i] + c_odd[i]; };
        for (int m = 0; m < (half + 1) / 2; ++m) {
          even[m] += factor * fine_sum(2 * m);
          odd[m] += factor * fine_sum(2 * m + 1);
        }
        upper += upper_factor * (cells[0] % 2 == 0 ? c_even[half] : c_odd[half - 1]);
      });
      if (axis == 0) (half % 2 == 0 ? even : odd)[half / 2] = upper;
    });
  }
  coarse.yields.clear();
  for (const YieldTerm<Dim>& term : fine.yields) {
    Index<Dim> block = term.cell;
    for (int& k : block) k /= 2;
    coarse.yields.push_back({block, coarse.layout.at(block), term.value});
  }
  merge_yields(coarse.yields);
  set_diagonal(coarse);
}

template <int Dim>
void keep_unknowns(MultigridLevel<Dim>& coarse, const MultigridLevel<Dim>& fine) {
  coarse.layout.for_each_row([&](std::size_t number, const Index<Dim>& start) {
    const RowSpan span = coarse.spans[number];
    float* even = coarse.inverse_diagonal.data() + coarse.layout.row(start);
    float* odd = even + coarse.layout.pitch;
    const int n = std::min(2 * span.end, coarse.layout.cells[0]);
    for (int i = 2 * span.begin; i < n; ++i) {
      bool any = false;
      for_each_fine_row<Dim>(start, fine.layout.cells, [&](const Index<Dim>& row) {
        const float* d = fine.inverse_diagonal.data() + fine.layout.row(row) + i;
        any = any || d[0] > 0 || d[fine.layout.pitch] > 0;
      });
      if (!any) (i % 2 == 0 ? even : odd)[i / 2] = 0;
    }
  });
}

template struct MultigridLevel<2>;
template struct MultigridLevel<3>;
template void set_diagonal<2>(MultigridLevel<2>&);
template void set_diagonal<3>(MultigridLevel<3>&);
template void keep_unknowns<2>(MultigridLevel<2>&, const MultigridLevel<2>&);
template void keep_unknowns<3>(MultigridLevel<3>&, const MultigridLevel<3>&);
template void coarsen<2>(MultigridLevel<2>&, const MultigridLevel<2>&);
template void coarsen<3>(MultigridLevel<3>&, const MultigridLevel<3>&);

}  // namespace spindrift
