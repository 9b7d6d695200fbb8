#pragma once
/// Where in a large domain the air is computed: tiles of cells with smoke, moving air or snow, and a margin of tiles
/// around them.

#include "grid/suspension.hpp"

namespace spindrift {

struct TileOptions {
  int margin = 1;             ///< [tiles]
  double still_speed = 0.1;   ///< [m s^-1]: slower air counts as air at rest
  double clear_smoke = 1e-3;  ///< [kg m^-3]: thinner smoke counts as clear air
};

template <int Dim>
class ActiveTiles {
 public:
  using Sides = std::array<std::array<Side, 2>, Dim>;

  /// whole, sides: the grid of the domain, which need not exist in memory
  ActiveTiles(const MacGrid<Dim>& whole, const Sides& sides, const TileOptions& options);

  /// Marks tiles: none; that of a place; those that a box touches; those with smoke or moving air.
  void clear();
  void add(const Vec<Dim>& place);
  void add(const Box<Dim>& box);
  void add(const Suspension<Dim>& air);
  /// Marks the neighbours of marked tiles, `margin` times.
  void add_margin();

  /// Calls f(the box of its cells, inside the whole grid) for every marked tile.
  template <class F>
  void for_each_marked(F&& f) const {
    if (!marked_) return;
    Index<Dim> shape;
    for (int k = 0; k < Dim; ++k) shape[k] = marked_->last[k] - marked_->first[k] + 1;
    for_each_index<Dim>(shape, [&](Index<Dim> tile) {
      for (int k = 0; k < Dim; ++k) tile[k] += marked_->first[k];
      if (!marks_[tile]) return;
      const MacGrid<Dim> cells = cells_of({tile, tile});
      Index<Dim> end{};
      for (int k = 0; k < Dim; ++k) end[k] = cells.cells[k];
      f(Box<Dim>{cells.node(Index<Dim>{}), cells.node(end)});
    });
  }

  /// A box of tiles that holds the marked ones: `old` where it does and is not far too large, else with room to grow
  /// where they reach out of `old`. One tile in the grid's corner where none is marked.
  MacGrid<Dim> window(const MacGrid<Dim>& old) const;
  /// The smallest such box.
  MacGrid<Dim> window() const;
  /// Sides of a window: the domain's where that ends there, open elsewhere.
  Sides sides(const MacGrid<Dim>& window) const;
  /// 1 for the tiles of a window that are not marked.
  StillTiles<Dim> still(const MacGrid<Dim>& window) const;

  const MacGrid<Dim>& whole() const { return whole_; }
  std::size_t bytes() const { return marks_.bytes() + widened_.bytes(); }

 private:
  struct Range {
    Index<Dim> first, last;  ///< tiles, both included
  };
  void mark(const Range& tiles);
  MacGrid<Dim> cells_of(const Range& tiles) const;

  MacGrid<Dim> whole_;
  Sides sides_;
  TileOptions options_;
  Field<Dim, std::uint8_t> marks_, widened_;  ///< 1: marked, one a tile of the whole grid; scratch
  std::optional<Range> marked_;               ///< the smallest range that holds all marked tiles
};

}  // namespace spindrift
