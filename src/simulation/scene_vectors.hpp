#pragma once
/// Lists of a scene as vectors and boxes.

#include <vector>

#include "core/error.hpp"
#include "core/vec.hpp"
#include "sph/sampling.hpp"

namespace spindrift {

/// `otherwise` for an empty list.
template <int Dim>
Vec<Dim> vector_or(const std::vector<double>& numbers, const Vec<Dim>& otherwise) {
  if (numbers.empty()) return otherwise;
  SPINDRIFT_CHECK(numbers.size() == Dim);
  return Eigen::Map<const Vec<Dim>>(numbers.data());
}

/// Empty lists are zeros.
template <int Dim>
Box<Dim> box_of(const std::vector<double>& lower, const std::vector<double>& upper) {
  return {vector_or<Dim>(lower, Vec<Dim>::Zero()), vector_or<Dim>(upper, Vec<Dim>::Zero())};
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
