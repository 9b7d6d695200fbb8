#pragma once
/// Short vectors of floats for the pair sweeps: all components of one pair in one register.

#include <cstring>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

template <int Dim>
struct LanesOf;
template <>
struct LanesOf<2> {
  typedef float type __attribute__((vector_size(8)));
};
template <>
struct LanesOf<3> {
  typedef float type __attribute__((vector_size(16)));
};
/// Dim components; in 3D a fourth that means nothing.
template <int Dim>
using Lanes = typename LanesOf<Dim>::type;

/// How many floats a load or store touches.
template <int Dim>
inline constexpr std::size_t lane_width = sizeof(Lanes<Dim>) / sizeof(float);

template <int Dim>
inline Lanes<Dim> load(const float* p) {
  Lanes<Dim> v;
  std::memcpy(&v, p, sizeof v);
  return v;
}
template <int Dim>
inline void store(float* p, const Lanes<Dim>& v) {
  std::memcpy(p, &v, sizeof v);
}
template <int Dim>
inline float dot(const Lanes<Dim>& a, const Lanes<Dim>& b) {
  const Lanes<Dim> c = a * b;
  if constexpr (Dim == 2) {
    return c[0] + c[1];
  } else {
    return c[0] + c[1] + c[2];
  }
}
template <int Dim>
inline Lanes<Dim> to_lanes(const Vec<Dim>& x) {
  Lanes<Dim> v{};
  for (int k = 0; k < Dim; ++k) v[k] = static_cast<float>(x[k]);
  return v;
}

}  // namespace spindrift
