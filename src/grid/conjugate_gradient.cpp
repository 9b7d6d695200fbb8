#include "grid/conjugate_gradient.hpp"

#include <cmath>

namespace spindrift {

namespace {

/// The sum of f(place) over all cells in the spans, in fixed order; f may write at its place.
template <int Dim, class F>
double sum_over_cells(const PoissonOperator<Dim>& poisson, F&& f) {
  const ParityLayout<Dim>& layout = poisson.layout;
  return layout.sum_over_rows([&](std::size_t number, const Index<Dim>& start) {
    double sum = 0;
    for (int parity = 0; parity < 2; ++parity) {
      const RowSpan span = layout.in_parity(poisson.spans[number], parity);
      const std::ptrdiff_t own = layout.own(start, parity);
      sum += lane_sum(span.begin, span.end, [&](int m) { return f(own + m); });
    }
    return sum;
  });
}

}  // namespace

template <int Dim>
ConjugateGradient<Dim>::ConjugateGradient(const ParityLayout<Dim>& layout)
    : solution(layout.size, 0.0),
      right_side(layout.size, 0.0),
      direction_(layout.size, 0.0),
      image_(layout.size, 0.0),
      multigrid_(layout.cells) {}

/// Makes the right side b - A x, or x zero; returns its norm squared.
template <int Dim>
double ConjugateGradient<Dim>::take_guess(const PoissonOperator<Dim>& poisson, double b_norm2) {
  poisson.clear_closed(solution);
  const double r_norm2 = poisson.residual(image_, solution, right_side);
  if (r_norm2 < b_norm2) {
    right_side.swap(image_);
    return r_norm2;
  }
  std::fill(solution.begin(), solution.end(), 0.0);
  return b_norm2;
}

template <int Dim>
typename ConjugateGradient<Dim>::Result ConjugateGradient<Dim>::solve(const PoissonOperator<Dim>& poisson,
                                                                      double tolerance, int max_iterations) {
  const double* b = right_side.data();
  const double b_norm2 = sum_over_cells(poisson, [=](std::ptrdiff_t n) { return b[n] * b[n]; });
  if (b_norm2 == 0 || !std::isfinite(b_norm2)) {
    std::fill(solution.begin(), solution.end(), 0.0);
    return {0, b_norm2, b_norm2 == 0};
  }
  double r_norm2 = take_guess(poisson, b_norm2);
  double* x = solution.data();
  double* r = right_side.data();
  double* d = direction_.data();
  double* q = image_.data();
  multigrid_.build(poisson);
  float* source = multigrid_.right_side().data();
  const float* z = multigrid_.solution().data();

  // The cycle works in single precision: its input is scaled to |b|, so that nothing under- or overflows.
  double scale = 1 / std::sqrt(b_norm2);
  sum_over_cells(poisson, [=](std::ptrdiff_t n) {
    source[n] = static_cast<float>(scale * r[n]);
    return 0.0;
  });
  Result result;
  double rz_before = 0;
  const auto unsolved = [&] {
    result.residual = std::sqrt(r_norm2 / b_norm2);
    return !(result.residual <= tolerance);
  };
  while (unsolved() && result.iterations < max_iterations && std::isfinite(r_norm2)) {
    multigrid_.cycle();
    const double rz = sum_over_cells(poisson, [=](std::ptrdiff_t n) { return r[n] * static_cast<double>(z[n]); });
    const double beta = result.iterations == 0 ? 0 : rz / rz_before;
    sum_over_cells(poisson, [=](std::ptrdiff_t n) {
      d[n] = static_cast<double>(z[n]) + beta * d[n];
      return 0.0;
    });
    const double dq = poisson.apply(image_, direction_);
    const double alpha = rz / dq;
    if (!(dq > 0) || !std::isfinite(alpha)) break;
    r_norm2 = sum_over_cells(poisson, [=](std::ptrdiff_t n) {
      x[n] += alpha * d[n];
      r[n] -= alpha * q[n];
      source[n] = static_cast<float>(scale * r[n]);
      return r[n] * r[n];
    });
    rz_before = rz;
    ++result.iterations;
  }
  result.converged = result.residual <= tolerance;
  return result;
}

template <int Dim>
void ConjugateGradient<Dim>::clear() {
  for (std::vector<double>* v : {&solution, &right_side, &direction_, &image_}) std::fill(v->begin(), v->end(), 0.0);
  multigrid_.clear();
}

template class ConjugateGradient<2>;
template class ConjugateGradient<3>;

}  // namespace spindrift
