#include "grid/ground.hpp"

#include <cstring>
#include <string>

#include "core/error.hpp"
#include "grid/open_fractions.hpp"

namespace spindrift {
namespace {

constexpr std::uint8_t deep = 255;

/// Calls f(index) for the points of `shape` in the columns [begin, end).
template <int Dim, class F>
void for_each_in_columns(const Index<Dim>& shape, int begin, int end, F&& f) {
  Index<Dim> part = shape;
  part[0] = end - begin;
  for_each_index<Dim>(part, [&](const Index<Dim>& i) { f(shifted<Dim>(i, 0, begin)); });
}

/// Distances at the corners of the box at node `i` that spans the axes other than `flat_axis` (Dim: all axes).
template <int K, int Dim>
std::array<double, std::size_t{1} << K> corners(const Field<Dim>& distance, const Index<Dim>& i, int flat_axis) {
  std::array<double, std::size_t{1} << K> d;
  for (std::size_t c = 0; c < d.size(); ++c) {
    Index<Dim> node = i;
    int bit = 0;
    for (int axis = 0; axis < Dim; ++axis)
      if (axis != flat_axis) node[axis] += static_cast<int>((c >> bit++) & 1);
    d[c] = distance[node];
  }
  return d;
}

/// Calls f(pointer) for the bytes that are not 0.
template <class F>
void for_each_nonzero(const std::uint8_t* begin, const std::uint8_t* end, F&& f) {
  for (const std::uint8_t* byte = begin; byte < end; ++byte) {
    std::uint64_t eight = 0;
    while (end - byte >= 8 && (std::memcpy(&eight, byte, 8), eight == 0)) byte += 8;
    if (byte < end && *byte != 0) f(byte);
  }
}

}  // namespace

template <int Dim>
Ground<Dim>::Ground(const MacGrid<Dim>& grid, double air_density)
    : grid_(grid),
      air_density_(air_density),
      open_(make_face_field<Dim>(grid, 1.0)),
      volume_(grid.cells, grid.cell_volume()),
      air_mass_(make_face_field<Dim>(grid)),
      layer_(make_face_field<Dim, std::uint8_t>(grid)),
      small_(grid.cells) {
  for (int axis = 0; axis < Dim; ++axis) set_air_mass(axis, 0, grid.cells[0]);
  set_lists();
}

template <int Dim>
void Ground<Dim>::set(const Field<Dim>& node_distance, std::span<const Span> columns) {
  SPINDRIFT_CHECK(node_distance.shape() == grid_.nodes());
  for (const auto& [begin, end] : columns) {
    for_each_in_columns<Dim>(grid_.nodes(), begin, end + 1, [&](const Index<Dim>& i) {
      if (std::isfinite(node_distance[i])) return;
      std::string where;
      for (const int k : i) where += " " + std::to_string(k);
      throw Error(ExitCode::bad_input, "distance to the ground is not finite at node" + where);
    });
  }
  for (const auto& [begin, end] : columns) {
    set_fractions(node_distance, begin, end);
    for (int axis = 0; axis < Dim; ++axis) {
      set_air_mass(axis, std::max(begin - 1, 0), std::min(end + 1, grid_.cells[0]));
      set_layers(axis, begin, end);
    }
  }
  set_lists();
}

template <int Dim>
void Ground<Dim>::set_fractions(const Field<Dim>& node_distance, int begin, int end) {
  for (int axis = 0; axis < Dim; ++axis) {
    for_each_in_columns<Dim>(grid_.faces(axis), begin, axis == 0 ? end + 1 : end, [&](const Index<Dim>& i) {
      const double fraction = open_fraction<Dim - 1>(corners<Dim - 1, Dim>(node_distance, i, axis));
      open_[axis][i] = fraction < smallest_opening ? 0 : fraction;
    });
  }
  const double whole = grid_.cell_volume();
  for_each_in_columns<Dim>(grid_.cells, begin, end, [&](const Index<Dim>& i) {
    double largest_opening = 0;
    for (int axis = 0; axis < Dim; ++axis)
      largest_opening = std::max({largest_opening, open_[axis][i], open_[axis][shifted<Dim>(i, axis, 1)]});
    const double fraction = open_fraction<Dim>(corners<Dim, Dim>(node_distance, i, Dim));
    volume_[i] = largest_opening > 0 ? whole * std::max(fraction, smallest_volume) : 0;
    small_[i] = volume_[i] > 0 && is_small(volume_[i]);
  });
}

template <int Dim>
void Ground<Dim>::set_air_mass(int axis, int begin, int end) {
  const auto axis_end = axis == 0 ? end + 1 : end;
  for_each_in_columns<Dim>(grid_.faces(axis), begin, axis_end, [&](const Index<Dim>& i) {
    air_mass_[axis][i] = open_[axis][i] > 0 ? air_density_ * smoke_of_face<Dim>(volume_, axis, i) : 0;
  });
}

template <int Dim>
void Ground<Dim>::set_layers(int axis, int begin, int end) {
  auto& layer = layer_[axis];
  const Index<Dim> shape = layer.shape();
  const int first = std::max(begin - n_layers, 0), last = std::min(end + 1 + n_layers, shape[0]);
  for_each_in_columns<Dim>(shape, first, last,
                           [&](const Index<Dim>& i) { layer[i] = open_[axis][i] > 0 ? std::uint8_t{0} : deep; });
  for (std::uint8_t above = 0; above < n_layers; ++above) {
    for_each_in_columns<Dim>(shape, first, last, [&](const Index<Dim>& i) {
      if (layer[i] != deep) return;
      for (int k = 0; k < Dim; ++k) {
        if ((i[k] > 0 && layer[shifted<Dim>(i, k, -1)] == above) ||
            (i[k] + 1 < shape[k] && layer[shifted<Dim>(i, k, 1)] == above)) {
          layer[i] = static_cast<std::uint8_t>(above + 1);
          return;
        }
      }
    });
  }
}

template <int Dim>
void Ground<Dim>::set_lists() {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const auto& layer = layer_[axis];
    for (auto& list : faces_of_layer_[axis]) list.clear();
    rows_[axis].assign(layer.n_rows(), {});
    for (std::size_t r = 0; r < layer.n_rows(); ++r) {
      const auto row = layer.row(r);
      const std::uint8_t* const first = row.data();
      const std::uint8_t *begin = first, *end = first + row.size();
      while (begin < end && *begin == deep) ++begin;
      while (end > begin && end[-1] == deep) --end;
      rows_[axis][r] = {static_cast<int>(begin - first), static_cast<int>(end - first)};
      for_each_nonzero(begin, end, [&](const std::uint8_t* face) {
        if (*face != deep)
          faces_of_layer_[axis][*face - 1u].push_back(static_cast<std::uint32_t>(face - layer.values().data()));
      });
    }
  }
  small_cells_.clear();
  const std::uint8_t* const first = small_.values().data();
  for_each_nonzero(first, first + small_.size(),
                   [&](const std::uint8_t* cell) { small_cells_.push_back(static_cast<std::uint32_t>(cell - first)); });
}

