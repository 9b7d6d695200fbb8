#pragma once
/// Counts the allocations of a program, by operators new and delete of its own. One file of a program may include this:
/// they are defined here. Arrays and the forms that do not throw come by here too, through the library's own operators.

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <new>

namespace spindrift {

inline std::atomic<std::uint64_t> n_allocations{0};

}  // namespace spindrift

// Inlined one without the other, they look to the compiler like a new that is freed by free().
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++spindrift::n_allocations;
  if (void* p = std::malloc(size > 0 ? size : 1)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  ++spindrift::n_allocations;
  const auto a = static_cast<std::size_t>(alignment);
  if (void* p = std::aligned_alloc(a, (size + a - 1) / a * a)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::align_val_t) noexcept {
  std::free(p);
}
[[gnu::noinline]] void operator delete(void* p, std::size_t, std::align_val_t) noexcept {
  std::free(p);
}
