#pragma once
/// Parallel loops and sums whose results do not depend on the number of threads: work is cut into blocks of a fixed
/// size, and the blocks' partial results are combined in the order of the blocks.

#include <cstddef>
#include <memory>
#include <type_traits>
#include <vector>

namespace spindrift {

/// A call to f(begin, end) without owning f; valid while f lives.
class RangeBody {
 public:
  template <class F>
  RangeBody(F& f)  // NOLINT(google-explicit-constructor)
      : object_(&f),
        call_([](void* object, std::size_t begin, std::size_t end) { (*static_cast<F*>(object))(begin, end); }) {}
  void operator()(std::size_t begin, std::size_t end) const { call_(object_, begin, end); }

 private:
  void* object_;
  void (*call_)(void*, std::size_t, std::size_t);
};

/// Runs body(begin, end) over [0, n) in blocks of `block` items (the last may be shorter), blocks in any order.
void parallel_blocks(std::size_t n, std::size_t block, RangeBody body);

/// Runs f(i) for i in [0, n), `block` consecutive items a task.
template <class F>
void parallel_for(std::size_t n, F&& f, std::size_t block = 512) {
  auto body = [&f](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) f(i);
  };
  parallel_blocks(n, block, body);
}

inline constexpr std::size_t reduction_block = 4096;

/// combine(..., f(begin, end)) over the blocks of [0, n), combined in block order: the same bits with any number of
/// threads. f must itself go through its block in order.
template <class T, class F, class Combine>
T parallel_reduce(std::size_t n, T zero, F&& f, Combine&& combine, std::size_t block = reduction_block) {
  static_assert(std::is_trivially_destructible_v<T> || std::is_copy_constructible_v<T>);
  const std::size_t n_blocks = (n + block - 1) / block;
  if (n_blocks <= 1) return n == 0 ? zero : combine(zero, f(std::size_t{0}, n));
  static thread_local std::vector<T> scratch;  // reused: a warm reduction allocates nothing
  std::vector<T> partial = std::move(scratch);
  partial.assign(n_blocks, zero);
  auto body = [&](std::size_t begin, std::size_t end) { partial[begin / block] = f(begin, end); };
  parallel_blocks(n, block, body);
  T total = zero;
  for (const T& p : partial) total = combine(total, p);
  scratch = std::move(partial);
  return total;
}

/// sum of f(i) over [0, n) in a fixed order.
template <class T, class F>
T parallel_sum(std::size_t n, T zero, F&& f) {
  return parallel_reduce(
      n, zero,
      [&](std::size_t begin, std::size_t end) {
        T sum = zero;
        for (std::size_t i = begin; i < end; ++i) sum += f(i);
        return sum;
      },
      [](T a, const T& b) -> T {
        a += b;
        return a;
      });
}

/// The largest f(i) over [0, n), at least `least`. A NaN anywhere gives NaN.
template <class F>
double parallel_max(std::size_t n, double least, F&& f) {
  const auto larger = [](double a, double b) { return (b > a || b != b) ? b : a; };
  return parallel_reduce(
      n, least,
      [&](std::size_t begin, std::size_t end) {
        double m = least;
        for (std::size_t i = begin; i < end; ++i) m = larger(m, f(i));
        return m;
      },
      larger);
}

/// While it lives, parallel loops use `n_threads` threads, also more than the machine has (0: all of the machine's).
/// Limits may nest, on one thread.
class ThreadLimit {
 public:
  explicit ThreadLimit(int n_threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Control;
  std::unique_ptr<Control> control_;
};

/// The number of threads that parallel loops may use now.
int n_threads();

}  // namespace spindrift
