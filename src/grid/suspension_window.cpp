#include <algorithm>
#include <utility>

#include "core/error.hpp"
#include "grid/suspension.hpp"

namespace spindrift {
namespace {

/// Copies the points that both fields have.   lower: of each one's first point in a lattice that they share
template <int Dim, class T>
void copy_shared(Field<Dim, T>& to, const Index<Dim>& to_lower, const Field<Dim, T>& from,
                 const Index<Dim>& from_lower) {
  Index<Dim> first, shape;
  for (int k = 0; k < Dim; ++k) {
    first[k] = std::max(to_lower[k], from_lower[k]);
    shape[k] = std::min(to_lower[k] + to.shape()[k], from_lower[k] + from.shape()[k]) - first[k];
    if (shape[k] <= 0) return;
  }
  const auto length = static_cast<std::size_t>(shape[0]);
  shape[0] = 1;
  for_each_index<Dim>(shape, [&](const Index<Dim>& row) {
    Index<Dim> source, target;
    for (int k = 0; k < Dim; ++k) {
      source[k] = first[k] + row[k] - from_lower[k];
      target[k] = first[k] + row[k] - to_lower[k];
    }
    std::copy_n(&from[source], length, &to[target]);
  });
}

}  // namespace

template <int Dim>
typename Suspension<Dim>::Forgotten Suspension<Dim>::move_window(const MacGrid<Dim>& window, const Sides& sides,
                                                                 const Field<Dim>& node_distance) {
  Forgotten forgotten{momentum(), total_smoke()};
  const FaceField<Dim> velocity = std::move(velocity_), carrier = std::move(carrier_);
  const Field<Dim> smoke = std::move(smoke_), pressure = projection_.pressure();
  const Field<Dim, CellKind> kind = std::move(kind_);
  const Index<Dim> lower = grid_.lower;
  const SuspensionOptions<Dim> options = options_;
  const bool disturbed = disturbed_;
  // What is not state goes before the new window is built, so that two are never held at a time.
  static_cast<void>(Suspension(std::move(*this)));

  *this = Suspension(window, sides, options);
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    copy_shared<Dim>(velocity_[axis], window.lower, velocity[axis], lower);
    copy_shared<Dim>(carrier_[axis], window.lower, carrier[axis], lower);
  }
  copy_shared<Dim>(smoke_, window.lower, smoke, lower);
  copy_shared<Dim>(kind_, window.lower, kind, lower);
  Field<Dim> shared_pressure(window.cells);
  copy_shared<Dim>(shared_pressure, window.lower, pressure, lower);
  projection_.set_pressure(shared_pressure);
  disturbed_ = disturbed;
  kinds_are_old_ = true;
  if (node_distance.size() > 0) {
    set_ground(node_distance);
  } else {
    update_active(0, window.cells[0]);
  }
  find_carrier_speeds();
  forgotten.momentum = momentum() - forgotten.momentum;
  forgotten.smoke -= total_smoke();
  return forgotten;
}

template <int Dim>
typename Suspension<Dim>::Forgotten Suspension<Dim>::set_still(const StillTiles<Dim>& still) {
  SPINDRIFT_CHECK(!still.any() || still.tiles.shape() == tiles_of<Dim>(grid_.cells));
  SPINDRIFT_CHECK(!still.any() || options_.wind.isZero());
  if (std::ranges::equal(still.tiles.values(), still_.tiles.values())) return {};
  Forgotten forgotten{momentum(), 0};
  still_ = still;
  const auto forget = [&](Field<Dim>& u, int axis) {
    for (std::size_t r = 0; r < u.n_rows(); ++r) {
      const Span kept = still_.faces(axis, u.row_start(r), grid_.cells);
      const auto row = u.row(r);
      std::fill(row.begin(), row.begin() + kept.begin, 0.0);
      std::fill(row.begin() + std::max(kept.begin, kept.end), row.end(), 0.0);
    }
  };
  const auto forget_all = [&](FaceField<Dim>& u) {
    for (int axis = 0; axis < Dim; ++axis) forget(u[static_cast<std::size_t>(axis)], axis);
  };
  forget_all(velocity_);
  forget_all(carrier_);
  advection_.for_each_buffer(forget_all);
  for (std::size_t r = 0; r < smoke_.n_rows(); ++r) {
    const auto row = smoke_.row(r);
    still_.for_each_run(smoke_.row_start(r), grid_.cells, [&](Span run, bool is_still) {
      if (!is_still) return;
      for (int i = run.begin; i < run.end; ++i) forgotten.smoke += std::exchange(row[static_cast<std::size_t>(i)], 0.0);
    });
  }
  for_each_index<Dim>(grid_.cells, [&](const Index<Dim>& cell) {
    CellKind& kind = kind_[cell];
    const bool is_still = still_(cell);
    if (is_still && kind != CellKind::solid) kind = CellKind::still;
    if (!is_still && kind == CellKind::still) kind = CellKind::open;
  });
  kinds_are_old_ = true;
  // Cells that are no unknowns any more must not keep anything in the solver.
  projection_.set_guess(std::vector<double>(projection_.guess()));
  update_active(0, grid_.cells[0]);
  update_rows();
  find_carrier_speeds();
  momentum_ = momentum();
  forgotten.momentum = *momentum_ - forgotten.momentum;
  return forgotten;
}

/// Of the faces that advection has to look at.
template <int Dim>
void Suspension<Dim>::update_rows() {
  for (int axis = 0; axis < Dim; ++axis) {
    auto& rows = rows_[static_cast<std::size_t>(axis)];
    rows = ground_.rows(axis);
    if (!still_.any()) continue;
    for (std::size_t r = 0; r < rows.size(); ++r) {
      const Span air = still_.faces(axis, velocity_[static_cast<std::size_t>(axis)].row_start(r), grid_.cells);
      rows[r] = {std::max(rows[r].begin, air.begin), std::min(rows[r].end, air.end)};
    }
  }
}

template class Suspension<2>;
template class Suspension<3>;

}  // namespace spindrift
