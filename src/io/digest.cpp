#include "io/digest.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstdint>
#include <new>

namespace spindrift {

struct Digest::State {
  XXH3_state_t* xxh = XXH3_createState();

  State() {
    if (xxh == nullptr || XXH3_128bits_reset(xxh) == XXH_ERROR) throw std::bad_alloc();
  }
  ~State() { XXH3_freeState(xxh); }
  State(const State&) = delete;
  State& operator=(const State&) = delete;
};

Digest::Digest() : state_(std::make_unique<State>()) {}
Digest::~Digest() = default;
Digest::Digest(Digest&&) noexcept = default;
Digest& Digest::operator=(Digest&&) noexcept = default;

Digest& Digest::bytes(std::span<const std::byte> raw) {
  XXH3_128bits_update(state_->xxh, raw.data(), raw.size());
  return *this;
}

Digest& Digest::piece(std::span<const std::byte> raw) {
  const std::uint64_t n = raw.size();
  return bytes(std::as_bytes(std::span(&n, 1))).bytes(raw);
}

Digest& Digest::add(std::string_view text) {
  return piece(std::as_bytes(std::span(text)));
}

std::string Digest::hex() const {
  const XXH128_hash_t hash = XXH3_128bits_digest(state_->xxh);
  return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

}  // namespace spindrift
