#include "sph/cover.hpp"

#include <algorithm>

#include "core/parallel.hpp"

namespace spindrift {
namespace {

template <int Dim>
void sort_by_cell(Cover<Dim>& cover) {
  cover.cells = CellList<Dim>(std::max(cover.bin_size, cover.support_radius));
  cover.cells.build(cover.particles);
  cover.cells.release_scratch();
  reorder(cover.foot, cover.cells.order());
  reorder(cover.hazard, cover.cells.order());
}

/// The plane through the surface over the bins around `bin`, as its slopes over places [-].
template <int Dim>
Vec<Dim - 1> surface_slope(const Cover<Dim>& cover, const GroundBin<Dim>& bin) {
  const GroundBin<Dim> first = ground_bin<Dim>(cover.ground_lower, cover.bin_size);
  const GroundBin<Dim> last = ground_bin<Dim>(cover.ground_upper, cover.bin_size);
  GroundBin<Dim> window;
  window.fill(2 * surface_reach + 1);
  Vec<Dim - 1> moment = Vec<Dim - 1>::Zero();
  double squares = 0;
  for_each_index<Dim - 1>(window, [&](const GroundBin<Dim>& step) {
    GroundBin<Dim> near;
    for (int k = 0; k < Dim - 1; ++k) near[k] = std::clamp(bin[k] + step[k] - surface_reach, first[k], last[k]);
    const double height = cover.surface(near);
    for (int k = 0; k < Dim - 1; ++k) moment[k] += (step[k] - surface_reach) * height;
    squares += (step[0] - surface_reach) * (step[0] - surface_reach);
  });
  return moment / (squares * cover.bin_size);
}

/// Unit vectors along the ground: the direction of growing x, and in 3D the one across.
template <int Dim>
std::array<Vec<Dim>, Dim - 1> tangents(const Vec<Dim>& normal) {
  const Vec<Dim> along = (Vec<Dim>::Unit(0) - normal[0] * normal).normalized();
  if constexpr (Dim == 2)
    return {along};
  else
    return {along, normal.cross(along)};
}

template <int Dim>
void find_surface_normals(Cover<Dim>& cover, const GroundBin<Dim>& bin) {
  const auto slots = cover.slots_in(bin);
  if (slots.empty()) return;
  const Vec<Dim - 1> slope = surface_slope(cover, bin);
  for (const std::uint32_t slot : slots) {
    Vec<Dim> normal = cover.foot[slot].normal;
    if (cover
            .in_plan) {  // the height's gradient along the ground is that over places, less what goes out of the ground
      Vec<Dim> gradient = Vec<Dim>::Zero();
      gradient.template head<Dim - 1>() = slope;
      normal -= gradient - gradient.dot(normal) * normal;
    } else {
      const auto along = tangents<Dim>(normal);
      for (int k = 0; k < Dim - 1; ++k) normal -= slope[k] * along[k];
    }
    cover.surface_normal[slot] = normal.normalized();
  }
}

}  // namespace

template <int Dim>
std::span<const std::uint32_t> Cover<Dim>::slots_in(GroundBin<Dim> bin) const {
  for (int k = 0; k < Dim - 1; ++k) bin[k] -= lower[k];
  if (!inside<Dim - 1>(bin, shape)) return {};
  const std::size_t b = flat<Dim - 1>(bin, shape);
  return {members.data() + first[b], first[b + 1] - first[b]};
}

template <int Dim>
double Cover<Dim>::surface(const GroundBin<Dim>& bin) const {
  for (const std::uint32_t slot : slots_in(bin))
    if (alive(slot)) return foot[slot].distance + spacing / 2;
  return 0;
}

template <int Dim>
double Cover<Dim>::ground_area(const GroundBin<Dim>& bin) const {
  const double area = ground_bin_area<Dim>(bin_size);
  const auto slots = slots_in(bin);
  if (!in_plan || slots.empty()) return area;
  double ratio = 0;
  for (const std::uint32_t slot : slots) ratio += 1 / cos_slope<Dim>(foot[slot].normal);
  return area * ratio / static_cast<double>(slots.size());
}

template <int Dim>
void index_cover(Cover<Dim>& cover) {
  const std::size_t n = cover.particles.size();
  cover.bin_size = 2 * cover.spacing;
  sort_by_cell(cover);
  cover.lower.fill(0);
  cover.shape.fill(0);
  cover.members.clear();
  bool any = false;
  GroundBin<Dim> upper{};
  for (std::uint32_t i = 0; i < n; ++i) {
    if (!cover.alive(i)) continue;
    const GroundBin<Dim> bin = ground_bin<Dim>(cover.foot[i].place, cover.bin_size);
    for (int k = 0; k < Dim - 1; ++k) {
      cover.lower[k] = any ? std::min(cover.lower[k], bin[k]) : bin[k];
      upper[k] = any ? std::max(upper[k], bin[k]) : bin[k];
      cover.shape[k] = upper[k] - cover.lower[k] + 1;
    }
    any = true;
    cover.members.push_back(i);
  }

  const auto bin_of = [&](std::uint32_t slot) {
    GroundBin<Dim> bin = ground_bin<Dim>(cover.foot[slot].place, cover.bin_size);
    for (int k = 0; k < Dim - 1; ++k) bin[k] -= cover.lower[k];
    return flat<Dim - 1>(bin, cover.shape);
  };
  cover.first.assign(count<Dim - 1>(cover.shape) + 1, 0);
  for (const std::uint32_t slot : cover.members) ++cover.first[bin_of(slot) + 1];
  for (std::size_t b = 1; b < cover.first.size(); ++b) cover.first[b] += cover.first[b - 1];
  std::vector<std::uint32_t> next = cover.first;
  std::vector<std::uint32_t> by_bin(cover.members.size());
  for (const std::uint32_t slot : cover.members) by_bin[next[bin_of(slot)]++] = slot;
  cover.members.swap(by_bin);
  for (std::size_t b = 0; b + 1 < cover.first.size(); ++b)
    std::sort(cover.members.begin() + cover.first[b], cover.members.begin() + cover.first[b + 1],
              [&](std::uint32_t i, std::uint32_t j) {
                const double above_i = cover.foot[i].distance, above_j = cover.foot[j].distance;
                return above_i != above_j ? above_i > above_j : i < j;
              });

  cover.surface_normal.resize(n);
  for (std::size_t i = 0; i < n; ++i) cover.surface_normal[i] = cover.foot[i].normal;
  parallel_for(
      cover.first.size() - 1,
      [&](std::size_t b) {
        GroundBin<Dim> bin = unflat<Dim - 1>(b, cover.shape);
        for (int k = 0; k < Dim - 1; ++k) bin[k] += cover.lower[k];
        find_surface_normals(cover, bin);
      },
      64);
}

template <int Dim>
void settle_surface(Cover<Dim>& cover, std::span<const GroundBin<Dim>> bins) {
  std::vector<GroundBin<Dim>> around;
  GroundBin<Dim> window;
  window.fill(2 * surface_reach + 1);
  for (const GroundBin<Dim>& bin : bins)
    for_each_index<Dim - 1>(window, [&](const GroundBin<Dim>& step) {
      GroundBin<Dim> near = bin;
      for (int k = 0; k < Dim - 1; ++k) near[k] += step[k] - surface_reach;
      around.push_back(near);
    });
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
  parallel_for(
      around.size(), [&](std::size_t i) { find_surface_normals(cover, around[i]); }, 64);
}

template <int Dim>
void remove_from_cover(Cover<Dim>& cover, std::size_t slot) {
  if (!cover.alive(slot)) return;
  cover.particles.mass[slot] = 0;
  cover.particles.volume[slot] = 0;
  cover.hazard[slot] = 0;
  ++cover.n_dead;
}

template <int Dim>
bool compact_cover(Cover<Dim>& cover) {
  if (8 * cover.n_dead <= cover.particles.size()) return false;
  const std::vector<double> volume = cover.particles.volume;
  const auto drop_dead = [&volume](auto& array) {
    std::size_t n = 0;
    for (std::size_t i = 0; i < volume.size(); ++i)
      if (volume[i] > 0) array[n++] = array[i];
    array.resize(n);
  };
  cover.particles.for_each_array(drop_dead);
  drop_dead(cover.foot);
  drop_dead(cover.hazard);
  cover.n_dead = 0;
  index_cover(cover);
  return true;
}

#define INSTANTIATE(Dim)                                                           \
  template struct Cover<Dim>;                                                      \
  template void index_cover<Dim>(Cover<Dim>&);                                     \
  template void settle_surface<Dim>(Cover<Dim>&, std::span<const GroundBin<Dim>>); \
  template void remove_from_cover<Dim>(Cover<Dim>&, std::size_t);                  \
  template bool compact_cover<Dim>(Cover<Dim>&);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
