#pragma once
/// Errors that users see, each with the exit code of its kind, and checks for programmers.

#include <stdexcept>
#include <string>

namespace spindrift {

enum class ExitCode : int {
  done = 0,
  bad_input = 2,
  unstable = 3,
  incompatible_file = 4,
  io_failed = 5,
  would_not_fit = 6,
  bug = 70,
  resumable = 75,
};

/// A failure with a message for a person and an exit code for a script.
class Error : public std::runtime_error {
 public:
  Error(ExitCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  ExitCode code() const { return code_; }

 private:
  ExitCode code_;
};

[[noreturn]] void check_failed(const char* condition, const char* file, int line);

}  // namespace spindrift

/// A precondition: a violation is a bug of ours. Compiled in by the presets dev and audit.
#ifdef SPINDRIFT_CHECKS
#define SPINDRIFT_CHECK(condition) \
  ((condition) ? static_cast<void>(0) : ::spindrift::check_failed(#condition, __FILE__, __LINE__))
#else
#define SPINDRIFT_CHECK(condition) static_cast<void>(0)
#endif
