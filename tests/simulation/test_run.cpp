#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "io/vtkhdf.hpp"
#include "simulation/run.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;
namespace fs = std::filesystem;

namespace {

/// A folder that goes with the test.
struct Folder {
  fs::path path = fs::temp_directory_path() / ("spindrift_test_run_" + std::to_string(::getpid()));
  Folder() { fs::remove_all(path); }
  ~Folder() { fs::remove_all(path); }
};

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

nlohmann::json run_json(const fs::path& folder) {
  return nlohmann::json::parse(text_of(folder / "run.json"));
}

RunOptions into(const fs::path& folder) {
  RunOptions options;
  options.folder = folder;
  return options;
}

std::size_t count_files(const fs::path& folder) {
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

}  // namespace

TEST_CASE("A run leaves its folder: frames, pictures, diagnostics, summary", "[run]") {
  const Folder folder;
  REQUIRE(run_scene(scene_of(small_avalanche, {"scene.end_time=0.5"}), into(folder.path)) == ExitCode::done);
  const auto run = run_json(folder.path);
  CHECK(run["status"] == "done");
  CHECK(std::abs(run["mass"]["error_relative"].get<double>()) < 1e-12);
  for (const char* key : {"scene",
                          "dim",
                          "seed",
                          "version",
                          "time",
                          "steps",
                          "n_dense_initial",
                          "n_dense",
                          "n_entrained",
                          "n_cover",
                          "grid_cells",
                          "active_cells",
                          "mass",
                          "smoke_generated",
                          "smoke_adhered",
                          "front_x",
                          "front_speed_max",
                          "cloud_height_max",
                          "dt_min",
                          "dt_mean",
                          "dt_limiters",
                          "wall_seconds",
                          "ms_per_step",
                          "stages",
                          "threads",
                          "peak_memory_bytes",
                          "digest"})
    CHECK(run.contains(key));
  CHECK(count_files(folder.path / "frames") == 6);  // t = 0, 0.2, 0.4: particles and smoke
  CHECK(count_files(folder.path / "preview") == 3);

  std::istringstream table(text_of(folder.path / "diagnostics.csv"));
  std::string header, row;
  std::getline(table, header);
  CHECK(header.ends_with(",limiter"));
  std::size_t rows = 0;
  while (std::getline(table, row)) {
    ++rows;
    CHECK(std::count(row.begin(), row.end(), ',') == std::count(header.begin(), header.end(), ','));
    CHECK(std::isalpha(static_cast<unsigned char>(row.back())) != 0);
  }
  CHECK(rows == run["steps"]);

  const std::string bytes = text_of(folder.path / "frames" / "particles_000002.hdf");
  const StoredFrame frame = read_vtkhdf(std::as_bytes(std::span(bytes)), "particles_000002.hdf");
  CHECK(frame.arrays.size() >= 9);
  const Scene again = read_scene(folder.path / "scene.toml");
  CHECK(again.terrain->angle == scene_of(small_avalanche).terrain->angle);
}

TEST_CASE("The final state does not depend on frames", "[run]") {
  std::vector<std::string> digests;
  for (const char* rate : {"0", "3", "200"}) {
    const Folder folder;
    run_scene(scene_of(small_avalanche, {"scene.end_time=0.3", std::string("output.frames_per_second=") + rate}),
              into(folder.path));
    digests.push_back(run_json(folder.path)["digest"]);
  }
  CHECK(digests[0] == digests[1]);
  CHECK(digests[0] == digests[2]);
}

TEST_CASE("A run that fails at every step length ends with code 3, its last frame the last good state", "[run]") {
  const Folder folder;
  try {
    run_scene(scene_of(runaway), into(folder.path));
    FAIL("not noticed");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::unstable);
    CHECK_THAT(error.what(), Catch::Contains("runaway") && Catch::Contains("6 halvings"));
  }
  const auto run = run_json(folder.path);
  CHECK(run["status"] == "unstable");
  CHECK_THAT(run["message"].get<std::string>(), Catch::Contains("6 halvings"));
  CHECK_THAT(run["message"].get<std::string>(), Catch::Contains("particle"));
  CHECK(run["halvings"] == 6);
  CHECK(run["steps_rejected"] >= 7);
  CHECK(run["dt_limiters"]["rejection"] > 0);
  const std::size_t n = run["frames"];
  CHECK(n >= 3);
  for (std::size_t i = 0; i < n; ++i) {
    const std::string name = fmt::format("particles_{:06}.hdf", i), bytes = text_of(folder.path / "frames" / name);
    const StoredFrame frame = read_vtkhdf(std::as_bytes(std::span(bytes)), name);
    for (const auto& [key, value] : frame.attributes)
      if (key == "step" && i + 1 == n) CHECK(std::get<std::int64_t>(value) == run["steps"]);
  }
  std::istringstream table(text_of(folder.path / "diagnostics.csv"));
  std::size_t rows = 0;
  for (std::string row; std::getline(table, row);) ++rows;
  CHECK(rows == 1 + run["steps"].get<std::size_t>());
}

TEST_CASE("A folder that cannot be written gives code 5", "[run]") {
  const Folder folder;
  std::ofstream(folder.path) << "a file, not a folder";
  try {
    run_scene(scene_of(small_avalanche), into(folder.path / "run"));
    FAIL("not noticed");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::io_failed);
    CHECK_THAT(error.what(), Catch::Contains(folder.path.string()));
  }
}

TEST_CASE("A stop is heard after the step", "[run]") {
  const Folder folder;
  std::atomic<bool> stop{false};
  RunOptions options = into(folder.path);
  options.stop = &stop;
  options.on_progress = [&](const Progress& progress) { stop = progress.step == 3; };
  CHECK(run_scene(scene_of(small_avalanche), options) == ExitCode::resumable);
  CHECK(run_json(folder.path)["status"] == "stopped");
  CHECK(run_json(folder.path)["steps"] == 3);
}
