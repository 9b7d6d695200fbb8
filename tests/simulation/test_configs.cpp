// Every scene of configs/ reads and runs some steps with a closed ledger.

#include <catch2/catch.hpp>
#include <filesystem>

#include "simulation/scene_reader.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;
namespace fs = std::filesystem;

namespace {

std::vector<fs::path> all_scenes() {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::recursive_directory_iterator(fs::path(SPINDRIFT_SOURCE_DIR) / "configs"))
    if (entry.path().extension() == ".toml" && entry.path().parent_path().filename() != "real")
      scenes.push_back(entry.path());  // those of configs/real need terrain: test_maps.cpp
  std::sort(scenes.begin(), scenes.end());
  return scenes;
}

template <int Dim>
void run_some_steps(const Scene& scene) {
  Simulation<Dim> simulation(scene);
  for (int i = 0; i < 5; ++i) simulation.step();
  CHECK(std::abs(simulation.mass_error()) < 1e-12);
}

}  // namespace

TEST_CASE("All scenes of configs/ run", "[configs][slow]") {
  const std::vector<fs::path> scenes = all_scenes();
  REQUIRE(scenes.size() >= 10);
  for (const fs::path& path : scenes) {
    CAPTURE(path.string());
    const Scene scene = read_scene(path);
    scene.scene.dim == 3 ? run_some_steps<3>(scene) : run_some_steps<2>(scene);
  }
}

TEST_CASE("The paper's scenes keep the paper's numbers", "[configs]") {
  for (const fs::path& path : all_scenes()) {
    if (path.parent_path().filename() != "paper") continue;
    CAPTURE(path.string());
    const Scene scene = read_scene(path);
    CHECK(scene.dense_flow->support_radius == 0.21);
    if (scene.scene.dim == 3) {
      const Simulation<3> simulation(scene);
      CHECK(static_cast<double>(simulation.dense()->particles.size()) == Approx(10000).epsilon(0.01));
      CHECK(make_grid<3>(scene, simulation.walls()).cells == Index<3>{170, 30, 40});
      CHECK(simulation.suspension()->grid().dx == 1);
      continue;
    }
    const Simulation<2> simulation(scene);
    CHECK(simulation.dense()->particles.size() == 1000);
    CHECK(simulation.suspension()->grid().cells == Index<2>{690, 240});
    CHECK(simulation.suspension()->grid().dx == 0.33);
  }
}
