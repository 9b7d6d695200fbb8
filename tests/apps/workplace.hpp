#pragma once

#include <sys/wait.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace spindrift::testing {

namespace fs = std::filesystem;

struct Outcome {
  int code = -1;
  std::string out, err;
};

inline std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

/// An empty folder in which the program runs, gone at the end.
class Workplace {
 public:
  Workplace() {
    std::string pattern = (fs::temp_directory_path() / "spindrift_XXXXXX").string();
    folder_ = mkdtemp(pattern.data());
  }
  ~Workplace() { fs::remove_all(folder_); }
  Workplace(const Workplace&) = delete;
  Workplace& operator=(const Workplace&) = delete;

  void write(const std::string& name, const std::string& text) const { std::ofstream(folder_ / name) << text; }

  /// Runs the program with words for a shell, in the folder.
  Outcome run(const std::string& words, const std::string& environment = "") const {
    const fs::path out = folder_ / "stdout", err = folder_ / "stderr";
    const std::string line = "cd '" + folder_.string() + "' && " + environment +
                             " '" SPINDRIFT_BINARY_DIR "/spindrift' " + words + " >'" + out.string() + "' 2>'" +
                             err.string() + "'";
    const int status = std::system(line.c_str());
    const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(out), text_of(err)};
    fs::remove(out);
    fs::remove(err);
    return outcome;
  }

  /// Runs a line of a shell in the folder.
  Outcome shell(const std::string& line) const {
    write("line.sh", line);
    const int status = std::system(("cd '" + folder_.string() + "' && bash line.sh >stdout 2>stderr").c_str());
    const Outcome outcome{WIFEXITED(status) ? WEXITSTATUS(status) : -1, text_of(folder_ / "stdout"),
                          text_of(folder_ / "stderr")};
    for (const char* name : {"line.sh", "stdout", "stderr"}) fs::remove(folder_ / name);
    return outcome;
  }

  std::size_t n_entries() const { return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder_), {})); }
  const fs::path& folder() const { return folder_; }

 private:
  fs::path folder_;
};

/// A Python that has these modules, or nothing. The first python3 on PATH need not be the system's.
inline std::string python_with(const std::string& modules) {
  for (const std::string name : {"python3", "/usr/bin/python3"})
    if (std::system((name + " -c 'import " + modules + "' >/dev/null 2>&1").c_str()) == 0) return name;
  return "";
}

}  // namespace spindrift::testing
