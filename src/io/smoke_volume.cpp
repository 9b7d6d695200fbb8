#include "io/smoke_volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

constexpr int rim = 4;          // cells around the smoke: two that may lie in the ground, one to spread, one clear
constexpr float least = 1e-4f;  // extinction that counts as smoke [1/m]

/// Extinction of a cell of the lattice [1/m].
float extinction_of(float density, float per_density) {
  return density > 0 && std::isfinite(density) ? density * per_density : 0.0f;
}

/// Directions to the sky with their weights: up, and four 37 degrees from it, over most slopes.
struct SkyDirection {
  Vec<3> towards;
  float weight;
};

std::array<SkyDirection, 5> sky_directions(const Vec<3>& up) {
  const Vec<3> aside = (std::abs(up[0]) < 0.8 ? Vec<3>::UnitX() : Vec<3>::UnitY()).cross(up).normalized();
  const Vec<3> other = up.cross(aside);
  std::array<SkyDirection, 5> all{SkyDirection{up, 0.32f}};
  for (std::size_t k = 0; k < 4; ++k) {
    const double sign = k % 2 == 0 ? 1 : -1;
    all[k + 1] = {(0.8 * up + 0.6 * sign * (k < 2 ? aside : other)).normalized(), 0.17f};
  }
  return all;
}

}  // namespace

SmokeVolume::SmokeVolume(const SmokeLattice& lattice, double opaque_density, const Light& light, std::size_t most_cells)
    : light_(light) {
  SPINDRIFT_CHECK(lattice.density.size() == count<3>(lattice.shape) && opaque_density > 0 && lattice.spacing > 0);
  SPINDRIFT_CHECK(lattice.solid.empty() || lattice.solid.size() == lattice.density.size());
  take(lattice, opaque_density, most_cells);
  if (empty()) return;
  mark_blocks();
  const auto transmittance = [](Values& depth, auto&& use) {
    const std::size_t n = depth.size();
    parallel_for(
        n, [&](std::size_t c) { use(c, std::exp(-depth[c])); }, 8192);
  };
  sunlight_ = depth_towards(light.sun);
  transmittance(sunlight_, [&](std::size_t c, float t) { sunlight_[c] = t; });
  skylight_.assign(extinction_.size(), 0.0f);
  for (const SkyDirection& direction : sky_directions(light.up)) {
    Values depth = depth_towards(direction.towards);
    transmittance(depth, [&](std::size_t c, float t) { skylight_[c] += direction.weight * t; });
  }
}

void SmokeVolume::take(const SmokeLattice& lattice, double opaque_density, std::size_t most_cells) {
  const float per_density = static_cast<float>(1 / opaque_density);
  // The block of cells with smoke.
  Index<3> lower = lattice.shape, upper{};
  std::size_t cell = 0;
  for_each_index<3>(lattice.shape, [&](const Index<3>& i) {
    if (extinction_of(lattice.density[cell++], per_density) < least) return;
    for (std::size_t k = 0; k < 3; ++k) lower[k] = std::min(lower[k], i[k]), upper[k] = std::max(upper[k], i[k] + 1);
  });
  if (upper[0] == 0) return;
  const auto coarse = [&](int step, std::size_t k) { return (upper[k] - lower[k] + step - 1) / step + 2 * rim; };
  int step = 1;
  while (count<3>(Index<3>{coarse(step, 0), coarse(step, 1), coarse(step, 2)}) > most_cells) ++step;
  shape_ = {coarse(step, 0), coarse(step, 1), coarse(step, 2)};
  spacing_ = step * lattice.spacing;
  for (int k = 0; k < 3; ++k)
    origin_[k] =
        lattice.origin[k] + lattice.spacing * (lower[static_cast<std::size_t>(k)] + 0.5 * (step - 1)) - rim * spacing_;

  const std::size_t n = count<3>(shape_);
  extinction_.assign(n, 0.0f);
  std::vector<std::uint8_t> unknown(n, 0);  // 1: in the ground, and nothing known of the smoke above it
  const auto fill = [&](std::size_t c) {
    const Index<3> i = unflat<3>(c, shape_);
    float sum = 0;
    int n_air = 0, n_solid = 0;
    for_each_index<3>({step, step, step}, [&](const Index<3>& within) {
      Index<3> from;
      for (std::size_t k = 0; k < 3; ++k) from[k] = lower[k] + (i[k] - rim) * step + within[k];
      if (!inside<3>(from, lattice.shape)) return;
      const std::size_t source = flat<3>(from, lattice.shape);
      if (!lattice.solid.empty() && lattice.solid[source]) {
        ++n_solid;
      } else {
        ++n_air;
        sum += extinction_of(lattice.density[source], per_density);
      }
    });
    extinction_[c] = n_air > 0 ? sum / static_cast<float>(n_air) : 0.0f;
    unknown[c] = n_air == 0 && n_solid > 0;
  };
  parallel_for(n, fill, 4096);
  extend_into_ground(unknown);
  spread();
}

