#include "io/commit.hpp"

#include "io/system_calls.hpp"

namespace spindrift {

namespace fs = std::filesystem;

void commit(const fs::path& path, std::span<const std::byte> bytes) {
  const fs::path folder = path.has_parent_path() ? path.parent_path() : fs::path(".");
  const fs::path temporary = folder / ("." + path.filename().string() + ".tmp");
  try {
    OutputFile file(temporary);
    file.write(bytes);
    file.sync();
    file.close();
    rename_file(temporary, path);
    sync_folder(folder);
  } catch (const std::system_error& reason) {
    const Error error = write_error(path, reason, bytes.size());
    std::error_code ignored;
    fs::remove(temporary, ignored);
    throw error;
  }
}

void commit(const fs::path& path, std::string_view text) {
  commit(path, std::as_bytes(std::span(text)));
}

void make_folder(const fs::path& folder) {
  std::error_code error;
  fs::create_directories(folder, error);
  if (error || !fs::is_directory(folder, error))
    throw Error(ExitCode::io_failed, "cannot make the folder " + folder.string() + ": " +
                                         (error ? error.message() : "there is a file of this name"));
}

std::size_t remove_stale_temporaries(const fs::path& folder) {
  std::size_t n = 0;
  try {
    if (!fs::exists(folder)) return 0;
    for (const fs::directory_entry& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with('.') && name.ends_with(".tmp") && entry.symlink_status().type() == fs::file_type::regular)
        n += fs::remove(entry.path()) ? 1 : 0;
    }
  } catch (const fs::filesystem_error& reason) {
    throw Error(ExitCode::io_failed, std::string("cannot clean up: ") + reason.what());
  }
  return n;
}

}  // namespace spindrift
