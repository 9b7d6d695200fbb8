#include "grid/open_fractions.hpp"

#include <algorithm>
#include <functional>

namespace spindrift {
namespace {

/// Positive part of a segment, triangle or tetrahedron with a linear distance. Corners are reordered.
template <int K>
double simplex_fraction(std::array<double, K + 1> d) {
  const auto part = [](double positive, double other) { return positive / (positive - other); };
  std::sort(d.begin(), d.end(), std::greater<>());
  const auto n_positive = std::count_if(d.begin(), d.end(), [](double x) { return x > 0; });
  if (n_positive == 0) return 0;
  if (n_positive == K + 1) return 1;
  if (n_positive == 1) {
    double f = 1;
    for (std::size_t k = 1; k <= K; ++k) f *= part(d[0], d[k]);
    return f;
  }
  if constexpr (K == 3) {
    if (n_positive == 2) {  // corners a, b against c, d: a wedge of three tetrahedra
      const double ac = part(d[0], d[2]), ad = part(d[0], d[3]), bc = part(d[1], d[2]), bd = part(d[1], d[3]);
      return ac * ad + ac * bd * (1 - ad) + bd * bc * (1 - ac);
    }
  }
  double f = 1;
  for (std::size_t k = 0; k < K; ++k) f *= part(-d[K], -d[k]);
  return 1 - f;
}

/// Sum of the fractions over the simplices that a box is cut into: those of its sides, each joined to its middle and to
/// the middles in `joined` of the boxes that it is a side of.
template <int K, int Full>
double sum_of_fractions(const std::array<double, std::size_t{1} << K>& d, std::array<double, Full + 1> joined) {
  if constexpr (K == 1) {
    joined[0] = d[0], joined[1] = d[1];
    return simplex_fraction<Full>(joined);
  } else {
    double middle = 0;
    for (const double x : d) middle += x / static_cast<double>(d.size());
    joined[K] = middle;
    double sum = 0;
    for (int axis = 0; axis < K; ++axis) {
      for (std::size_t side = 0; side < 2; ++side) {
        std::array<double, std::size_t{1} << (K - 1)> face;
        std::size_t n = 0;
        for (std::size_t c = 0; c < d.size(); ++c)
          if (((c >> axis) & 1) == side) face[n++] = d[c];
        sum += sum_of_fractions<K - 1, Full>(face, joined);
      }
    }
    return sum;
  }
}

}  // namespace

template <int K>
double open_fraction(const std::array<double, std::size_t{1} << K>& distance) {
  const auto n_positive = std::count_if(distance.begin(), distance.end(), [](double x) { return x > 0; });
  if (n_positive == 0) return 0;
  if (static_cast<std::size_t>(n_positive) == distance.size()) return 1;
  constexpr double n_simplices = K == 1 ? 1 : K == 2 ? 4 : 24;
  return std::clamp(sum_of_fractions<K, K>(distance, {}) / n_simplices, 0.0, 1.0);
}

template double open_fraction<1>(const std::array<double, 2>&);
template double open_fraction<2>(const std::array<double, 4>&);
template double open_fraction<3>(const std::array<double, 8>&);

}  // namespace spindrift
