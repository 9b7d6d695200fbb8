#include "sph/sleeping_cover.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "core/memory.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

GroundLayer ground_layer(const CoverLayer& layer, double spacing) {
  const Box<2> extent{{layer.from, layer.y.from}, {layer.to, layer.y.to}};
  return {.extent = common<2>(extent, layer.within),
          .thickness = layer.depth,
          .spacing = spacing,
          .seed = layer.seed,
          .relaxation_steps = layer.relaxation_steps};
}

void sort_by_id(Cover<3>& cover) {
  std::vector<std::uint32_t> order(cover.particles.size());
  std::iota(order.begin(), order.end(), 0u);
  const std::vector<std::uint64_t>& id = cover.particles.id;
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return id[a] < id[b]; });
  cover.particles.for_each_array([&](auto& array) { reorder(array, order); });
  reorder(cover.foot, order);
  reorder(cover.hazard, order);
}

}  // namespace

CoverArea::CoverArea(const CoverLayer& layer, double spacing)
    : extent(ground_layer(layer, spacing).extent),
      accepts(layer.accepts ? layer.accepts : [](const Vec<2>&) { return true; }),
      depth(layer.depth),
      plots(ground_layer(layer, spacing)) {}

SleepingCover::SleepingCover(const CoverLayer& layer, const SnowKind<3>& kind, std::span<const Box<3>> obstacles)
    : area_(layer, kind.spacing),
      kind_(kind),
      obstacles_(obstacles.begin(), obstacles.end()),
      filling_(ground_layer(layer, kind.spacing)) {}

bool SleepingCover::asleep(const Cover<3>& cover, const Box<2>& box) const {
  bool any = false;
  plots().for_each_in(box, [&](std::size_t plot) { any = any || cover.laid.empty() || cover.laid[plot] == 0; });
  return any;
}

void SleepingCover::call(const Box<2>& box, std::vector<std::uint8_t>& called) const {
  plots().for_each_in(box, [&](std::size_t plot) { called[plot] = 1; });
}

std::size_t SleepingCover::wake(Cover<3>& cover, const HeightField& ground,
                                const std::vector<std::uint8_t>& called) const {
  cover.in_plan = true;
  cover.laid.resize(plots().size());
  std::vector<std::size_t> woken;
  for (std::size_t plot = 0; plot < called.size(); ++plot)
    if (called[plot] && !std::exchange(cover.laid[plot], std::uint8_t{1})) woken.push_back(plot);
  std::vector<std::vector<FilledPlace>> filled(woken.size());
  parallel_for(
      woken.size(), [&](std::size_t n) { filled[n] = filling_.fill(ground, woken[n], area_.accepts); }, 1);

  const std::size_t before = cover.particles.size();
  for (std::size_t n = 0; n < woken.size(); ++n)
    for (std::size_t k = 0; k < filled[n].size(); ++k) {
      const FilledPlace& place = filled[n][k];
      if (any_within<3>(obstacles_, place.position, kind_.spacing / 2)) continue;
      append(cover.particles, place.position, kind_, CoverArea::id(woken[n], k));
      cover.foot.push_back(place.foot);
    }
  const std::size_t laid = cover.particles.size() - before;
  if (laid == 0) return 0;
  cover.hazard.resize(cover.particles.size(), 0);
  sort_by_id(cover);
  index_cover(cover);
  return laid;
}

std::size_t SleepingCover::wake_all(Cover<3>& cover, const HeightField& ground) const {
  return wake(cover, ground, std::vector<std::uint8_t>(plots().size(), 1));
}

std::size_t SleepingCover::bytes() const {
  return spindrift::bytes(obstacles_) + filling_.bytes();
}

}  // namespace spindrift
