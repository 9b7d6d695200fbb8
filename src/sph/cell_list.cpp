#include "sph/cell_list.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <sstream>
#include <utility>

#include "core/error.hpp"
#include "core/memory.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

constexpr int digit_bits = 11;

}  // namespace

template <int Dim>
typename CellList<Dim>::Key CellList<Dim>::pack(const Index<Dim>& c) {
  Key key = 0;
  for (int k = Dim - 1; k >= 0; --k) key = (key << bits) | static_cast<Key>(c[k] + (1 << (bits - 1)));
  return key;
}

/// The step of a key from a cell to row `run` of the 3^(Dim-1) rows around it, modulo 2^64.
template <int Dim>
typename CellList<Dim>::Key CellList<Dim>::row_shift(std::size_t run) {
  std::int64_t shift = 0;
  for (int k = 1; k < Dim; ++k, run /= 3) {
    shift += (static_cast<std::int64_t>(run % 3) - 1) * (std::int64_t{1} << (bits * k));
  }
  return static_cast<Key>(shift);
}

template <int Dim>
void CellList<Dim>::build(Particles<Dim>& particles) {
  check_positions(particles);
  if (sort_entries(particles)) permute(particles);
  index_cells();
  find_runs();
}

template <int Dim>
void CellList<Dim>::check_positions(const Particles<Dim>& particles) const {
  constexpr std::size_t none = std::numeric_limits<std::size_t>::max();
  const std::size_t bad = parallel_reduce(
      particles.size(), none,
      [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i)
          if (absurd(particles.position[i])) return i;
        return none;
      },
      [](std::size_t a, std::size_t b) { return std::min(a, b); });
  if (bad == none) return;
  std::ostringstream message;
  message << "particle " << particles.id[bad] << " is at (" << particles.position[bad].transpose() << ") m, velocity ("
          << particles.velocity[bad].transpose() << ") m/s";
  throw Error(ExitCode::unstable, message.str());
}

/// Radix sort by the bits of the key in which the particles differ, then by id within a key. Returns whether the order
/// changed.
template <int Dim>
bool CellList<Dim>::sort_entries(const Particles<Dim>& particles) {
  const std::size_t n = particles.size();
  entries_.resize(n);
  order_.resize(n);
  if (n == 0) return false;

  struct Extent {
    Index<Dim> lower, upper;
  };
  const Index<Dim> first = coordinates(particles.position[0]);
  const Extent extent = parallel_reduce(
      n, Extent{first, first},
      [&](std::size_t begin, std::size_t end) {
        Extent e{first, first};
        for (std::size_t i = begin; i < end; ++i) {
          const Index<Dim> c = coordinates(particles.position[i]);
          entries_[i] = {pack(c), static_cast<std::uint32_t>(i)};
          for (int k = 0; k < Dim; ++k) {
            e.lower[k] = std::min(e.lower[k], c[k]);
            e.upper[k] = std::max(e.upper[k], c[k]);
          }
        }
        return e;
      },
      [](Extent a, const Extent& b) {
        for (int k = 0; k < Dim; ++k) {
          a.lower[k] = std::min(a.lower[k], b.lower[k]);
          a.upper[k] = std::max(a.upper[k], b.upper[k]);
        }
        return a;
      });

  const auto before = [&](const Entry& a, const Entry& b) {
    return a.key != b.key ? a.key < b.key : particles.id[a.index] < particles.id[b.index];
  };
  if (std::is_sorted(entries_.begin(), entries_.end(), before)) {
    for (std::size_t i = 0; i < n; ++i) order_[i] = static_cast<std::uint32_t>(i);
    return false;
  }

  const Key origin = pack(extent.lower);
  std::array<int, Dim> width;
  int total_width = 0;
  for (int k = 0; k < Dim; ++k) {
    width[k] = std::bit_width(static_cast<unsigned>(extent.upper[k] - extent.lower[k]));
    total_width += width[k];
  }
  const auto compact = [&](Key key) {
    key -= origin;
    Key packed = 0;
    for (int k = Dim - 1; k >= 0; --k) {
      packed = (packed << width[k]) | ((key >> (bits * k)) & ((Key{1} << bits) - 1));
    }
    return packed;
  };
  other_entries_.resize(n);
  for (int shift = 0; shift < total_width; shift += digit_bits) {
    std::array<std::uint32_t, 1 << digit_bits> place{};
    const auto digit = [&](const Entry& e) { return (compact(e.key) >> shift) & (place.size() - 1); };
    for (const Entry& e : entries_) ++place[digit(e)];
    std::uint32_t sum = 0;
    for (std::uint32_t& p : place) sum += std::exchange(p, sum);
    for (const Entry& e : entries_) other_entries_[place[digit(e)]++] = e;
    entries_.swap(other_entries_);
  }
  for (std::size_t i = 1; i < n; ++i) {
    const Entry e = entries_[i];
    std::size_t k = i;
    for (; k > 0 && entries_[k - 1].key == e.key && particles.id[entries_[k - 1].index] > particles.id[e.index]; --k) {
      entries_[k] = entries_[k - 1];
    }
    entries_[k] = e;
  }
  for (std::size_t i = 0; i < n; ++i) order_[i] = entries_[i].index;
  return true;
}

