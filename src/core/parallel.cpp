#include "core/parallel.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>

namespace spindrift {

void parallel_blocks(std::size_t n, std::size_t block, RangeBody body) {
  const std::size_t n_blocks = (n + block - 1) / block;
  if (n_blocks == 0) return;
  if (n_blocks == 1) {
    body(0, n);
    return;
  }
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, n_blocks), [&](const auto& blocks) {
    for (std::size_t b = blocks.begin(); b != blocks.end(); ++b) body(b * block, std::min(n, (b + 1) * block));
  });
}

struct ThreadLimit::Control {
  oneapi::tbb::global_control limit;
};

ThreadLimit::ThreadLimit(int n_threads) {
  const std::size_t n = n_threads > 0 ? static_cast<std::size_t>(n_threads)
                                      : static_cast<std::size_t>(oneapi::tbb::info::default_concurrency());
  control_ = std::make_unique<Control>(
      Control{oneapi::tbb::global_control(oneapi::tbb::global_control::max_allowed_parallelism, n)});
}

ThreadLimit::~ThreadLimit() = default;

int n_threads() {
  using oneapi::tbb::global_control;
  return static_cast<int>(std::min(global_control::active_value(global_control::max_allowed_parallelism),
                                   static_cast<std::size_t>(oneapi::tbb::info::default_concurrency())));
}

}  // namespace spindrift