void SmokeVolume::extend_into_ground(std::vector<std::uint8_t>& unknown) {
  for (int layer = 0; layer < 2; ++layer) {
    const std::vector<std::uint8_t> before = unknown;
    const auto extend = [&](std::size_t c) {
      const Index<3> i = unflat<3>(c, shape_);
      // The outer cells stay clear.
      for (std::size_t k = 0; k < 3; ++k)
        if (i[k] < 2 || i[k] > shape_[k] - 3) return;
      if (!before[c]) return;
      float sum = 0;
      int n_known = 0;
      for_each_index<3>({3, 3, 3}, [&](const Index<3>& d) {
        const std::size_t other = at(i[0] + d[0] - 1, i[1] + d[1] - 1, i[2] + d[2] - 1);
        if (before[other]) return;
        sum += extinction_[other];
        ++n_known;
      });
      if (n_known == 0) return;
      extinction_[c] = sum / static_cast<float>(n_known);
      unknown[c] = 0;
    };
    parallel_for(extinction_.size(), extend, 4096);
  }
}

void SmokeVolume::spread() {
  Values before(extinction_.size());
  std::size_t stride = 1;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    before.swap(extinction_);
    const auto mean = [&](std::size_t c) {
      const int i = unflat<3>(c, shape_)[axis];
      const float left = i > 0 ? before[c - stride] : 0, right = i + 1 < shape_[axis] ? before[c + stride] : 0;
      extinction_[c] = 0.5f * before[c] + 0.25f * (left + right);
    };
    parallel_for(before.size(), mean, 8192);
    stride *= static_cast<std::size_t>(shape_[axis]);
  }
}

/// Optical depth from every cell to where the light comes from: layer by layer from there, each cell from the place
/// between four cells of the layer before that the light came through.
SmokeVolume::Values SmokeVolume::depth_towards(const Vec<3>& light) const {
  int axis = 0;
  light.cwiseAbs().maxCoeff(&axis);
  const int other[2] = {axis == 0 ? 1 : 0, axis == 2 ? 1 : 2};
  const std::size_t stride[3] = {1, static_cast<std::size_t>(shape_[0]),
                                 static_cast<std::size_t>(shape_[0]) * static_cast<std::size_t>(shape_[1])};
  const auto n = [&](int k) { return shape_[static_cast<std::size_t>(k)]; };
  const double along = std::abs(light[axis]);
  const float length = static_cast<float>(spacing_ / along);
  const float offset[2] = {static_cast<float>(light[other[0]] / along), static_cast<float>(light[other[1]] / along)};
  const bool from_above = light[axis] > 0;

  Values depth(extinction_.size(), 0.0f);
  for (int layer = 1; layer < n(axis); ++layer) {
    const auto index = [&](int l) { return static_cast<std::size_t>(from_above ? n(axis) - 1 - l : l); };
    const std::size_t here = index(layer) * stride[axis], before = index(layer - 1) * stride[axis];
    const auto row = [&](std::size_t j) {
      for (int i = 0; i < n(other[0]); ++i) {
        const float s = static_cast<float>(i) + offset[0], t = static_cast<float>(j) + offset[1];
        const float s0 = std::floor(s), t0 = std::floor(t);
        float depth_before = 0, extinction_before = 0;
        for (int corner = 0; corner < 4; ++corner) {
          const int a = static_cast<int>(s0) + corner % 2, b = static_cast<int>(t0) + corner / 2;
          if (a < 0 || b < 0 || a >= n(other[0]) || b >= n(other[1])) continue;
          const float weight = (corner % 2 ? s - s0 : 1 - s + s0) * (corner / 2 ? t - t0 : 1 - t + t0);
          const std::size_t cell =
              before + static_cast<std::size_t>(a) * stride[other[0]] + static_cast<std::size_t>(b) * stride[other[1]];
          depth_before += weight * depth[cell];
          extinction_before += weight * extinction_[cell];
        }
        const std::size_t cell = here + static_cast<std::size_t>(i) * stride[other[0]] + j * stride[other[1]];
        depth[cell] = depth_before + 0.5f * length * (extinction_before + extinction_[cell]);
      }
    };
    parallel_for(static_cast<std::size_t>(n(other[1])), row, 16);
  }
  return depth;
}

void SmokeVolume::mark_blocks() {
  for (std::size_t k = 0; k < 3; ++k) blocks_[k] = (shape_[k] + block - 1) / block;
  smoky_.assign(count<3>(blocks_), 0);
  const auto mark = [&](std::size_t b) {
    const Index<3> first = unflat<3>(b, blocks_);
    Index<3> from, size;
    for (std::size_t k = 0; k < 3; ++k) {
      from[k] = std::max(first[k] * block - 1, 0);
      size[k] = std::min(first[k] * block + block + 1, shape_[k]) - from[k];
    }
    bool any = false;
    for_each_index<3>(size, [&](const Index<3>& i) {
      any = any || extinction_[at(from[0] + i[0], from[1] + i[1], from[2] + i[2])] > 0;
    });
    smoky_[b] = any;
  };
  parallel_for(smoky_.size(), mark, 256);
}

}  // namespace spindrift
