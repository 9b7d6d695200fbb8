#pragma once
/// Lists of a scene as vectors and boxes.

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "sph/sampling.hpp"

namespace spindrift {

inline bool is_zero(const std::vector<double>& numbers) {
  return std::all_of(numbers.begin(), numbers.end(), [](double x) { return x == 0; });
}

/// `otherwise` for an empty list.
template <int Dim>
Vec<Dim> vector_or(const std::vector<double>& numbers, const Vec<Dim>& otherwise = Vec<Dim>::Zero()) {
  if (numbers.empty()) return otherwise;
  SPINDRIFT_CHECK(numbers.size() == Dim);
  return Eigen::Map<const Vec<Dim>>(numbers.data());
}

/// Empty lists are zeros.
template <int Dim>
Box<Dim> box_of(const std::vector<double>& lower, const std::vector<double>& upper) {
  return {vector_or<Dim>(lower), vector_or<Dim>(upper)};
}

/// What the domain leaves free across the slope.
template <int Dim>
Breadth breadth_of(const Box<Dim>& domain) {
  if constexpr (Dim == 3) {
    return {domain.lower[1], domain.upper[1]};
  } else {
    return {};
  }
}

}  // namespace spindrift
