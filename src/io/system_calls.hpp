#pragma once
/// Where writing meets the operating system. Every call retries when interrupted and throws std::system_error
/// otherwise; tests see the calls, and make them fail, through a CallWatch.

#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <span>
#include <string>
#include <system_error>
#include <vector>

#include "core/error.hpp"

namespace spindrift {

/// A file opened for writing, created or emptied.
class OutputFile {
 public:
  explicit OutputFile(const std::filesystem::path& path);
  ~OutputFile();
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;

  void write(std::span<const std::byte> bytes);
  void sync();
  void close();

 private:
  int descriptor_;
};

void rename_file(const std::filesystem::path& from, const std::filesystem::path& to);
void sync_folder(const std::filesystem::path& folder);

/// The error a user sees: "cannot write PATH: CALL: REASON (needed N bytes, free M bytes)", exit code io_failed.
Error write_error(const std::filesystem::path& path, const std::system_error& reason, std::uint64_t bytes_needed);

/// For tests: while it lives, lists the calls above of the whole process in their order ("open", "write", "fsync",
/// "close", "rename", "open folder", "fsync folder") and makes one of them fail. One at a time.
class CallWatch {
 public:
  static constexpr std::size_t never = std::numeric_limits<std::size_t>::max();

  /// fail_at: number of the call to fail, from 0; error: its errno; write_limit: bytes that one write takes at most.
  explicit CallWatch(std::size_t fail_at = never, int error = EIO, std::size_t write_limit = never);
  ~CallWatch();
  CallWatch(const CallWatch&) = delete;
  CallWatch& operator=(const CallWatch&) = delete;

  std::vector<std::string> calls() const;

 private:
  struct State;
  friend struct WatchedCalls;
  static State& state();
};

}  // namespace spindrift
