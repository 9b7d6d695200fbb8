#pragma once
/// Counter-based random numbers (Philox 4x32-10, Salmon et al. 2011): a pure function of (seed, stream, id, step), so
/// that no draw depends on the order of the loop, the number of threads or a restart.

#include <cstdint>

namespace spindrift {

/// What a draw is for; each purpose has its own stream.
enum class RandomStream : std::uint32_t {
  cover_sampling = 1,
  release_sampling = 2,
  entrainment_clock = 3,
  bernoulli = 4,
  stability_map = 5
};

/// A uniform number in (0, 1), never 0 and never 1.
double uniform(std::uint64_t seed, RandomStream stream, std::uint64_t id, std::uint32_t step = 0);

/// A unit-exponential number, -log(uniform), finite and positive.
double exponential(std::uint64_t seed, RandomStream stream, std::uint64_t id, std::uint32_t step = 0);

}  // namespace spindrift
