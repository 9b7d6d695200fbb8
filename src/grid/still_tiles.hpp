#pragma once
/// Tiles of a grid whose air is at rest and is not computed.

#include <cstdint>

#include "grid/field.hpp"
#include "grid/span.hpp"

namespace spindrift {

template <int Dim>
inline constexpr int tile_edge = Dim == 2 ? 16 : 8;  ///< of a tile [cells]

/// The tile that holds a cell.
template <int Dim>
Index<Dim> tile_of(Index<Dim> cell) {
  for (int& k : cell) k /= tile_edge<Dim>;
  return cell;
}

/// Tiles that fill `cells`, those at the upper ends cut off.
template <int Dim>
Index<Dim> tiles_of(Index<Dim> cells) {
  for (int& n : cells) n = (n + tile_edge<Dim> - 1) / tile_edge<Dim>;
  return cells;
}

/// 1: still, one a tile; without tiles no cell is still.
template <int Dim>
struct StillTiles {
  Field<Dim, std::uint8_t> tiles;

  bool any() const { return tiles.size() > 0; }
  bool operator()(const Index<Dim>& cell) const { return any() && tiles[tile_of<Dim>(cell)] != 0; }
  /// Calls f(run of cells along the row at `start`, whether they are still) for runs that fill it.
  template <class F>
  void for_each_run(const Index<Dim>& start, const Index<Dim>& cells, F&& f) const {
    if (!any()) return f(Span{0, cells[0]}, false);
    const auto row = tiles.row(tile_of<Dim>(start));
    for (std::size_t begin = 0, end = 0; begin < row.size(); begin = end) {
      while (end < row.size() && row[end] == row[begin]) ++end;
      f(Span{static_cast<int>(begin) * tile_edge<Dim>, std::min(static_cast<int>(end) * tile_edge<Dim>, cells[0])},
        row[begin] != 0);
    }
  }
  /// The faces of a row of faces normal to `axis`, from its first to its last that is a face of a cell that is not
  /// still.   start: the row's first face;   cells: of the grid
  Span faces(int axis, const Index<Dim>& start, const Index<Dim>& cells) const {
    if (!any()) return {0, axis == 0 ? cells[0] + 1 : cells[0]};
    Span span;
    for (const int side : {-1, 0}) {
      Index<Dim> cell = start;
      if (axis != 0) cell[axis] += side;
      if (cell[axis] < 0 || cell[axis] >= cells[axis]) continue;
      const auto row = tiles.row(tile_of<Dim>(cell));
      const int n = static_cast<int>(row.size());
      Span of_row{0, n};
      while (of_row.begin < n && row[static_cast<std::size_t>(of_row.begin)]) ++of_row.begin;
      while (of_row.end > of_row.begin && row[static_cast<std::size_t>(of_row.end) - 1]) --of_row.end;
      span = joined(span, of_row);
      if (axis == 0) break;
    }
    if (span.empty()) return {};
    return {span.begin * tile_edge<Dim>, std::min(span.end * tile_edge<Dim>, cells[0]) + (axis == 0 ? 1 : 0)};
  }
};

}  // namespace spindrift
