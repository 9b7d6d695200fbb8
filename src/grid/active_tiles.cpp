#include "grid/active_tiles.hpp"

#include <algorithm>

#include "core/parallel.hpp"
#include "grid/pack.hpp"

namespace spindrift {
namespace {

constexpr int room_to_grow = 2;  // [tiles]

/// A tile of a window, counted in the whole grid.
template <int Dim>
Index<Dim> in_whole(Index<Dim> tile, const MacGrid<Dim>& window) {
  for (int k = 0; k < Dim; ++k) tile[k] += window.lower[k] / tile_edge<Dim>;
  return tile;
}

}  // namespace

template <int Dim>
ActiveTiles<Dim>::ActiveTiles(const MacGrid<Dim>& whole, const Sides& sides, const TileOptions& options)
    : whole_(whole), sides_(sides), options_(options), marks_(tiles_of<Dim>(whole.cells)), widened_(marks_) {}

template <int Dim>
void ActiveTiles<Dim>::clear() {
  marks_.fill(0);
  marked_.reset();
}

template <int Dim>
void ActiveTiles<Dim>::mark(const Range& tiles) {
  Index<Dim> shape;
  for (int k = 0; k < Dim; ++k) shape[k] = tiles.last[k] - tiles.first[k] + 1;
  for_each_index<Dim>(shape, [&](Index<Dim> i) {
    for (int k = 0; k < Dim; ++k) i[k] += tiles.first[k];
    marks_[i] = 1;
  });
  if (!marked_) marked_ = tiles;
  for (int k = 0; k < Dim; ++k) {
    marked_->first[k] = std::min(marked_->first[k], tiles.first[k]);
    marked_->last[k] = std::max(marked_->last[k], tiles.last[k]);
  }
}

template <int Dim>
void ActiveTiles<Dim>::add(const Vec<Dim>& place) {
  const Index<Dim> cell = whole_.cell_of(place);
  if (inside<Dim>(cell, whole_.cells)) mark({tile_of<Dim>(cell), tile_of<Dim>(cell)});
}

template <int Dim>
void ActiveTiles<Dim>::add(const Box<Dim>& box) {
  Range tiles{whole_.cell_of(box.lower), whole_.cell_of(box.upper)};
  for (int k = 0; k < Dim; ++k) {
    if (tiles.last[k] < 0 || tiles.first[k] >= whole_.cells[k]) return;
    tiles.first[k] = std::max(tiles.first[k], 0) / tile_edge<Dim>;
    tiles.last[k] = std::min(tiles.last[k], whole_.cells[k] - 1) / tile_edge<Dim>;
  }
  mark(tiles);
}

template <int Dim>
void ActiveTiles<Dim>::add(const Suspension<Dim>& air) {
  const MacGrid<Dim>& grid = air.grid();
  const Index<Dim> tiles = tiles_of<Dim>(grid.cells);
  Field<Dim, std::uint8_t> busy(tiles);
  const double smoke_mass = options_.clear_smoke * grid.cell_volume();
  // Rows of one layer of tiles are one task, so that no two write the same tile.
  const auto look = [&](const auto& field, double limit, std::size_t layer) {
    const Index<Dim>& shape = field.shape();
    Index<Dim> rows = shape;
    rows[0] = 1;
    rows[Dim - 1] = tile_edge<Dim>;
    for_each_index<Dim>(rows, [&](Index<Dim> start) {
      start[Dim - 1] += static_cast<int>(layer) * tile_edge<Dim>;
      if (start[Dim - 1] >= grid.cells[Dim - 1] || (Dim == 3 && start[1] >= grid.cells[1])) return;
      const double* row = field.row(start).data();
      const auto flags = busy.row(tile_of<Dim>(start));
      for (int tile = 0; tile < tiles[0]; ++tile) {
        const int begin = tile * tile_edge<Dim>, end = std::min(begin + tile_edge<Dim>, grid.cells[0]);
        const double most = max_packs(begin, end, [&]<class T>(int i) { return magnitude(load<T>(row + i)); });
        if (!(most <= limit)) flags[static_cast<std::size_t>(tile)] = 1;
      }
    });
  };
  parallel_for(
      static_cast<std::size_t>(tiles[Dim - 1]),
      [&](std::size_t layer) {
        look(air.smoke_mass(), smoke_mass, layer);
        for (const auto& u : air.velocity()) look(u, options_.still_speed, layer);
      },
      1);
  for_each_index<Dim>(tiles, [&](const Index<Dim>& tile) {
    if (!busy[tile]) return;
    const Index<Dim> here = in_whole<Dim>(tile, grid);
    mark({here, here});
  });
}

template <int Dim>
void ActiveTiles<Dim>::add_margin() {
  for (int step = 0; step < options_.margin && marked_; ++step) {
    Range around = *marked_;
    Index<Dim> shape, box;
    for (int k = 0; k < Dim; ++k) {
      around.first[k] = std::max(around.first[k] - 1, 0);
      around.last[k] = std::min(around.last[k] + 1, marks_.shape()[k] - 1);
      shape[k] = around.last[k] - around.first[k] + 1;
    }
    box.fill(3);
    const auto here = [&](Index<Dim> i) {
      for (int k = 0; k < Dim; ++k) i[k] += around.first[k];
      return i;
    };
    for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
      const Index<Dim> tile = here(i);
      std::uint8_t any = 0;
      for_each_index<Dim>(box, [&](const Index<Dim>& offset) {
        Index<Dim> other = tile;
        for (int k = 0; k < Dim; ++k) other[k] += offset[k] - 1;
        if (inside<Dim>(other, marks_.shape())) any |= marks_[other];
      });
      widened_[tile] = any;
    });
    for_each_index<Dim>(shape, [&](const Index<Dim>& i) { marks_[here(i)] = widened_[here(i)]; });
    marked_ = around;
  }
}

