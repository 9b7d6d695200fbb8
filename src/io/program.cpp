#include "io/program.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <system_error>

namespace spindrift {

namespace fs = std::filesystem;

namespace {

/// A file in memory for what a program says.
class Memo {
 public:
  Memo() : descriptor_(memfd_create("spindrift", MFD_CLOEXEC)) {}
  ~Memo() {
    if (descriptor_ >= 0) close(descriptor_);
  }
  Memo(const Memo&) = delete;
  Memo& operator=(const Memo&) = delete;

  int descriptor() const { return descriptor_; }
  /// The last line that is not empty, printable; never long.
  std::string last_line() const {
    char text[4096];
    const off_t end = std::max<off_t>(lseek(descriptor_, 0, SEEK_END), 0);
    const ssize_t n = pread(descriptor_, text, sizeof text, std::max<off_t>(end - 4096, 0));
    std::istringstream lines(std::string(text, static_cast<std::size_t>(std::max<ssize_t>(n, 0))));
    std::string last;
    for (std::string line; std::getline(lines, line);)
      if (line.find_first_not_of(" \t\r") != std::string::npos) last = line;
    std::erase_if(last, [](unsigned char c) { return c < ' '; });
    return last.substr(0, 300);
  }

 private:
  int descriptor_;
};

/// Returns   its status as waitpid tells it; negative: it could not be started (minus errno).
int status_of(const fs::path& program, std::vector<std::string> words, const fs::path& folder, const Memo& said) {
  words.insert(words.begin(), program.string());
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  for (const int stream : {STDOUT_FILENO, STDERR_FILENO})
    posix_spawn_file_actions_adddup2(&actions, said.descriptor(), stream);
  // What this program ignores or catches is no business of the other's.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  sigset_t defaults;
  sigemptyset(&defaults);
  for (const int signal : {SIGXFSZ, SIGPIPE, SIGINT, SIGTERM}) sigaddset(&defaults, signal);
  posix_spawnattr_setsigdefault(&attributes, &defaults);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETSIGDEF);

  pid_t child = 0;
  const int error = posix_spawn(&child, program.c_str(), &actions, &attributes, arguments.data(), environ);
  posix_spawnattr_destroy(&attributes);
  posix_spawn_file_actions_destroy(&actions);
  if (error != 0) return -error;
  int status = 0;
  while (waitpid(child, &status, 0) < 0)
    if (errno != EINTR) return -errno;
  return status;
}

std::string reason(int status, const Memo& said) {
  if (status < 0) return std::strerror(-status);
  const std::string line = said.last_line();
  if (!line.empty()) return line;
  return WIFSIGNALED(status) ? fmt::format("ended by signal {}", WTERMSIG(status))
                             : fmt::format("ended with code {}", WEXITSTATUS(status));
}

}  // namespace

std::optional<fs::path> program_on_path(const std::string& name) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "" : path);
  for (std::string folder; std::getline(folders, folder, ':');) {
    std::error_code error;
    const fs::path program = fs::absolute(fs::path(folder.empty() ? "." : folder) / name, error);
    if (!error && fs::is_regular_file(program, error) && access(program.c_str(), X_OK) == 0) return program;
  }
  return {};
}

std::optional<std::string> run_program(const fs::path& program, const std::vector<std::string>& words,
                                       const fs::path& folder) {
  const Memo said;
  const int status = status_of(program, words, folder, said);
  if (status == 0) return {};
  return reason(status, said);
}

}  // namespace spindrift
