#pragma once
/// Runs of points along a row.

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

namespace spindrift {

/// Consecutive points [begin, end) of a row.
struct Span {
  int begin = 0, end = 0;
  bool empty() const { return end <= begin; }
};

/// The smallest span that holds both.
inline Span joined(Span a, Span b) {
  if (a.empty()) return b;
  if (b.empty()) return a;
  return {std::min(a.begin, b.begin), std::max(a.end, b.end)};
}

/// From the first to the last value of a row that is not 0.
inline Span nonzero_span(std::span<const double> row) {
  constexpr std::size_t block = 16;
  const auto bits = [&](std::size_t i) { return std::bit_cast<std::uint64_t>(row[i]) << 1; };  // -0 is 0
  const auto zero_block = [&](std::size_t first) {
    std::uint64_t any = 0;
    for (std::size_t k = 0; k < block; ++k) any |= bits(first + k);
    return any == 0;
  };
  std::size_t begin = 0, end = row.size();
  while (begin + block <= end && zero_block(begin)) begin += block;
  while (begin < end && bits(begin) == 0) ++begin;
  while (end >= begin + block && zero_block(end - block)) end -= block;
  while (end > begin && bits(end - 1) == 0) --end;
  return {static_cast<int>(begin), static_cast<int>(end)};
}

}  // namespace spindrift
