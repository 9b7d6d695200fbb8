#pragma once
/// Bytes held by containers, for the memory report and the tests that absent physics holds none.

#include <cstddef>
#include <vector>

namespace spindrift {

template <class... T>
std::size_t bytes(const std::vector<T>&... containers) {
  return (std::size_t{0} + ... + (containers.capacity() * sizeof(T)));
}

}  // namespace spindrift
