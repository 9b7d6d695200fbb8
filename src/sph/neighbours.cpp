#include "sph/neighbours.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"
#include "sph/kd_tree.hpp"
#include "sph/lanes.hpp"

namespace spindrift {

template <int Dim>
struct Neighbours<Dim>::Input {
  const Particles<Dim>& particles;
  const CellList<Dim>& cells;
  const Walls<Dim>& walls;
  const WallKernel<Dim>& wall_kernel;
  std::span<const Foot<Dim>> feet;
  const CoverView<Dim>& cover;
  bool no_slip;
  std::optional<Tree<Dim>> tree;
};

template <int Dim>
void Neighbours<Dim>::find(const Particles<Dim>& particles, const CellList<Dim>& cells, const Walls<Dim>& walls,
                           const WallKernel<Dim>& wall_kernel, std::span<const Foot<Dim>> feet,
                           const CoverView<Dim>& cover, bool no_slip, NeighbourSearch search) {
  SPINDRIFT_CHECK(feet.size() == (walls.terrain ? particles.size() : 0));
  SPINDRIFT_CHECK(!cover.present() || cover.surface_normal->size() == cover.particles->size());
  const std::size_t n = particles.size();
  blocks_.resize((n + block_size - 1) / block_size);
  row_end_.resize(n);
  volume_sum_.resize(n);
  full_.resize(n);
  boundary_.resize(n);
  gradient_sum_.resize(n);
  if (no_slip) no_slip_.resize(n);
  const Points<Dim> points{particles.position};
  Input input{particles, cells, walls, wall_kernel, feet, cover, no_slip, {}};
  if (search == NeighbourSearch::kd_tree)
    input.tree.emplace(Dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(tree_leaf));
  with_kernel<Dim>(wall_kernel.shape(), wall_kernel.support_radius(), [&](const auto& kernel) {
    auto body = [&](std::size_t begin, std::size_t end) { find_block(begin, end, input, kernel); };
    parallel_blocks(n, block_size, body);
  });
}

template <int Dim>
template <class K>
void Neighbours<Dim>::find_block(std::size_t begin, std::size_t end, const Input& input, const K& kernel) {
  Block& block = blocks_[begin / block_size];
  const Particles<Dim>& particles = input.particles;
  std::size_t c = input.cells.cell_of(static_cast<std::uint32_t>(begin));
  for (std::size_t i = begin; i < end; ++c) {
    if (!input.tree) {
      block.candidate.clear();
      for (const auto& run : input.cells.runs(c))
        for (std::uint32_t j = run.begin; j < run.end; ++j) block.candidate.push_back(j);
      block.gather(particles);
    }
    const auto cover_runs =
        input.cover.present() ? input.cover.cells->runs_near(particles.position[i]) : typename CellList<Dim>::Runs{};
    for (const std::size_t cell_end = std::min<std::size_t>(end, input.cells.cell(c).end); i < cell_end; ++i) {
      if (input.tree) {
        find_candidates(i, block, input);
        block.gather(particles);
      }
      find_row(i, block, input, kernel);
      add_boundary(i, cover_runs, input, kernel);
    }
  }
}

/// In ascending order, which is also that of the cell list's runs. The margin is for places on the rim: find_row
/// decides.
template <int Dim>
void Neighbours<Dim>::find_candidates(std::size_t i, Block& block, const Input& input) {
  constexpr double margin = 1 + 1e-9;
  const double h = input.wall_kernel.support_radius();
  input.tree->radiusSearch(input.particles.position[i].data(), h * h * margin, block.found,
                           nanoflann::SearchParams(0, 0, false));
  block.candidate.clear();
  for (const auto& [j, squared] : block.found) block.candidate.push_back(j);
  std::ranges::sort(block.candidate);
}

template <int Dim>
void Neighbours<Dim>::Block::gather(const Particles<Dim>& particles) {
  const std::size_t n = candidate.size();
  volume.resize(n);
  distance_squared.resize(n);
  hit.resize(n);
  value.resize(n);
  for (auto& coordinate : x) coordinate.resize(n);
  for (std::size_t m = 0; m < n; ++m) {
    const std::uint32_t j = candidate[m];
    volume[m] = particles.volume[j];
    for (int k = 0; k < Dim; ++k) x[k][m] = particles.position[j][k];
  }
}

template <int Dim>
template <class K>
void Neighbours<Dim>::find_row(std::size_t i, Block& block, const Input& input, const K& kernel) {
  const std::size_t n = block.candidate.size();
  const std::uint32_t first = i % block_size == 0 ? 0 : row_end_[i - 1];
  if (block.index.size() < first + n) {
    const std::size_t capacity = std::max(first + n, block.index.size() * 3 / 2);
    block.index.resize(capacity);
    block.gradient.resize(capacity * Dim + lane_width<Dim>);
  }
  std::array<const double*, Dim> x;
  for (int k = 0; k < Dim; ++k) x[k] = block.x[k].data();
  const Vec<Dim> x_i = input.particles.position[i];
  double* const distance_squared = block.distance_squared.data();
  for (std::size_t m = 0; m < n; ++m) {
    double sum = 0;
    for (int k = 0; k < Dim; ++k) sum += (x_i[k] - x[k][m]) * (x_i[k] - x[k][m]);
    distance_squared[m] = sum;
  }
  std::uint32_t* const hit = block.hit.data();
  const std::uint32_t* const candidate = block.candidate.data();
  const double h_squared = kernel.h * kernel.h;
  std::size_t n_hits = 0;
  for (std::size_t m = 0; m < n; ++m) {
    hit[n_hits] = static_cast<std::uint32_t>(m);
    n_hits += static_cast<std::size_t>((distance_squared[m] < h_squared) & (candidate[m] != i));
  }

  std::uint32_t* const index = block.index.data() + first;
  float* const gradient = block.gradient.data() + static_cast<std::size_t>(first) * Dim;
  float* const value = block.value.data();
  const auto inverse_h = static_cast<float>(1 / kernel.h);
  const auto slope_scale = static_cast<float>(kernel.sigma / (kernel.h * kernel.h));
  for (std::size_t k = 0; k < n_hits; ++k) {
    const std::uint32_t m = hit[k];
    index[k] = candidate[m];
    const float q = std::sqrt(static_cast<float>(distance_squared[m])) * inverse_h;
    const float slope = K::slope(q) * slope_scale;
    value[k] = K::shape(q);
    for (int a = 0; a < Dim; ++a)
      gradient[k * Dim + static_cast<std::size_t>(a)] = slope * static_cast<float>(x_i[a] - x[a][m]);
  }

  double volume_sum = input.particles.volume[i];
  Vec<Dim> gradient_sum = Vec<Dim>::Zero();
  for (std::size_t k = 0; k < n_hits; ++k) {
    const double volume = block.volume[hit[k]];
    volume_sum += volume * static_cast<double>(value[k]);
    for (int a = 0; a < Dim; ++a)
      gradient_sum[a] += volume * static_cast<double>(gradient[k * Dim + static_cast<std::size_t>(a)]);
  }
  row_end_[i] = first + static_cast<std::uint32_t>(n_hits);
  volume_sum_[i] = kernel.sigma * volume_sum;
  gradient_sum_[i] = gradient_sum;
}

template <int Dim>
template <class K>
void Neighbours<Dim>::add_boundary(std::size_t i, const typename CellList<Dim>::Runs& cover_runs, const Input& input,
                                   const K& kernel) {
  const Vec<Dim>& x = input.particles.position[i];
  const Foot<Dim>& foot = input.feet.empty() ? nowhere<Dim> : input.feet[i];
  const WallShare<Dim> walls = input.wall_kernel.share(input.walls, x, foot);
  double share = walls.fraction;
  Vec<Dim> gradient = walls.gradient;
  double drag = input.no_slip ? input.wall_kernel.no_slip_coefficient(input.walls, x, foot) : 0;
  Vec<Dim> cover_gradient = Vec<Dim>::Zero(), normal = Vec<Dim>::Zero();
  for (const auto& run : cover_runs) {
    for (std::uint32_t c = run.begin; c < run.end; ++c) {
      const Vec<Dim> away = x - input.cover.particles->position[c];
      const double r_squared = away.squaredNorm();
      if (r_squared >= kernel.h * kernel.h) continue;
      const double volume = input.cover.particles->volume[c];
      const double r = std::sqrt(r_squared), slope_over_r = kernel.slope_over_r(r);
      share += volume * kernel.value(r);
      cover_gradient += (volume * slope_over_r) * away;
      normal -= (volume * slope_over_r * r) * (*input.cover.surface_normal)[c];
      drag -= 2 * volume * slope_over_r;
    }
  }
  if (const double weight = normal.squaredNorm(); weight > 0)
    gradient += (cover_gradient.dot(normal) / weight) * normal;
  volume_sum_[i] += share;
  full_[i] = std::max(input.wall_kernel.full(), share + input.particles.volume[i] * kernel.sigma);
  boundary_[i] = gradient;
  gradient_sum_[i] += 2 * gradient;
  if (input.no_slip) no_slip_[i] = drag;
}

template <int Dim>
std::size_t Neighbours<Dim>::n_pairs() const {
  std::size_t n = 0;
  for (std::size_t i = 0; i < row_end_.size(); ++i)
    if ((i + 1) % block_size == 0 || i + 1 == row_end_.size()) n += row_end_[i];
  return n;
}

template <int Dim>
std::size_t Neighbours<Dim>::Block::bytes() const {
  std::size_t n = spindrift::bytes(index, candidate, hit) + spindrift::bytes(gradient, value) +
                  spindrift::bytes(volume, distance_squared);
  for (const auto& coordinate : x) n += spindrift::bytes(coordinate);
  n += spindrift::bytes(found);
  return n;
}

template <int Dim>
std::size_t Neighbours<Dim>::bytes() const {
  std::size_t n = spindrift::bytes(blocks_) + spindrift::bytes(row_end_) +
                  spindrift::bytes(volume_sum_, full_, no_slip_) + spindrift::bytes(boundary_, gradient_sum_);
  for (const Block& block : blocks_) n += block.bytes();
  return n;
}

template class Neighbours<2>;
template class Neighbours<3>;

}  // namespace spindrift
