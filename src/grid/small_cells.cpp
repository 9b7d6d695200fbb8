#include "grid/small_cells.hpp"

#include <algorithm>

namespace spindrift {

template <int Dim>
std::size_t root_of_small_cell(std::size_t cell, const FaceField<Dim>& area, const Ground<Dim>& ground) {
  const auto& volume = ground.volume();
  const Index<Dim> i = unflat<Dim>(cell, volume.shape());
  double widest = 0;
  std::size_t root = cell;
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Index<Dim> other = shifted<Dim>(i, axis, 2 * side - 1);
      if (!inside<Dim>(other, volume.shape()) || ground.is_small(volume[other])) continue;
      const double opening = area[axis][shifted<Dim>(i, axis, side)];
      if (opening > widest) widest = opening, root = flat<Dim>(other, volume.shape());
    }
  }
  return root;
}

template <int Dim>
void SmallCells<Dim>::find(const FaceField<Dim>& flow_area, const Ground<Dim>& ground) {
  members_.clear();
  for (const std::uint32_t cell : ground.small_cells()) {
    const std::size_t root = root_of_small_cell<Dim>(cell, flow_area, ground);
    if (root != cell) members_.push_back({static_cast<std::uint32_t>(root), cell});
  }
  std::sort(members_.begin(), members_.end(),
            [](const Member& a, const Member& b) { return std::pair(a.root, a.cell) < std::pair(b.root, b.cell); });
}

template <int Dim>
template <class F>
void SmallCells<Dim>::for_each_group(F&& f) const {
  for (std::size_t begin = 0, end = 0; begin < members_.size(); begin = end) {
    while (end < members_.size() && members_[end].root == members_[begin].root) ++end;
    f(members_[begin].root, std::span(members_).subspan(begin, end - begin));
  }
}

template <int Dim>
void SmallCells<Dim>::lend(Field<Dim>& volume, const Field<Dim>& outflow, double limit) const {
  for_each_group([&](std::size_t root, std::span<const Member> group) {
    bool enough = outflow[root] <= limit * volume[root];
    double total = volume[root], out = outflow[root];
    for (const Member& m : group) {
      enough = enough && outflow[m.cell] <= limit * volume[m.cell];
      total += volume[m.cell];
      out += outflow[m.cell];
    }
    if (enough) return;
    const auto set = [&](std::size_t cell) { volume[cell] = 0.1 * volume[cell] + 0.9 * total * (outflow[cell] / out); };
    set(root);
    for (const Member& m : group) set(m.cell);
  });
}

template <int Dim>
void SmallCells<Dim>::share(Field<Dim>& smoke, const Field<Dim>& volume) const {
  for_each_group([&](std::size_t root, std::span<const Member> group) {
    double mass = smoke[root], total = volume[root];
    for (const Member& m : group) mass += smoke[m.cell], total += volume[m.cell];
    double left = mass;
    for (const Member& m : group) {
      smoke[m.cell] = mass * (volume[m.cell] / total);
      left -= smoke[m.cell];
    }
    smoke[root] = std::max(left, 0.0);
  });
}

template std::size_t root_of_small_cell<2>(std::size_t, const FaceField<2>&, const Ground<2>&);
template std::size_t root_of_small_cell<3>(std::size_t, const FaceField<3>&, const Ground<3>&);
template class SmallCells<2>;
template class SmallCells<3>;

}  // namespace spindrift
