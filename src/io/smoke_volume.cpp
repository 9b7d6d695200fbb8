#include "io/smoke_volume.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

constexpr int rim = 3;            // cells around the smoke: two that may lie in the ground, and one without any
constexpr int block = 4;          // cells along the edge of a block that is skipped where it is clear
constexpr float least = 1e-4f;    // extinction that counts as smoke [1/m]
constexpr float opaque = 0.004f;  // of what is behind, where a ray ends

/// Share of the light that is turned more than once, and how much less it is dimmed: its extinction is a quarter.
constexpr float turned_more = 0.45f;

float once_and_more(float transmittance) {
  return (1 - turned_more) * transmittance + turned_more * std::sqrt(std::sqrt(transmittance));
}

/// Extinction of a cell of the lattice [1/m].
float extinction_of(float density, float per_density) {
  return density > 0 && std::isfinite(density) ? density * per_density : 0.0f;
}

/// Directions to the sky with their weights: up, and four in between up and level.
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
    all[k + 1] = {(0.6 * up + 0.8 * sign * (k < 2 ? aside : other)).normalized(), 0.17f};
  }
  return all;
}

}  // namespace

/// Eight cells around a place and the place's weights between them.
struct SmokeVolume::Corner {
  std::size_t first = 0;
  float a = 0, b = 0, c = 0;
  bool inside = false;

  /// s: the place in cells from the first one's centre.
  Corner(const SmokeVolume& volume, float x, float y, float z) {
    const Index<3>& n = volume.shape_;
    inside = x >= 0 && y >= 0 && z >= 0 && x < static_cast<float>(n[0] - 1) && y < static_cast<float>(n[1] - 1) &&
             z < static_cast<float>(n[2] - 1);
    if (!inside) return;
    const int i = static_cast<int>(x), j = static_cast<int>(y), k = static_cast<int>(z);
    first = volume.at(i, j, k);
    a = x - static_cast<float>(i), b = y - static_cast<float>(j), c = z - static_cast<float>(k);
  }
  Corner(const SmokeVolume& volume, const Vec<3>& x)
      : Corner(volume, static_cast<float>((x[0] - volume.origin_[0]) / volume.spacing_),
               static_cast<float>((x[1] - volume.origin_[1]) / volume.spacing_),
               static_cast<float>((x[2] - volume.origin_[2]) / volume.spacing_)) {}
};

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
  for (int layer = 0; layer < 2; ++layer) {
    const std::vector<std::uint8_t> before = unknown;
    const auto extend = [&](std::size_t c) {
      const Index<3> i = unflat<3>(c, shape_);
      // The outermost cells stay clear.
      for (std::size_t k = 0; k < 3; ++k)
        if (i[k] == 0 || i[k] == shape_[k] - 1) return;
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
    parallel_for(n, extend, 4096);
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

float SmokeVolume::between(const Values& values, const Corner& corner) const {
  const float* const v = values.data() + corner.first;
  const std::size_t y = static_cast<std::size_t>(shape_[0]), z = y * static_cast<std::size_t>(shape_[1]);
  const auto line = [&](const float* from) { return from[0] + corner.a * (from[1] - from[0]); };
  const float low = line(v) + corner.b * (line(v + y) - line(v));
  const float high = line(v + z) + corner.b * (line(v + z + y) - line(v + z));
  return low + corner.c * (high - low);
}

float SmokeVolume::extinction(const Vec<3>& x) const {
  if (empty()) return 0;
  const Corner corner(*this, x);
  return corner.inside ? between(extinction_, corner) : 0.0f;
}

/// Cuts [from, to] to where eye + t direction is between the cells' centres; false: nowhere.
bool SmokeVolume::range(const Vec<3>& eye, const Vec<3>& direction, double& from, double& to) const {
  for (int k = 0; k < 3; ++k) {
    const double low = origin_[k], high = origin_[k] + spacing_ * (shape_[static_cast<std::size_t>(k)] - 1);
    if (direction[k] == 0) {
      if (eye[k] < low || eye[k] >= high) return false;
      continue;
    }
    const double a = (low - eye[k]) / direction[k], b = (high - eye[k]) / direction[k];
    from = std::max(from, std::min(a, b));
    to = std::min(to, std::max(a, b));
  }
  return from < to;
}

float SmokeVolume::light_at(const Values& light, const Vec<3>& towards, const Vec<3>& x) const {
  if (empty()) return 1;
  const Corner here(*this, x);
  if (here.inside) return between(light, here);
  double from = 0, to = std::numeric_limits<double>::infinity();
  if (!range(x, towards, from, to)) return 1;
  // A little further in, so that it is inside for sure.
  const Corner entry(*this, Vec<3>(x + std::min(from + 1e-3 * spacing_, 0.5 * (from + to)) * towards));
  return entry.inside ? between(light, entry) : 1.0f;
}

float SmokeVolume::sunlight(const Vec<3>& x) const {
  return light_at(sunlight_, light_.sun, x);
}

float SmokeVolume::skylight(const Vec<3>& x) const {
  return light_at(skylight_, light_.up, x);
}

void SmokeVolume::pass(Seen& seen, const Vec<3>& eye, const Vec<3>& direction, double from, double to,
                       double jitter) const {
  if (empty() || seen.clear < opaque || !range(eye, direction, from, to)) return;
  const double length = direction.norm();
  const double step = 0.5 * spacing_ / length;
  const Vec<3> start = (eye - origin_) / spacing_, pace = direction / spacing_;
  const auto place = [&](double t, int k) { return static_cast<float>(start[k] + t * pace[k]); };
  for (double n = std::floor(from / step); n * step < to; ++n) {
    const double begin = std::max(n * step, from), end = std::min((n + 1) * step, to);
    const double t = std::clamp((n + jitter) * step, begin, end);
    const Corner corner(*this, place(t, 0), place(t, 1), place(t, 2));
    if (!corner.inside) continue;
    Index<3> b;
    for (int k = 0; k < 3; ++k) b[static_cast<std::size_t>(k)] = static_cast<int>(place(t, k)) / block;
    if (!smoky_[flat<3>(b, blocks_)]) {
      // On to where the ray leaves the clear block.
      double leaves = to;
      for (int k = 0; k < 3; ++k) {
        if (pace[k] == 0) continue;
        const double side = block * (b[static_cast<std::size_t>(k)] + (pace[k] > 0 ? 1 : 0));
        leaves = std::min(leaves, (side - start[k]) / pace[k]);
      }
      n = std::max(n, std::floor(leaves / step) - 1);
      continue;
    }
    const float extinction = between(extinction_, corner);
    if (extinction <= 0) continue;
    const float clear = std::exp(-extinction * static_cast<float>((end - begin) * length));
    const float turned = seen.clear * (1 - clear);
    seen.sun += turned * once_and_more(between(sunlight_, corner));
    seen.sky += turned * once_and_more(between(skylight_, corner));
    seen.clear *= clear;
    if (seen.clear < opaque) return;
  }
}

}  // namespace spindrift
