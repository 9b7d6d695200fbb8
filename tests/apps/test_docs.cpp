// Every command, Python piece and scene of the README and the docs does what the page says: it runs.

#include <algorithm>
#include <catch2/catch.hpp>
#include <sstream>
#include <vector>

#include "workplace.hpp"

using namespace spindrift::testing;

namespace {

const fs::path root = SPINDRIFT_SOURCE_DIR;

/// README first, since later pages use its runs.
std::vector<fs::path> pages() {
  std::vector<fs::path> docs;
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") docs.push_back(entry.path());
  std::sort(docs.begin(), docs.end());
  docs.insert(docs.begin(), {root / "README.md", root / "CONTRIBUTING.md"});
  return docs;
}

/// What stands between ```language and ```.
std::vector<std::string> blocks(const fs::path& page, const std::string& language) {
  std::istringstream text(text_of(page));
  std::vector<std::string> found;
  bool inside = false;
  for (std::string line; std::getline(text, line);) {
    if (inside && line == "```") {
      inside = false;
    } else if (inside) {
      found.back() += line + "\n";
    } else if (line == "```" + language) {
      inside = true;
      found.emplace_back();
    }
  }
  return found;
}

/// A folder that looks like a clone after ./dev build.
void furnish(const Workplace& place) {
  for (const char* part : {"configs", "docs", "tools", "studies", "README.md"})
    if (fs::exists(root / part)) fs::create_symlink(root / part, place.folder() / part);
  fs::create_directories(place.folder() / "build");
  fs::create_directory_symlink(SPINDRIFT_BINARY_DIR, place.folder() / "build/release");
}

/// Why a command is not run here; empty: it is. What installs, builds, tests or needs a screen has no place in a test.
std::string reason_to_skip(const std::string& line, const std::string& python) {
  const std::string program = line.substr(0, line.find(' '));
  if (line.starts_with("./dev run ")) return "";
  for (const char* other : {"./dev", "cmake", "ctest", "git", "cd", "bash"})
    if (program == other) return "it installs, builds or tests";
  for (const char* other : {"pvpython", "blender"})
    if (program == other) return "it wants a screen or a large program";
  if (program == "python3" && python.empty()) return "no python3 with numpy, h5py and matplotlib";
  if (program == "ffmpeg" && std::system("command -v ffmpeg >/dev/null") != 0) return "no ffmpeg";
  return "";
}

/// The command as it runs here: the built program in place of ./dev, the Python that has the packages; of studies,
/// which take hours, their help, and of loops over scenes the first half second of each.
std::string runnable(std::string line, const std::string& python) {
  const auto replace = [&line](const std::string& from, const std::string& to) {
    if (line.starts_with(from)) line.replace(0, from.size(), to);
  };
  const bool study = line.find("studies/") != std::string::npos;
  replace("./dev run ", "build/release/spindrift run ");
  replace("python3 ", "'" + python + "' ");
  if (line.starts_with("for ")) line.replace(line.rfind("; done"), 0, " --until 0.5");
  return study ? line.substr(0, line.find('#')) + " --help" : line;
}

}  // namespace

TEST_CASE("every command and every piece of Python in the docs runs", "[docs][slow]") {
  const Workplace place;
  furnish(place);
  const std::string python = python_with("numpy, h5py, matplotlib");
  int n_run = 0;
  for (const fs::path& page : pages()) {
    for (const std::string& block : blocks(page, "sh")) {
      std::istringstream lines(block);
      for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line.starts_with('#')) continue;
        if (const std::string reason = reason_to_skip(line, python); !reason.empty()) {
          WARN("not run: " << line << " (" << reason << ")");
          continue;
        }
        const Outcome outcome = place.shell(runnable(line, python));
        CAPTURE(page.filename().string(), line, outcome.err);
        CHECK(outcome.code == 0);
        ++n_run;
      }
    }
    for (const std::string& block : blocks(page, "python")) {
      if (python.empty()) continue;
      place.write("piece.py", block);
      const Outcome outcome = place.shell("'" + python + "' piece.py");
      CAPTURE(page.filename().string(), block, outcome.err);
      CHECK(outcome.code == 0);
      ++n_run;
    }
  }
  CHECK(n_run >= 15);
}

TEST_CASE("every scene in the docs is one, without a warning", "[docs]") {
  const Workplace place;
  int n_scenes = 0;
  for (const fs::path& page : pages())
    for (const std::string& block : blocks(page, "toml")) {
      if (block.find("schema_version") == std::string::npos) continue;
      place.write("scene.toml", block);
      const Outcome outcome = place.run("check scene.toml");
      CAPTURE(page.filename().string(), block);
      CHECK(outcome.code == 0);
      CHECK(outcome.err == "");
      ++n_scenes;
    }
  CHECK(n_scenes >= 2);
}