template <int Dim>
void CellList<Dim>::permute(Particles<Dim>& particles) {
  particles.for_each_array([&]<class T>(std::vector<T>& array) {
    auto& other = std::get<std::vector<T>>(others_);
    other.resize(array.size());
    parallel_for(
        array.size(), [&](std::size_t i) { other[i] = array[order_[i]]; }, 4096);
    array.swap(other);
  });
}

template <int Dim>
void CellList<Dim>::index_cells() {
  keys_.clear();
  starts_.clear();
  for (std::size_t i = 0; i < entries_.size(); ++i) {
    if (i == 0 || entries_[i].key != entries_[i - 1].key) {
      keys_.push_back(entries_[i].key);
      starts_.push_back(static_cast<std::uint32_t>(i));
    }
  }
  starts_.push_back(static_cast<std::uint32_t>(entries_.size()));
}

/// Keys ascend, so the bounds of each row's run only move up as the cells go by.
template <int Dim>
void CellList<Dim>::find_runs() {
  runs_.resize(keys_.size());
  auto sweep = [&](std::size_t begin, std::size_t end) {
    for (std::size_t run = 0; run < n_runs; ++run) {
      const Key shift = row_shift(run);
      auto low = static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), keys_[begin] + shift - 1) -
                                          keys_.begin());
      std::size_t high = low;
      for (std::size_t c = begin; c < end; ++c) {
        const Key row = keys_[c] + shift;
        while (low < keys_.size() && keys_[low] < row - 1) ++low;
        while (high < keys_.size() && keys_[high] <= row + 1) ++high;
        runs_[c][run] = {starts_[low], starts_[std::max(low, high)]};
      }
    }
  };
  parallel_blocks(keys_.size(), 256, sweep);
}

template <int Dim>
std::size_t CellList<Dim>::cell_of(std::uint32_t i) const {
  return static_cast<std::size_t>(std::upper_bound(starts_.begin(), starts_.end(), i) - starts_.begin()) - 1;
}

template <int Dim>
typename CellList<Dim>::Runs CellList<Dim>::runs_near(const Vec<Dim>& x) const {
  Runs runs{};
  if (keys_.empty() || absurd(x)) return runs;
  const Key key = pack(coordinates(x));
  for (std::size_t run = 0; run < n_runs; ++run) {
    const Key row = key + row_shift(run);
    const auto low = std::lower_bound(keys_.begin(), keys_.end(), row - 1);
    auto high = low;
    while (high != keys_.end() && *high <= row + 1) ++high;
    runs[run] = {starts_[static_cast<std::size_t>(low - keys_.begin())],
                 starts_[static_cast<std::size_t>(high - keys_.begin())]};
  }
  return runs;
}

template <int Dim>
void CellList<Dim>::release_scratch() {
  entries_ = {};
  other_entries_ = {};
  others_ = {};
}

template <int Dim>
std::size_t CellList<Dim>::bytes() const {
  return spindrift::bytes(order_, starts_) + spindrift::bytes(keys_) + spindrift::bytes(runs_) +
         spindrift::bytes(entries_, other_entries_) +
         std::apply([](const auto&... other) { return spindrift::bytes(other...); }, others_);
}

template class CellList<2>;
template class CellList<3>;

}  // namespace spindrift
