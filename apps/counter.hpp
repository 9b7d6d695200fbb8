#pragma once
/// How far a command is, on a terminal.

#include <fmt/format.h>
#include <unistd.h>

#include <cstddef>

namespace spindrift {

/// One line on stderr, rewritten at every count and gone at the end; where stderr is no terminal, nothing.
class Counter {
 public:
  Counter(std::size_t n, const char* things) : n_(n), things_(things), on_terminal_(isatty(STDERR_FILENO) != 0) {}
  ~Counter() {
    if (on_terminal_) fmt::print(stderr, "\r\x1b[K");
  }
  Counter(const Counter&) = delete;
  Counter& operator=(const Counter&) = delete;
  void count() {
    if (on_terminal_) fmt::print(stderr, "\r{} of {} {}\x1b[K", ++done_, n_, things_);
  }

 private:
  std::size_t n_, done_ = 0;
  const char* things_;
  bool on_terminal_;
};

}  // namespace spindrift
