#pragma once
/// Connected components of the open cells, and the pockets among them.

#include <array>
#include <vector>

#include "grid/cell_kind.hpp"
#include "grid/mac_grid.hpp"
#include "terrain/walls.hpp"

namespace spindrift {

/// Open cells that are joined by faces with an open fraction > 0. Reused from step to step as scratch; find() forgets
/// everything before.
template <int Dim>
class Components {
 public:
  struct Component {
    std::size_t n_cells = 0;
    bool reaches_open_side = false;  ///< or still air, through a face with an open fraction > 0
  };
  /// Consecutive cells [begin, end) of one row along the first axis.
  struct Run {
    int begin = 0, end = 0;
    std::uint32_t component = 0;
  };

  void find(const Field<Dim, CellKind>& kind, const FaceField<Dim>& open,
            const std::array<std::array<Side, 2>, Dim>& sides);

  /// In the order of their first cells.
  const std::vector<Component>& all() const { return all_; }
  std::vector<Component>& all() { return all_; }

  /// Calls f(first cell of the row, run) for every run, in memory order.
  template <class F>
  void for_each_run(F&& f) const {
    for (std::size_t row = 0; row + 1 < first_run_.size(); ++row) {
      if (first_run_[row] == first_run_[row + 1]) continue;
      const Index<Dim> start = row_start(row);
      for (std::size_t r = first_run_[row]; r < first_run_[row + 1]; ++r) f(start, runs_[r]);
    }
  }
  std::size_t bytes() const { return spindrift::bytes(runs_, first_run_, all_, number_, shut_in_); }

  /// Scratch of mark_pockets, one flag a component.
  std::vector<std::uint8_t>& shut_in() { return shut_in_; }

 private:
  Index<Dim> row_start(std::size_t row) const;
  std::uint32_t root(std::uint32_t run);
  void join_rows(std::size_t row, std::size_t below, std::span<const double> open);

  Index<Dim> cells_{};
  std::vector<Run> runs_;               ///< row by row; while find() works, `component` is the parent of a union-find
  std::vector<std::size_t> first_run_;  ///< of each row
  std::vector<Component> all_;
  std::vector<std::uint32_t> number_;
  std::vector<std::uint8_t> shut_in_;
};

/// Turns into CellKind::pocket the open cells whose component reaches no open side and has a core cell behind one of
/// its faces: moving core faces squeeze it, so no divergence-free velocity exists (R10). Two exceptions, which the
/// projection can handle: a component without a core face (a sealed box: its prescribed flux is zero), and, where no
/// component at all reaches an open side, the largest one (a closed domain is not a pocket; ties: the first).
/// kind  in-out: pockets of an earlier call count as what they are here, so set them back to open before
/// open  in: open area fraction of each face, 0..1
/// Returns the number of cells marked.   Source: paper Sec. 4.2; departure: R10.
template <int Dim>
std::size_t mark_pockets(Field<Dim, CellKind>& kind, const FaceField<Dim>& open,
                         const std::array<std::array<Side, 2>, Dim>& sides, Components<Dim>& scratch);

}  // namespace spindrift
