#include "core/random.hpp"

#include <Random123/philox.h>

#include <cmath>

namespace spindrift {

double uniform(std::uint64_t seed, RandomStream stream, std::uint64_t id, std::uint32_t step) {
  using Generator = r123::Philox4x32;
  const Generator::ctr_type counter{
      {static_cast<std::uint32_t>(id), static_cast<std::uint32_t>(id >> 32), step, static_cast<std::uint32_t>(stream)}};
  const Generator::key_type key{{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32)}};
  const auto bits = Generator{}(counter, key);
  const std::uint64_t mantissa = ((static_cast<std::uint64_t>(bits[1]) << 32) | bits[0]) >> 12;
  return (static_cast<double>(mantissa) + 0.5) * 0x1p-52;
}

double exponential(std::uint64_t seed, RandomStream stream, std::uint64_t id, std::uint32_t step) {
  return -std::log(uniform(seed, stream, id, step));
}

}  // namespace spindrift
