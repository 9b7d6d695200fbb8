#pragma once
/// A few doubles that compute as one, as wide as the machine that is compiled for. Loops are written once, for T = Pack
/// or double.

#include <cstring>

namespace spindrift {

#if defined(__AVX512F__)
inline constexpr int pack_size = 8;
#elif defined(__AVX__)
inline constexpr int pack_size = 4;
#else
inline constexpr int pack_size = 2;
#endif
using Pack = double __attribute__((vector_size(8 * pack_size)));

template <class T>
T load(const double* p) {
  T x;
  std::memcpy(&x, p, sizeof x);
  return x;
}
template <class T>
void store(double* p, const T& x) {
  std::memcpy(p, &x, sizeof x);
}
template <class T>
T smaller(T a, T b) {
  return a < b ? a : b;
}
template <class T>
T larger(T a, T b) {
  return a > b ? a : b;
}
template <class T>
T magnitude(T a) {
  return a < 0 ? -a : a;
}

/// f.operator()<T>(i) over [begin, end), T = Pack or double for the rest. Each i is visited once.
template <class F>
void for_each_pack(int begin, int end, F&& f) {
  int i = begin;
  for (; i + pack_size <= end; i += pack_size) f.template operator()<Pack>(i);
  for (; i < end; ++i) f.template operator()<double>(i);
}

/// The same, but the last pack reaches back over items done before: f must not read what it writes.
template <class F>
void for_each_pack_overlapping(int begin, int end, F&& f) {
  if (end - begin < pack_size) return for_each_pack(begin, end, f);
  int i = begin;
  for (; i + pack_size <= end; i += pack_size) f.template operator()<Pack>(i);
  if (i < end) f.template operator()<Pack>(end - pack_size);
}

/// sum of f.operator()<T>(i) over [begin, end), in an order fixed by the range.
template <class F>
double sum_packs(int begin, int end, F&& f) {
  Pack sum{};
  double rest = 0;
  int i = begin;
  for (; i + pack_size <= end; i += pack_size) sum += f.template operator()<Pack>(i);
  for (; i < end; ++i) rest += f.template operator()<double>(i);
  for (int k = 0; k < pack_size; ++k) rest += sum[k];
  return rest;
}

/// The largest f.operator()<T>(i) over [begin, end), at least 0; NaN where one is not finite.
template <class F>
double max_packs(int begin, int end, F&& f) {
  Pack most{}, bad{};
  double rest = 0, bad_rest = 0;
  int i = begin;
  for (; i + pack_size <= end; i += pack_size) {
    const Pack x = f.template operator()<Pack>(i);
    most = larger(x, most);
    bad += x - x;
  }
  for (; i < end; ++i) {
    const double x = f.template operator()<double>(i);
    rest = larger(x, rest);
    bad_rest += x - x;
  }
  for (int k = 0; k < pack_size; ++k) {
    rest = larger(static_cast<double>(most[k]), rest);
    bad_rest += bad[k];
  }
  return rest + bad_rest;
}

}  // namespace spindrift
