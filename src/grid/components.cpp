#include "grid/components.hpp"

#include <algorithm>

namespace spindrift {
namespace {

/// Whether a cell of some kind lies behind an open face of a run's cells.
template <int Dim>
bool touches(CellKind wanted, const Index<Dim>& start, int begin, int end, const Field<Dim, CellKind>& kind,
             const FaceField<Dim>& open) {
  for (Index<Dim> i = start; begin < end; ++begin) {
    i[0] = begin;
    for (int axis = 0; axis < Dim; ++axis) {
      for (int upper = 0; upper < 2; ++upper) {
        const Index<Dim> neighbour = shifted<Dim>(i, axis, 2 * upper - 1);
        if (inside<Dim>(neighbour, kind.shape()) && kind[neighbour] == wanted &&
            open[axis][shifted<Dim>(i, axis, upper)] > 0) {
          return true;
        }
      }
    }
  }
  return false;
}

}  // namespace

template <int Dim>
Index<Dim> Components<Dim>::row_start(std::size_t row) const {
  Index<Dim> shape = cells_;
  shape[0] = 1;
  return unflat<Dim>(row, shape);
}

template <int Dim>
std::uint32_t Components<Dim>::root(std::uint32_t run) {
  while (runs_[run].component != run) {
    std::uint32_t& parent = runs_[run].component;
    run = parent = runs_[parent].component;
  }
  return run;
}

template <int Dim>
void Components<Dim>::join_rows(std::size_t row, std::size_t below, std::span<const double> open) {
  std::size_t a = first_run_[below], b = first_run_[row];
  const std::size_t a_end = first_run_[below + 1], b_end = runs_.size();
  while (a < a_end && b < b_end) {
    int i = std::max(runs_[a].begin, runs_[b].begin);
    const int end = std::min(runs_[a].end, runs_[b].end);
    while (i < end && !(open[static_cast<std::size_t>(i)] > 0)) ++i;
    if (i < end) {
      const std::uint32_t p = root(static_cast<std::uint32_t>(a)), q = root(static_cast<std::uint32_t>(b));
      runs_[std::max(p, q)].component = std::min(p, q);
    }
    runs_[a].end < runs_[b].end ? ++a : ++b;
  }
}

template <int Dim>
void Components<Dim>::find(const Field<Dim, CellKind>& kind, const FaceField<Dim>& open,
                           const std::array<std::array<Side, 2>, Dim>& sides) {
  cells_ = kind.shape();
  const std::size_t n_rows = cells_[0] > 0 ? kind.size() / static_cast<std::size_t>(cells_[0]) : 0;
  runs_.clear();
  first_run_.assign(1, 0);
  all_.clear();
  for (std::size_t row = 0; row < n_rows; ++row) {
    const Index<Dim> start = row_start(row);
    const auto kinds = kind.row(start);
    const auto faces = open[0].row(start);
    const std::size_t n = kinds.size();
    for (std::size_t i = 0; i < n;) {
      while (i < n && kinds[i] != CellKind::open) ++i;
      if (i == n) break;
      const std::size_t begin = i++;
      while (i < n && kinds[i] == CellKind::open && faces[i] > 0) ++i;
      runs_.push_back({static_cast<int>(begin), static_cast<int>(i), static_cast<std::uint32_t>(runs_.size())});
    }
    std::size_t rows_between = 1;
    for (int axis = 1; axis < Dim; ++axis) {
      if (start[axis] > 0) join_rows(row, row - rows_between, open[axis].row(start));
      rows_between *= static_cast<std::size_t>(cells_[axis]);
    }
    first_run_.push_back(runs_.size());
  }

  number_.resize(runs_.size());
  for (std::uint32_t r = 0; r < runs_.size(); ++r) {
    const std::uint32_t parent = runs_[r].component;
    if (parent == r) {
      number_[r] = static_cast<std::uint32_t>(all_.size());
      all_.emplace_back();
    } else {
      number_[r] = number_[parent];
    }
  }
  for (std::size_t r = 0; r < runs_.size(); ++r) runs_[r].component = number_[r];

  const bool any_still = std::ranges::find(kind.values(), CellKind::still) != kind.values().end();
  for_each_run([&](const Index<Dim>& start, const Run& run) {
    Component& component = all_[run.component];
    component.n_cells += static_cast<std::size_t>(run.end - run.begin);
    if (component.reaches_open_side) return;
    component.reaches_open_side = any_still && touches<Dim>(CellKind::still, start, run.begin, run.end, kind, open);
    for (int axis = 0; axis < Dim; ++axis) {
      for (int upper = 0; upper < 2; ++upper) {
        if (sides[axis][upper] != Side::open) continue;
        const int face = upper == 0 ? 0 : cells_[axis];
        if (axis == 0) {
          if ((upper == 0 ? run.begin : run.end) != face) continue;
          component.reaches_open_side |= open[0].row(start)[static_cast<std::size_t>(face)] > 0;
        } else {
          if (start[axis] + upper != face) continue;
          const auto fractions = open[axis].row(shifted<Dim>(start, axis, upper));
          component.reaches_open_side |= std::any_of(fractions.begin() + run.begin, fractions.begin() + run.end,
                                                     [](double fraction) { return fraction > 0; });
        }
      }
    }
  });
}

template <int Dim>
std::size_t mark_pockets(Field<Dim, CellKind>& kind, const FaceField<Dim>& open,
                         const std::array<std::array<Side, 2>, Dim>& sides, Components<Dim>& scratch) {
  scratch.find(kind, open, sides);
  const auto& all = scratch.all();
  std::vector<std::uint8_t>& shut_in = scratch.shut_in();
  shut_in.assign(all.size(), 0);
  scratch.for_each_run([&](const Index<Dim>& start, const auto& run) {
    std::uint8_t& flag = shut_in[run.component];
    if (all[run.component].reaches_open_side || flag) return;
    flag = touches<Dim>(CellKind::core, start, run.begin, run.end, kind, open);
  });
  const bool closed_domain =
      std::none_of(all.begin(), all.end(), [](const auto& component) { return component.reaches_open_side; });
  if (closed_domain && !all.empty()) {
    const auto largest =
        std::max_element(all.begin(), all.end(), [](const auto& a, const auto& b) { return a.n_cells < b.n_cells; });
    shut_in[static_cast<std::size_t>(largest - all.begin())] = 0;
  }
  std::size_t n_marked = 0;
  scratch.for_each_run([&](const Index<Dim>& start, const auto& run) {
    if (!shut_in[run.component]) return;
    const auto kinds = kind.row(start);
    std::fill(kinds.begin() + run.begin, kinds.begin() + run.end, CellKind::pocket);
    n_marked += static_cast<std::size_t>(run.end - run.begin);
  });
  return n_marked;
}

template class Components<2>;
template class Components<3>;
template std::size_t mark_pockets<2>(Field<2, CellKind>&, const FaceField<2>&,
                                     const std::array<std::array<Side, 2>, 2>&, Components<2>&);
template std::size_t mark_pockets<3>(Field<3, CellKind>&, const FaceField<3>&,
                                     const std::array<std::array<Side, 2>, 3>&, Components<3>&);

}  // namespace spindrift
