#include "progress_line.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>

#include "plain_text.hpp"

namespace spindrift {
namespace {

double fraction(const Progress& p) {
  return p.end_time > 0 ? std::clamp(p.time / p.end_time, 0.0, 1.0) : 1;
}

std::string line(const Progress& p) {
  const double done = fraction(p);
  const std::string left = done > 0 ? duration_text(p.wall_seconds * (1 - done) / done) : "?";
  return fmt::format(
      "{:.2f} / {:g} s  {:3.0f} %  step {}  dt {:.3g} ms ({})  {} particles, {} entrained  smoke {:.3g} kg  "
      "{}, {} left",
      p.time, p.end_time, 100 * done, count_text(static_cast<double>(p.step)), 1e3 * p.dt, p.limiter,
      count_text(static_cast<double>(p.n_dense)), count_text(static_cast<double>(p.n_entrained)), p.smoke_mass,
      duration_text(p.wall_seconds), left);
}

}  // namespace

ProgressLine::ProgressLine() : on_terminal_(isatty(STDERR_FILENO) != 0) {}

bool ProgressLine::due(const Progress& progress) const {
  const double waited = progress.wall_seconds - shown_wall_;
  if (on_terminal_) return !shown_ || waited >= 0.1;
  return waited >= 5 || fraction(progress) - shown_fraction_ >= 0.1;
}

void ProgressLine::show(const Progress& progress) {
  last_ = progress;
  if (!due(progress)) return;
  if (on_terminal_) {
    fmt::print(stderr, "\r{}\x1b[K", line(progress));
    std::fflush(stderr);
  } else {
    fmt::print(stderr, "{}\n", line(progress));
  }
  shown_ = true;
  shown_wall_ = progress.wall_seconds;
  shown_fraction_ = fraction(progress);
}

void ProgressLine::end() {
  if (on_terminal_ && shown_) fmt::print(stderr, "\r{}\x1b[K\n", line(last_));
}

}  // namespace spindrift
