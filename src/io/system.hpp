#pragma once
/// What the machine has, and what this process took of it.

#include <cstdint>
#include <filesystem>

namespace spindrift {

/// The most memory this process held at once [bytes]; 0 where the system does not say.
std::uint64_t peak_memory_bytes();

/// Memory that a new process could take [bytes]: the smaller of the machine's and the control group's; 0: unknown.
std::uint64_t available_memory_bytes();

/// Disk space free for an unprivileged user where `path` lies or will lie [bytes]; 0: unknown.
std::uint64_t free_disk_bytes(const std::filesystem::path& path);

}  // namespace spindrift
