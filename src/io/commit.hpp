#pragma once
/// Files that appear on disk whole or not at all.

#include <cstddef>
#include <filesystem>
#include <span>
#include <string_view>

namespace spindrift {

/// Writes `bytes` as the file `path`, replacing what stood there: a hidden neighbour `.name.tmp` is written, fsync'ed
/// and renamed, then the folder is fsync'ed. After the return the file survives a kill and a power loss; before it the
/// old file, if any, stands untouched.
/// Throws Error(io_failed) naming path, failed call, bytes needed and bytes free. The temporary is then removed.
void commit(const std::filesystem::path& path, std::span<const std::byte> bytes);
void commit(const std::filesystem::path& path, std::string_view text);

/// Makes a folder and those above it, where they are missing.   Throws Error(io_failed).
void make_folder(const std::filesystem::path& folder);

/// Removes the temporaries that a killed run left in `folder`; returns how many. A folder that does not exist has none.
/// Throws Error(io_failed).   Pre: no other process writes to the folder.
std::size_t remove_stale_temporaries(const std::filesystem::path& folder);

}  // namespace spindrift