template <int Dim>
MacGrid<Dim> ActiveTiles<Dim>::cells_of(const Range& tiles) const {
  MacGrid<Dim> window = whole_;
  for (int k = 0; k < Dim; ++k) {
    window.lower[k] = tiles.first[k] * tile_edge<Dim>;
    window.cells[k] = std::min((tiles.last[k] + 1) * tile_edge<Dim>, whole_.cells[k]) - window.lower[k];
  }
  return window;
}

template <int Dim>
MacGrid<Dim> ActiveTiles<Dim>::window() const {
  return cells_of(marked_.value_or(Range{}));
}

template <int Dim>
MacGrid<Dim> ActiveTiles<Dim>::window(const MacGrid<Dim>& old) const {
  const MacGrid<Dim> least = window();
  Range tiles = marked_.value_or(Range{});
  bool fits = true;
  for (int k = 0; k < Dim; ++k) {
    const int old_first = old.lower[k] / tile_edge<Dim>, old_end = old_first + tiles_of<Dim>(old.cells)[k];
    if (tiles.first[k] < old_first) fits = false, tiles.first[k] = std::max(tiles.first[k] - room_to_grow, 0);
    if (tiles.last[k] >= old_end)
      fits = false, tiles.last[k] = std::min(tiles.last[k] + room_to_grow, marks_.shape()[k] - 1);
  }
  if (fits && count<Dim>(old.cells) <= 3 * count<Dim>(least.cells)) return old;
  return cells_of(tiles);
}

template <int Dim>
typename ActiveTiles<Dim>::Sides ActiveTiles<Dim>::sides(const MacGrid<Dim>& window) const {
  Sides sides = sides_;
  for (std::size_t k = 0; k < Dim; ++k) {
    if (window.lower[k] > 0) sides[k][0] = Side::open;
    if (window.lower[k] + window.cells[k] < whole_.cells[k]) sides[k][1] = Side::open;
  }
  return sides;
}

template <int Dim>
StillTiles<Dim> ActiveTiles<Dim>::still(const MacGrid<Dim>& window) const {
  StillTiles<Dim> still{Field<Dim, std::uint8_t>(tiles_of<Dim>(window.cells))};
  for_each_index<Dim>(still.tiles.shape(),
                      [&](const Index<Dim>& tile) { still.tiles[tile] = marks_[in_whole<Dim>(tile, window)] == 0; });
  return still;
}

template class ActiveTiles<2>;
template class ActiveTiles<3>;

}  // namespace spindrift