template <int Dim>
void Ground<Dim>::extrapolate(FaceField<Dim>& u) const {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const auto& layer = layer_[axis];
    const Index<Dim> shape = layer.shape();
    for (std::size_t depth = 0; depth < n_layers; ++depth) {
      for (const std::uint32_t face : faces_of_layer_[axis][depth]) {
        const Index<Dim> i = unflat<Dim>(face, shape);
        double sum = 0;
        int n = 0;
        for (int k = 0; k < Dim; ++k) {
          const auto stride = static_cast<std::size_t>(layer.stride(k));
          if (i[k] > 0 && layer[face - stride] <= depth) sum += u[axis][face - stride], ++n;
          if (i[k] + 1 < shape[k] && layer[face + stride] <= depth) sum += u[axis][face + stride], ++n;
        }
        u[axis][face] = sum / n;
      }
    }
  }
}

template <int Dim>
void Ground<Dim>::clear_deep(FaceField<Dim>& u, int begin, int end) const {
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    const Index<Dim>& shape = u[axis].shape();
    for_each_in_columns<Dim>(shape, std::max(begin - n_layers, 0), std::min(end + 1 + n_layers, shape[0]),
                             [&](const Index<Dim>& i) {
                               if (layer_[axis][i] == deep) u[axis][i] = 0;
                             });
  }
}

template <int Dim>
std::size_t Ground<Dim>::bytes() const {
  std::size_t n = volume_.bytes() + small_.bytes() + spindrift::bytes(small_cells_);
  for (std::size_t axis = 0; axis < Dim; ++axis) {
    n += open_[axis].bytes() + air_mass_[axis].bytes() + layer_[axis].bytes() + spindrift::bytes(rows_[axis]);
    for (const auto& list : faces_of_layer_[axis]) n += spindrift::bytes(list);
  }
  return n;
}

template class Ground<2>;
template class Ground<3>;

}  // namespace spindrift
