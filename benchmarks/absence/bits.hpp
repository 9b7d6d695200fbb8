#pragma once
/// A fingerprint of numbers, without a library.

#include <bit>
#include <cstdint>
#include <span>

namespace spindrift::absence {

/// FNV-1a over whole numbers of 64 bits; pass the last result on to go on.
inline std::uint64_t bits_of(std::span<const double> values, std::uint64_t hash = 14695981039346656037u) {
  for (const double value : values) hash = (hash ^ std::bit_cast<std::uint64_t>(value)) * 1099511628211u;
  return hash;
}

}  // namespace spindrift::absence
