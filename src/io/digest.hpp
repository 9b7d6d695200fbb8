#pragma once
/// A fingerprint of data: XXH3 with 128 bits over their bytes as they stand in memory (little-endian).

#include <cstddef>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace spindrift {

/// Built up piece by piece. Each piece goes in with its length, so that moving a value from the end of one array to the
/// beginning of the next changes the digest; bytes() alone goes in bare.
class Digest {
 public:
  Digest();
  ~Digest();
  Digest(Digest&&) noexcept;
  Digest& operator=(Digest&&) noexcept;

  Digest& bytes(std::span<const std::byte> raw);
  Digest& add(std::string_view text);
  template <class T>
  Digest& add(std::span<const T> values) {
    static_assert(std::has_unique_object_representations_v<T> || std::is_floating_point_v<T>, "no padding");
    return piece(std::as_bytes(values));
  }
  template <class T>
  requires std::is_arithmetic_v<T> Digest& add(T value) { return add(std::span<const T>(&value, 1)); }

  /// 32 hexadecimal digits of what was added so far.
  std::string hex() const;

 private:
  Digest& piece(std::span<const std::byte> raw);

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace spindrift
