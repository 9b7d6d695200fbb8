#include "grid/multigrid.hpp"

#include <algorithm>

namespace spindrift {

namespace {

constexpr int n_sweeps = 2;           // before and after the coarse correction
constexpr int n_coarsest_sweeps = 8;  // on at most 2^Dim cells
constexpr int chunk = 64;             // half columns that pass through a local buffer between two levels
enum Colour { red = 0, black = 1 };

template <int Dim>
Index<Dim> halved(Index<Dim> cells) {
  for (int& n : cells) n = (n + 1) / 2;
  return cells;
}

/// own half column m of one parity of a row, and where its neighbours and faces are.
template <int Dim>
struct Lanes {
  const float *cl, *cr, *xl, *xr, *b, *d;
  std::array<const float*, Dim> c;
  std::array<std::ptrdiff_t, Dim> stride;
  float* x;

  Lanes(MultigridLevel<Dim>& level, const Index<Dim>& start, int parity) {
    const ParityLayout<Dim>& layout = level.layout;
    const std::ptrdiff_t own = layout.own(start, parity), left = layout.left(start, parity);
    cl = level.conductance[0].data() + own;
    cr = level.conductance[0].data() + left + 1;
    x = level.solution.data() + own;
    xl = level.solution.data() + left;
    xr = level.solution.data() + left + 1;
    b = level.right_side.data() + own;
    d = level.inverse_diagonal.data() + own;
    stride = layout.stride;
    for (int k = 1; k < Dim; ++k) c[k] = level.conductance[k].data() + own;
  }
  /// The sum of what flows in from the neighbours and the source.
  float inflow(int m) const {
    float sum = b[m] + cl[m] * xl[m] + cr[m] * xr[m];
    for (int k = 1; k < Dim; ++k) sum += c[k][m] * x[m - stride[k]] + c[k][m + stride[k]] * x[m + stride[k]];
    return sum;
  }
  float residual(int m) const {
    float sum = b[m] + cl[m] * (xl[m] - x[m]) + cr[m] * (xr[m] - x[m]);
    for (int k = 1; k < Dim; ++k) {
      sum += c[k][m] * (x[m - stride[k]] - x[m]) + c[k][m + stride[k]] * (x[m + stride[k]] - x[m]);
    }
    return sum;
  }
};

template <int Dim>
void relax(MultigridLevel<Dim>& level, std::size_t number, Colour colour) {
  const Index<Dim> start = level.layout.row_start(number);
  const RowSpan span = level.spans[number];
  const Lanes<Dim> at(level, start, level.layout.row_colour(start) ^ colour);
#pragma GCC ivdep
  for (int m = span.begin; m < span.end; ++m) at.x[m] = at.inflow(m) * at.d[m];
}

/// The red cells where all others are still zero.
template <int Dim>
void relax_from_zero(MultigridLevel<Dim>& level, std::size_t number) {
  const Index<Dim> start = level.layout.row_start(number);
  const RowSpan span = level.spans[number];
  const Lanes<Dim> at(level, start, level.layout.row_colour(start) ^ red);
  for (int m = span.begin; m < span.end; ++m) at.x[m] = at.b[m] * at.d[m];
}

/// first(row) on all rows, then second(row) on all rows, where the two touch different colours: the second follows one
/// slab of rows behind the first, while its data are still near. The slabs at the ends of a block wait for the first
/// pass of the neighbouring block.
template <int Dim, class First, class Second>
void pass(const ParityLayout<Dim>& layout, First&& first, Second&& second) {
  const auto n = static_cast<std::size_t>(layout.cells[Dim - 1]);
  if (n == 0) return;
  const std::size_t rows = layout.n_rows / n;
  const std::size_t block = std::max<std::size_t>(8, layout.rows_a_block / std::max<std::size_t>(rows, 1));
  const auto on_slab = [rows](std::size_t slab, auto&& f) {
    for (std::size_t row = slab * rows; row < (slab + 1) * rows; ++row) f(row);
  };
  auto together = [&](std::size_t begin, std::size_t end) {
    for (std::size_t slab = begin; slab < end; ++slab) {
      on_slab(slab, first);
      if (slab > begin && (slab - 1 > begin || begin == 0)) on_slab(slab - 1, second);
    }
    if (end == n && (end - 1 > begin || begin == 0)) on_slab(end - 1, second);
  };
  auto ends = [&](std::size_t begin, std::size_t end) {
    if (begin > 0) on_slab(begin, second);
    if (end < n && (end - 1 > begin || begin == 0)) on_slab(end - 1, second);
  };
  parallel_blocks(n, block, together);
  if (n > block) parallel_blocks(n, block, ends);
}

/// right side of the coarse level = sum of the fine residuals in a block. After a black half sweep only red cells have
/// one, and a block has exactly one red cell in each of its rows.
template <int Dim>
void restrict_residual(MultigridLevel<Dim>& coarse, MultigridLevel<Dim>& fine) {
  coarse.layout.for_each_row([&](std::size_t number, const Index<Dim>& start) {
    const RowSpan span = coarse.spans[number];
    float* even = coarse.right_side.data() + coarse.layout.row(start);
    float* odd = even + coarse.layout.pitch;
    for (int begin = 2 * span.begin; begin < 2 * span.end; begin += chunk) {
      const RowSpan part{begin, std::min(begin + chunk, 2 * span.end)};
      float sum[chunk] = {};
      for_each_fine_row<Dim>(start, fine.layout.cells, [&](const Index<Dim>& row) {
        const RowSpan here = common(part, fine.spans[fine.layout.row_number(row)]);
        const Lanes<Dim> at(fine, row, fine.layout.row_colour(row) ^ red);
        for (int m = here.begin; m < here.end; ++m) {
          sum[m - begin] += at.d[m] > 0 ? at.residual(m) : 0.0f;
        }
      });
      for (int m = 0; m < (part.end - begin) / 2; ++m) {
        even[begin / 2 + m] = sum[2 * m];
        odd[begin / 2 + m] = sum[2 * m + 1];
      }
    }
  });
}

/// What yields swallow of the residual: restrict_residual knows the conductances alone.
template <int Dim>
void restrict_yields(MultigridLevel<Dim>& coarse, const MultigridLevel<Dim>& fine) {
  for (const YieldTerm<Dim>& term : fine.yields) {
    int colour = 0;
    for (const int k : term.cell) colour ^= k & 1;
    if (colour != red) continue;
    Index<Dim> block = term.cell;
    for (int& k : block) k /= 2;
    coarse.right_side[static_cast<std::size_t>(coarse.layout.at(block))] -=
        static_cast<float>(term.value) * fine.solution[static_cast<std::size_t>(term.place)];
  }
}

/// Adds the coarse solution to the red cells of its block; the black half sweep that follows reads no black ones.
template <int Dim>
void add_correction(MultigridLevel<Dim>& fine, const MultigridLevel<Dim>& coarse) {
  coarse.layout.for_each_row([&](std::size_t number, const Index<Dim>& start) {
    const RowSpan span = coarse.spans[number];
    const float* even = coarse.solution.data() + coarse.layout.row(start);
    const float* odd = even + coarse.layout.pitch;
    for (int begin = 2 * span.begin; begin < 2 * span.end; begin += chunk) {
      const RowSpan part{begin, std::min(begin + chunk, 2 * span.end)};
      float value[chunk];
      for (int m = 0; m < (part.end - begin) / 2; ++m) {
        value[2 * m] = even[begin / 2 + m];
        value[2 * m + 1] = odd[begin / 2 + m];
      }
      for_each_fine_row<Dim>(start, fine.layout.cells, [&](const Index<Dim>& row) {
        const RowSpan here = common(part, fine.spans[fine.layout.row_number(row)]);
        const Lanes<Dim> at(fine, row, fine.layout.row_colour(row) ^ red);
        for (int m = here.begin; m < here.end; ++m) at.x[m] += at.d[m] > 0 ? value[m - begin] : 0.0f;
      });
    }
  });
}

}  // namespace

template <int Dim>
Multigrid<Dim>::Multigrid(Index<Dim> cells) {
  levels_.emplace_back(cells);
  const auto is_small = [](int n) { return n <= 2; };
  while (!std::all_of(cells.begin(), cells.end(), is_small)) {
    cells = halved<Dim>(cells);
    levels_.emplace_back(cells);
  }
}

template <int Dim>
void Multigrid<Dim>::build(const PoissonOperator<Dim>& poisson) {
  MultigridLevel<Dim>& finest = levels_.front();
  std::copy(poisson.spans.begin(), poisson.spans.end(), finest.spans.begin());
  finest.yields.assign(poisson.yields.begin(), poisson.yields.end());
  for (int axis = 0; axis < Dim; ++axis) {
    float* c = finest.conductance[axis].data();
    const double* exact = poisson.conductance[axis].data();
    parallel_for(
        finest.layout.size, [=](std::size_t n) { c[n] = static_cast<float>(exact[n]); }, 8192);
  }
  set_diagonal(finest);
  if (poisson.has_still()) {
    float* d = finest.inverse_diagonal.data();
    parallel_for(
        finest.layout.size, [&](std::size_t n) { d[n] = poisson.is_open(static_cast<std::ptrdiff_t>(n)) ? d[n] : 0; },
        8192);
  }
  for (std::size_t depth = 1; depth < levels_.size(); ++depth) {
    coarsen(levels_[depth], levels_[depth - 1]);
    if (poisson.has_still()) keep_unknowns(levels_[depth], levels_[depth - 1]);
  }
}

template <int Dim>
void Multigrid<Dim>::cycle(std::size_t depth) {
  MultigridLevel<Dim>& level = levels_[depth];
  const bool coarsest = depth + 1 == levels_.size();
  const int sweeps = coarsest ? n_coarsest_sweeps : n_sweeps;
  const auto start_red = [&](std::size_t row) { relax_from_zero(level, row); };
  const auto relax_red = [&](std::size_t row) { relax(level, row, red); };
  const auto relax_black = [&](std::size_t row) { relax(level, row, black); };
  pass(level.layout, start_red, relax_black);
  for (int sweep = 1; sweep < sweeps; ++sweep) pass(level.layout, relax_red, relax_black);
  if (!coarsest) {
    restrict_residual(levels_[depth + 1], level);
    restrict_yields(levels_[depth + 1], level);
    cycle(depth + 1);
    add_correction(level, levels_[depth + 1]);
  }
  for (int sweep = 0; sweep < sweeps; ++sweep) pass(level.layout, relax_black, relax_red);
}

template <int Dim>
void Multigrid<Dim>::clear() {
  for (MultigridLevel<Dim>& level : levels_) {
    std::fill(level.solution.begin(), level.solution.end(), 0.0f);
    std::fill(level.right_side.begin(), level.right_side.end(), 0.0f);
  }
}

template <int Dim>
std::size_t Multigrid<Dim>::bytes() const {
  std::size_t sum = 0;
  for (const MultigridLevel<Dim>& level : levels_) {
    sum += spindrift::bytes(level.inverse_diagonal, level.solution, level.right_side, level.spans);
    for (const auto& c : level.conductance) sum += spindrift::bytes(c);
  }
  return sum;
}

template class Multigrid<2>;
template class Multigrid<3>;

}  // namespace spindrift
