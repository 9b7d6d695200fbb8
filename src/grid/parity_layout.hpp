#pragma once
/// How the pressure solver lays out a box of cells: a row along the first axis is stored as its even columns, then its
/// odd columns, and the box has a frame of ghost cells. Red-black sweeps and coarsening by two then run through memory
/// with unit stride, without branches, and neighbouring colours never share a cell.

#include <algorithm>

#include "core/parallel.hpp"
#include "core/vec.hpp"

namespace spindrift {

/// The half columns [begin, end) of a row that hold its active cells.
struct RowSpan {
  int begin = 0, end = 0;
  bool empty() const { return begin >= end; }
};

inline RowSpan united(const RowSpan& a, const RowSpan& b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}
inline RowSpan common(const RowSpan& a, const RowSpan& b) {
  return {std::max(a.begin, b.begin), std::min(a.end, b.end)};
}

/// Cell i lies at row(i) + (i[0] odd ? pitch : 0) + i[0] / 2. Its right neighbour's half column is one more if i[0] is
/// odd, its left neighbour's one less if i[0] is even: ghost columns -1 and n fall into the padding, ghost rows follow
/// by stride. A face has the place of the cell whose lower face it is.
template <int Dim>
struct ParityLayout {
  Index<Dim> cells{};
  std::ptrdiff_t pitch = 0;                  ///< half columns of one parity, with padding
  std::array<std::ptrdiff_t, Dim> stride{};  ///< to the next row along each axis but the first
  std::size_t size = 0, n_rows = 0;
  std::size_t rows_a_block = 1;  ///< of parallel loops: fixed, so that sums do not depend on the threads

  ParityLayout() = default;
  explicit ParityLayout(const Index<Dim>& cells_) : cells(cells_) {
    constexpr std::ptrdiff_t lanes = 16;
    constexpr std::size_t cells_a_block = 8192;
    pitch = (half() + 2 + lanes - 1) / lanes * lanes;
    std::ptrdiff_t rows = 1;
    n_rows = 1;
    for (int k = 1; k < Dim; ++k) {
      stride[k] = rows * 2 * pitch;
      rows *= cells[k] + 2;
      n_rows *= static_cast<std::size_t>(cells[k]);
    }
    size = static_cast<std::size_t>(rows * 2 * pitch);
    rows_a_block = std::max<std::size_t>(1, cells_a_block / static_cast<std::size_t>(std::max(cells[0], 1)));
  }

  /// Half columns of a row: as many as it has even columns.
  int half() const { return (cells[0] + 1) / 2; }

  /// The part of a span that lies in one parity: the last odd half column of an odd number of cells is a ghost.
  RowSpan in_parity(const RowSpan& span, int parity) const {
    return {span.begin, std::min(span.end, (cells[0] + 1 - parity) / 2)};
  }

  /// Where the row that holds i starts.
  std::ptrdiff_t row(const Index<Dim>& i) const {
    std::ptrdiff_t at = 0;
    for (int k = 1; k < Dim; ++k) at += (i[k] + 1) * stride[k];
    return at;
  }
  /// Half column 0 of one parity in the row that starts at i, and the place of its left neighbour; right = left + 1.
  std::ptrdiff_t own(const Index<Dim>& i, int parity) const { return row(i) + parity * pitch; }
  std::ptrdiff_t left(const Index<Dim>& i, int parity) const { return parity == 0 ? row(i) + pitch - 1 : row(i); }
  std::ptrdiff_t at(const Index<Dim>& i) const { return row(i) + (i[0] & 1) * pitch + (i[0] >> 1); }

  /// The first cell of a row, rows counted in memory order.
  Index<Dim> row_start(std::size_t number) const {
    Index<Dim> i{};
    for (int k = 1; k < Dim; ++k) {
      i[k] = static_cast<int>(number % static_cast<std::size_t>(cells[k]));
      number /= static_cast<std::size_t>(cells[k]);
    }
    return i;
  }
  std::size_t row_number(const Index<Dim>& i) const {
    std::size_t number = 0;
    for (int k = Dim - 1; k >= 1; --k)
      number = number * static_cast<std::size_t>(cells[k]) + static_cast<std::size_t>(i[k]);
    return number;
  }
  /// Whether the even cells of a row are black: colour = sum of the indices mod 2.
  static int row_colour(const Index<Dim>& i) {
    int sum = 0;
    for (int k = 1; k < Dim; ++k) sum += i[k];
    return sum & 1;
  }

  /// f(row number, its first cell), in parallel.
  template <class F>
  void for_each_row(F&& f) const {
    parallel_for(
        n_rows, [&](std::size_t number) { f(number, row_start(number)); }, rows_a_block);
  }
  /// The sum of f(row number, its first cell), in fixed order.
  template <class F>
  double sum_over_rows(F&& f) const {
    return parallel_reduce(
        n_rows, 0.0,
        [&](std::size_t begin, std::size_t end) {
          double sum = 0;
          for (std::size_t number = begin; number < end; ++number) sum += f(number, row_start(number));
          return sum;
        },
        [](double a, double b) { return a + b; }, rows_a_block);
  }
};

/// The rows of faces normal to `axis`: across the rows one more than of cells, the last in the ghost row.
template <int Dim>
ParityLayout<Dim> face_rows(const Index<Dim>& cells, int axis) {
  return ParityLayout<Dim>(axis == 0 ? cells : shifted<Dim>(cells, axis, 1));
}

/// The sum of f(m) over [begin, end) in eight lanes, so that it vectorises and still has one order.
template <class F>
double lane_sum(int begin, int end, F&& f) {
  constexpr int n_lanes = 8;
  double lane[n_lanes] = {};
  int m = begin;
  for (; m + n_lanes <= end; m += n_lanes) {
    for (int k = 0; k < n_lanes; ++k) lane[k] += f(m + k);
  }
  for (; m < end; ++m) lane[0] += f(m);
  return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
}

}  // namespace spindrift
