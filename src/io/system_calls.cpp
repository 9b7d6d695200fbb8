#include "io/system_calls.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <mutex>
#include <utility>

#include "io/system.hpp"

namespace spindrift {

struct CallWatch::State {
  std::mutex mutex;
  bool watching = false;
  std::size_t fail_at = never, write_limit = never;
  int error = 0;
  std::vector<std::string> calls;
};

CallWatch::State& CallWatch::state() {
  static State state;
  return state;
}

CallWatch::CallWatch(std::size_t fail_at, int error, std::size_t write_limit) {
  const std::lock_guard lock(state().mutex);
  state().watching = true;
  state().fail_at = fail_at;
  state().write_limit = write_limit;
  state().error = error;
  state().calls.clear();
}

CallWatch::~CallWatch() {
  const std::lock_guard lock(state().mutex);
  state().watching = false;
}

std::vector<std::string> CallWatch::calls() const {
  const std::lock_guard lock(state().mutex);
  return state().calls;
}

struct WatchedCalls {
  /// The error that the call is to fail with, or 0.
  static int error_of(const char* call) {
    CallWatch::State& state = CallWatch::state();
    const std::lock_guard lock(state.mutex);
    if (!state.watching) return 0;
    state.calls.emplace_back(call);
    return state.calls.size() - 1 == state.fail_at ? state.error : 0;
  }
  static std::size_t write_limit() {
    CallWatch::State& state = CallWatch::state();
    const std::lock_guard lock(state.mutex);
    return state.watching ? state.write_limit : CallWatch::never;
  }
};

namespace {

[[noreturn]] void fail(const char* call, int error) {
  throw std::system_error(error, std::generic_category(), call);
}

/// f() until it is not interrupted; f returns a negative number on failure.
template <class F>
auto retried(const char* call, F&& f) {
  for (;;) {
    const int injected = WatchedCalls::error_of(call);
    if (injected == EINTR) continue;
    if (injected != 0) fail(call, injected);
    const auto result = f();
    if (result >= 0) return result;
    if (errno != EINTR) fail(call, errno);
  }
}

/// Never tried again: Linux gives the descriptor back even when it reports an error.
void close_descriptor(const char* call, int descriptor) {
  const int injected = WatchedCalls::error_of(call);
  const int error = ::close(descriptor) == 0 ? injected : errno;
  if (error != 0 && error != EINTR) fail(call, error);
}

}  // namespace

OutputFile::OutputFile(const std::filesystem::path& path)
    : descriptor_(retried(
          "open", [&] { return ::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, 0666); })) {}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

void OutputFile::write(std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const auto n = retried("write", [&] {
      return ::write(descriptor_, bytes.data(), std::min(bytes.size(), WatchedCalls::write_limit()));
    });
    bytes = bytes.subspan(static_cast<std::size_t>(n));
  }
}

void OutputFile::sync() {
  retried("fsync", [&] { return ::fsync(descriptor_); });
}

void OutputFile::close() {
  close_descriptor("close", std::exchange(descriptor_, -1));
}

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to) {
  retried("rename", [&] { return std::rename(from.c_str(), to.c_str()); });
}

void sync_folder(const std::filesystem::path& folder) {
  const int descriptor =
      retried("open folder", [&] { return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC); });
  try {
    retried("fsync folder", [&] { return ::fsync(descriptor); });
  } catch (...) {
    ::close(descriptor);
    throw;
  }
  ::close(descriptor);
}

Error write_error(const std::filesystem::path& path, const std::system_error& reason, std::uint64_t bytes_needed) {
  return {ExitCode::io_failed, fmt::format("cannot write {}: {} (needed {} bytes, free {} bytes)", path.string(),
                                           reason.what(), bytes_needed, free_disk_bytes(path))};
}

}  // namespace spindrift
