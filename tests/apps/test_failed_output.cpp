// What a run does when its output cannot be written: exit code 5, a message with the file and the reason, and what was
// committed before stays readable (export checks the digest of every frame that it reads).

#include <catch2/catch.hpp>

#include "small_scenes.hpp"
#include "workplace.hpp"

using namespace spindrift::testing;

namespace {

const std::string program = "'" SPINDRIFT_BINARY_DIR "/spindrift'";

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

/// The number after "frames": in a run.json; -1 if there is none.
int frames_in(const fs::path& run_json) {
  const std::string text = text_of(run_json);
  const std::size_t at = text.find("\"frames\": ");
  return at == std::string::npos ? -1 : std::atoi(text.c_str() + at + 10);
}

}  // namespace

TEST_CASE("a folder that cannot be made ends the run with code 5 before it begins", "[output]") {
  const Workplace place;
  place.write("box.toml", box_scene);
  place.write("file", "precious");
  const auto folder = GENERATE(as<std::string>{}, "file", "file/run", "file/deep/run");
  const Outcome outcome = place.run("run box.toml -o " + folder);
  CHECK(outcome.code == 5);
  CHECK(outcome.err.find("cannot prepare " + folder) == 0);
  CHECK(count_of(outcome.err, "\n") == 1);
  CHECK(text_of(place.folder() / "file") == "precious");
}

TEST_CASE("a file above the limit of its size is told, not a death by signal", "[output]") {
  const Workplace place;
  place.write("box.toml", box_scene);
  // diagnostics.csv grows past 64 kB, the frames do not.
  const Outcome outcome =
      place.shell("ulimit -f 64; " + program + " run box.toml -o r --until 10 --frames-per-second 20 --quiet");
  CHECK(outcome.code == 5);
  CHECK(outcome.err.find("cannot write r/diagnostics.csv: write: File too large (needed ") == 0);
  CHECK(count_of(outcome.err, "\n") == 1);

  const std::string run = text_of(place.folder() / "r/run.json");
  CHECK(run.find("\"status\": \"failed\"") != std::string::npos);
  CHECK(run.find("\"message\": \"cannot write r/diagnostics.csv") != std::string::npos);
  const int n_frames = frames_in(place.folder() / "r/run.json");
  CHECK(n_frames > 3);
  const Outcome read = place.run("export r --to csv");
  CHECK(read.code == 0);
  CHECK(read.err.find(std::to_string(n_frames) + " frames of particles") == 0);
  CHECK(place.run("info r").code == 0);

  // The table's last row is cut off; the reader leaves it out.
  if (const std::string python = python_with("h5py, numpy"); python.empty()) {
    WARN("skipped: no python3 with h5py and numpy (packages-extra.txt)");
  } else {
    const Outcome summary = place.shell(python + " '" SPINDRIFT_SOURCE_DIR "/tools/spindrift_reader.py' r");
    CAPTURE(summary.err);
    CHECK(summary.code == 0);
    CHECK(summary.out.find("failed at ") != std::string::npos);
  }
}

TEST_CASE("a frame above the limit leaves none, and says which", "[output]") {
  const Workplace place;
  place.write("box.toml", box_scene);
  const Outcome outcome = place.shell("ulimit -f 8; " + program + " run box.toml -o r --quiet");
  CHECK(outcome.code == 5);
  CHECK(outcome.err.find("cannot write r/frames/particles_000000.hdf: write: File too large") == 0);
  CHECK(fs::is_empty(place.folder() / "r/frames"));
  CHECK(frames_in(place.folder() / "r/run.json") == 0);
  CHECK(place.run("info r --json").out.find("\"status\": \"failed\"") != std::string::npos);
}

TEST_CASE("a disk that fills up ends the run with code 5 and keeps every frame before", "[output]") {
  const Workplace place;
  place.write("box.toml", box_scene);
  place.write("full.sh",
              "set -e\nmkdir disk\nmount -t tmpfs -o size=1m none disk\ntouch mounted\nset +e\n" + program +
                  " run box.toml -o disk/r --until 4 --frames-per-second 100 --quiet\ncode=$?\ncp -r disk/r copy\n" +
                  "exit $code\n");
  const Outcome outcome = place.shell("unshare -rm bash full.sh");
  if (!fs::exists(place.folder() / "mounted")) {
    WARN("skipped: no small disk can be mounted here: " + outcome.err);
    return;
  }
  CAPTURE(outcome.err);
  CHECK(outcome.code == 5);
  CHECK(outcome.err.find("cannot write disk/r/") == 0);
  CHECK(outcome.err.find("No space left on device (needed ") != std::string::npos);
  const int n_frames = frames_in(place.folder() / "copy/run.json");
  CHECK(n_frames > 10);
  const Outcome read = place.run("export copy --to csv");
  CHECK(read.code == 0);
  CHECK(std::atoi(read.err.c_str()) >= n_frames);
  for (const auto& entry : fs::recursive_directory_iterator(place.folder() / "copy"))
    CHECK_FALSE(entry.path().filename().string().ends_with(".tmp"));
}

TEST_CASE("an export that cannot be written ends with code 5", "[output]") {
  const Workplace place;
  place.write("box.toml", box_scene);
  REQUIRE(place.run("run box.toml -o r --quiet").code == 0);
  place.write("file", "precious");
  CHECK(place.run("export r --to csv -o file").err.find("cannot make the folder file: ") == 0);
  CHECK(place.run("export r --to csv -o file/under").code == 5);
  const Outcome outcome = place.shell("ulimit -f 1; " + program + " export r --to ply");
  CHECK(outcome.code == 5);
  CHECK(outcome.err.find("cannot write r/export/particles_000000.ply: write: File too large") == 0);
  CHECK(fs::is_empty(place.folder() / "r/export"));
}
