#include "core/parallel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

namespace spindrift {
namespace {

/// Of the innermost ThreadLimit; null: all of the machine's threads.
oneapi::tbb::task_arena* limited_arena = nullptr;

}  // namespace

void parallel_blocks(std::size_t n, std::size_t block, RangeBody body) {
  const std::size_t n_blocks = (n + block - 1) / block;
  if (n_blocks == 0) return;
  if (n_blocks == 1) {
    body(0, n);
    return;
  }
  const auto all_blocks = [&] {
    oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n_blocks), [&](const auto& blocks) {
      for (std::size_t b = blocks.begin(); b != blocks.end(); ++b) body(b * block, std::min(n, (b + 1) * block));
    });
  };
  limited_arena ? limited_arena->execute(all_blocks) : all_blocks();
}

struct ThreadLimit::Control {
  oneapi::tbb::global_control workers;
  oneapi::tbb::task_arena arena;
  oneapi::tbb::task_arena* outer;

  explicit Control(int n)
      : workers(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n)),
        arena(n),
        outer(limited_arena) {
    limited_arena = &arena;
  }
  ~Control() { limited_arena = outer; }
};

ThreadLimit::ThreadLimit(int n_threads)
    : control_(std::make_unique<Control>(n_threads > 0 ? n_threads : oneapi::tbb::info::default_concurrency())) {}

ThreadLimit::~ThreadLimit() = default;

int n_threads() {
  return limited_arena ? limited_arena->max_concurrency() : oneapi::tbb::info::default_concurrency();
}

}  // namespace spindrift
