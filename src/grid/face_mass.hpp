#pragma once
/// Sums over faces weighted with the mass of their control volumes: air and half of each neighbour cell's smoke.

#include <algorithm>
#include <limits>

#include "core/parallel.hpp"
#include "grid/ground.hpp"
#include "grid/pack.hpp"

namespace spindrift {

/// sum of face mass times value<T>(face, low, high), in a fixed order, over the open faces. face, low, high: flat
/// numbers of the (first) face and of the cells on its sides, at a side of the domain twice the one that exists. T =
/// Pack or double. value is also called for closed faces; it may change the face's velocity.
/// columns   only faces of these, along the first axis
template <int Dim, class F>
double sum_over_faces(int axis, const Ground<Dim>& ground, const Field<Dim>& smoke, F&& value,
                      Span columns = {0, std::numeric_limits<int>::max()}) {
  const Field<Dim>& air = ground.air_mass()[axis];
  const int n = smoke.shape()[axis];
  const auto below = static_cast<std::size_t>(smoke.stride(axis));
  const auto sum_of_row = [&](std::size_t r) {
    const Span open = ground.rows(axis)[r];
    const Span span{std::max(open.begin, columns.begin), std::min(open.end, columns.end)};
    if (span.empty()) return 0.0;
    const Index<Dim> start = air.row_start(r);
    const std::size_t first = flat<Dim>(start, air.shape()), first_cell = flat<Dim>(start, smoke.shape());
    const double* mass = smoke.values().data();
    const auto edge = [&](int i) {
      const std::size_t face = first + static_cast<std::size_t>(i);
      const Index<Dim> at = shifted<Dim>(start, 0, i);
      const std::size_t cell = flat<Dim>(at[axis] > 0 ? shifted<Dim>(at, axis, -1) : at, smoke.shape());
      const double x = value.template operator()<double>(face, cell, cell);
      return air[face] > 0 ? (air[face] + 0.5 * mass[cell]) * x : 0.0;
    };
    const bool at_side = axis != 0 && (start[axis] == 0 || start[axis] == n);
    double sum = 0;
    if (at_side) {
      for (int i = span.begin; i < span.end; ++i) sum += edge(i);
      return sum;
    }
    Span inner = span;
    if (axis == 0) {
      if (span.begin == 0) sum += edge(inner.begin++);
      if (span.end == n + 1 && inner.end > inner.begin) sum += edge(--inner.end);
    }
    return sum + sum_packs(inner.begin, inner.end, [&]<class T>(int i) -> T {
             const std::size_t face = first + static_cast<std::size_t>(i),
                               high = first_cell + static_cast<std::size_t>(i);
             const T a = load<T>(&air[face]);
             const T x = value.template operator()<T>(face, high - below, high);
             return a > 0 ? (a + 0.5 * (load<T>(mass + high) + load<T>(mass + high - below))) * x : T{};
           });
  };
  return parallel_reduce(
      air.n_rows(), 0.0,
      [&](std::size_t begin, std::size_t end) {
        double sum = 0;
        for (std::size_t r = begin; r < end; ++r) sum += sum_of_row(r);
        return sum;
      },
      [](double a, double b) { return a + b; }, air.rows_per_task());
}

/// Momentum that `mass` of smoke brings to a cell: half to each of its faces on both sides, closed ones take none.
template <int Dim>
Vec<Dim> momentum_of_smoke(double mass, const Index<Dim>& cell, const FaceField<Dim>& u, const Ground<Dim>& ground) {
  Vec<Dim> momentum = Vec<Dim>::Zero();
  for (int axis = 0; axis < Dim; ++axis) {
    for (int side = 0; side < 2; ++side) {
      const Index<Dim> face = shifted<Dim>(cell, axis, side);
      if (ground.air_mass()[axis][face] > 0) momentum[axis] += 0.5 * mass * u[axis][face];
    }
  }
  return momentum;
}

/// The same of all smoke, in a fixed order.
template <int Dim>
Vec<Dim> momentum_of_smoke(const Field<Dim>& smoke, const FaceField<Dim>& u, const Ground<Dim>& ground) {
  return parallel_reduce(
      smoke.n_rows(), Vec<Dim>(Vec<Dim>::Zero()),
      [&](std::size_t begin, std::size_t end) {
        Vec<Dim> sum = Vec<Dim>::Zero();
        for (std::size_t r = begin; r < end; ++r) {
          const auto row = smoke.row(r);
          const Span span = nonzero_span(row);
          Index<Dim> cell = smoke.row_start(r);
          for (cell[0] = span.begin; cell[0] < span.end; ++cell[0])
            sum += momentum_of_smoke<Dim>(row[static_cast<std::size_t>(cell[0])], cell, u, ground);
        }
        return sum;
      },
      [](const Vec<Dim>& a, const Vec<Dim>& b) -> Vec<Dim> { return a + b; }, smoke.rows_per_task());
}

}  // namespace spindrift
