#include "simulation/cover_relief.hpp"

#include <algorithm>
#include <cmath>

#include "core/parallel.hpp"

namespace spindrift {
namespace {

/// Between four points of a grid, at (s, t) in its steps; beyond it as at its edge.
float between(const std::vector<float>& values, const Index<2>& shape, double s, double t) {
  s = std::clamp(s, 0.0, shape[0] - 1.0), t = std::clamp(t, 0.0, shape[1] - 1.0);
  const int i = static_cast<int>(s), j = static_cast<int>(t);
  const float a = static_cast<float>(s - i), b = static_cast<float>(t - j);
  const auto at = [&](int x, int y) {
    return values[flat<2>({std::min(x, shape[0] - 1), std::min(y, shape[1] - 1)}, shape)];
  };
  return (1 - b) * ((1 - a) * at(i, j) + a * at(i + 1, j)) + b * ((1 - a) * at(i, j + 1) + a * at(i + 1, j + 1));
}

/// Each value the mean of it, twice, and its neighbours, along both axes; that so many times.
std::vector<float> softened(std::vector<float> values, const Index<2>& shape, int times) {
  std::vector<float> before(values.size());
  for (; times > 0; --times) {
    before.swap(values);
    const auto soften = [&](std::size_t c) {
      const Index<2> i = unflat<2>(c, shape);
      float sum = 0, weights = 0;
      for_each_index<2>({3, 3}, [&](const Index<2>& step) {
        const Index<2> other{i[0] + step[0] - 1, i[1] + step[1] - 1};
        if (!inside<2>(other, shape)) return;
        const float weight = (step[0] == 1 ? 2.0f : 1.0f) * (step[1] == 1 ? 2.0f : 1.0f);
        sum += weight * before[flat<2>(other, shape)];
        weights += weight;
      });
      values[c] = sum / weights;
    };
    parallel_for(values.size(), soften, 2048);
  }
  return values;
}

/// The median of those above 0, else 0.
float middle_one(std::vector<float> values) {
  std::erase_if(values, [](float v) { return !(v > 0); });
  if (values.empty()) return 0;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// Cosine of the slope at every point of the ground; 1 where it has a hole.
std::vector<float> cosines(const Relief& ground) {
  const ReliefSurface surface(ground);
  std::vector<float> all(ground.height.size());
  const auto find = [&](std::size_t n) {
    const Vec<2> place = ground.place(unflat<2>(n, ground.shape));
    const ReliefSurface::Point point = surface.at(place[0], place[1]);
    all[n] = 1 / std::sqrt(1 + point.slope_x * point.slope_x + point.slope_y * point.slope_y);
  };
  parallel_for(all.size(), find, 2048);
  return all;
}

/// 1 for plots of which the frame holds a particle, resting or entrained.
std::vector<std::uint8_t> laid_plots(const CoverArea& area, const PictureFrame& frame) {
  std::vector<std::uint8_t> laid(area.plots.size());
  for (const std::int64_t id : frame.id)
    if (const std::int64_t plot = CoverArea::plot_of(static_cast<std::uint64_t>(id));
        plot >= 0 && plot < static_cast<std::int64_t>(laid.size()))
      laid[static_cast<std::size_t>(plot)] = 1;
  return laid;
}

}  // namespace

void add_cover(Relief& ground, const Box<3>& domain, double spacing, const CoverArea* area, const PictureFrame& frame) {
  const Vec<2> size = domain.size().head<2>();
  Index<2> bins;
  Vec<2> edge;
  for (int k = 0; k < 2; ++k) {
    const double wanted = size[k] / std::max(2 * spacing, ground.spacing);
    bins[static_cast<std::size_t>(k)] = std::max(1, static_cast<int>(wanted));
    edge[k] = size[k] / bins[static_cast<std::size_t>(k)];
  }
  const std::vector<float> cosine = cosines(ground);
  std::vector<float> depth(count<2>(bins), 0.0f);
  for (std::size_t i = 0; i < frame.layer.size(); ++i) {
    if (frame.layer[i] == 0) continue;
    const Vec<3> x = Eigen::Map<const Eigen::Vector3f>(frame.positions.data() + 3 * i).cast<double>();
    const Vec<2> within = x.head<2>() - domain.lower.head<2>();
    if (!((within.array() >= 0).all() && (within.array() < size.array()).all())) continue;
    const Vec<2> at = (x.head<2>() - ground.origin) / ground.spacing;
    const double above = x[2] - static_cast<double>(between(ground.height, ground.shape, at[0], at[1]));
    const double normal = above * static_cast<double>(between(cosine, ground.shape, at[0], at[1])) + spacing / 2;
    const Index<2> bin{std::min(static_cast<int>(within[0] / edge[0]), bins[0] - 1),
                       std::min(static_cast<int>(within[1] / edge[1]), bins[1] - 1)};
    float& top = depth[flat<2>(bin, bins)];
    top = std::max(top, static_cast<float>(normal));
  }
  if (area) {
    const std::vector<std::uint8_t> laid = laid_plots(*area, frame);
    for_each_index<2>(bins, [&](const Index<2>& i) {
      const Vec<2> place = domain.lower.head<2>() + Vec<2>((i[0] + 0.5) * edge[0], (i[1] + 0.5) * edge[1]);
      float& top = depth[flat<2>(i, bins)];
      if (top == 0 && area->plots.contains(place) && !laid[area->plots.at(place)] && area->contains(place))
        top = static_cast<float>(area->depth);
    });
  }
  // Softened, so that single particles do not show.
  const std::vector<float> smooth = softened(depth, bins, 1), even = softened(smooth, bins, 8);
  const float usual = middle_one(even);
  ground.snow.resize(ground.height.size());
  const auto raise = [&](std::size_t n) {
    const Vec<2> place = ground.place(unflat<2>(n, ground.shape)) - domain.lower.head<2>();
    const double s = place[0] / edge[0] - 0.5, t = place[1] / edge[1] - 0.5;
    const Vec<2> outside = (place - place.cwiseMax(0).cwiseMin(size)).cwiseQuotient(edge);
    const float share = static_cast<float>(std::min(outside.norm() / 4, 1.0));
    float snow = (1 - share) * between(smooth, bins, s, t);
    if (share > 0 && usual > 0)
      snow += share * usual * std::clamp(4 * between(even, bins, s, t) / usual - 1.5f, 0.0f, 1.0f);
    ground.snow[n] = snow;
    ground.height[n] += snow / cosine[n];
  };
  parallel_for(ground.height.size(), raise, 2048);
}

}  // namespace spindrift
