#include "io/system.hpp"

#include <sys/statvfs.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>

namespace spindrift {

namespace fs = std::filesystem;

namespace {

/// The number after `key` in a file of lines such as "VmHWM:   1234 kB" [bytes]; 0: not there.
std::uint64_t kilobyte_entry(const char* file, const std::string& key) {
  std::ifstream in(file);
  std::string word;
  while (in >> word) {
    std::uint64_t kilobytes = 0;
    if (word == key && in >> kilobytes) return kilobytes * 1024;
    in.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
  }
  return 0;
}

/// A file that holds one number or the word "max", which reads as `otherwise`.
std::uint64_t single_number(const char* file, std::uint64_t otherwise) {
  std::ifstream in(file);
  std::uint64_t number = 0;
  return in >> number ? number : otherwise;
}

}  // namespace

std::uint64_t peak_memory_bytes() {
  return kilobyte_entry("/proc/self/status", "VmHWM:");
}

std::uint64_t available_memory_bytes() {
  constexpr std::uint64_t no_limit = std::numeric_limits<std::uint64_t>::max();
  const std::uint64_t machine = kilobyte_entry("/proc/meminfo", "MemAvailable:");
  const std::uint64_t limit = single_number("/sys/fs/cgroup/memory.max", no_limit);
  const std::uint64_t used = single_number("/sys/fs/cgroup/memory.current", 0);
  return limit == no_limit ? machine : std::min(machine, limit - std::min(limit, used));
}

std::uint64_t free_disk_bytes(const fs::path& path) {
  std::error_code error;
  fs::path place = fs::absolute(path, error);
  for (; !error; place = place.parent_path()) {
    struct statvfs disk;
    if (::statvfs(place.c_str(), &disk) == 0) return std::uint64_t{disk.f_bavail} * disk.f_frsize;
    if (place == place.parent_path()) break;
  }
  return 0;
}

}  // namespace spindrift
