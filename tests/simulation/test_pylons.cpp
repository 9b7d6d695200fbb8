// Pylons, and how far an avalanche ran.

#include <catch2/catch.hpp>
#include <cmath>
#include <fstream>
#include <string>

#include "io/temporary_folder.hpp"
#include "scene_support.hpp"
#include "simulation/instruments.hpp"
#include "simulation/pylons.hpp"
#include "simulation/run.hpp"
#include "simulation/scene_warnings.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

/// Snow without weight that fills the lower left of a box and moves at (6, 8) m/s; nothing else acts on it.
std::string moving_block(int dim) {
  const std::string y = dim == 3 ? " 0," : "", far = dim == 3 ? " 2," : "";
  return "schema_version = 1\n[scene]\nname = \"block\"\nend_time = 0.3\ndim = " + std::to_string(dim) +
         "\n[domain]\nlower = [0," + y + " 0]\nupper = [9," + far + " 9]\ngravity = [0," + y +
         " 0]\n[dense_flow]\nsupport_radius = 0.4\nfriction_acts_on = \"none\"\n[release]\nshape = \"box\"\nlower = "
         "[0," +
         y + " 0]\nupper = [3," + far + " 3]\nvelocity = [6," + y + " 8]\n";
}

template <int Dim>
void check_block() {
  const std::string y = Dim == 3 ? ", 1" : "";
  Simulation<Dim> simulation(scene_of(moving_block(Dim) + "[[pylon]]\nposition = [1.5" + y +
                                      "]\nheight = 1.5\n[[pylon]]\nname = \"mast\"\nposition = [1.5" + y +
                                      "]\nheight = 0\n[[pylon]]\nposition = [7" + y + "]\n"));
  Pylons<Dim> pylons(simulation);
  CHECK(pylons.headings() == std::vector<std::string>{"time_s", "pylon1_flow_density_kg_m3", "pylon1_flow_speed_m_s",
                                                      "pylon1_flow_pressure_kPa", "mast_flow_density_kg_m3",
                                                      "mast_flow_speed_m_s", "mast_flow_pressure_kPa",
                                                      "pylon3_flow_density_kg_m3", "pylon3_flow_speed_m_s",
                                                      "pylon3_flow_pressure_kPa"});
  const std::vector<double> row = *pylons.follow(simulation);
  CHECK(row[0] == 0);
  CHECK(row[1] == Approx(300).epsilon(0.02));
  CHECK(row[2] == Approx(10));
  CHECK(row[3] == Approx(30).epsilon(0.02));
  CHECK(row[4] == Approx(300).epsilon(0.05));  // half of the kernel lies in the ground
  CHECK(row[5] == Approx(10));
  for (const std::size_t k : {7, 8, 9}) CHECK(row[k] == 0);
  CHECK(pylons.follow(simulation) == nullptr);
}

}  // namespace

TEST_CASE("A pylon feels the snow around it: density, speed, rho v^2, by hand", "[pylons]") {
  check_block<2>();
  check_block<3>();
}

TEST_CASE("A pylon feels the cloud around it: smoke, speed, (rho_air + rho_smoke) u^2, by hand", "[pylons]") {
  const Simulation<2> simulation(scene_of(
      "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [20, 12]\n[terrain]\nshape = \"polyline\"\n"
      "points = [[0, 6], [20, 2]]\n[suspension]\ncell_size = 0.5\nwind = [10, 0]\nfrozen = true\n"
      "[smoke]\ndensity = 3\nlower = [0, 0]\nupper = [10, 12]\n"
      "[[pylon]]\nposition = [5]\nheight = 4\n[[pylon]]\nposition = [5]\nheight = 0.1\n[[pylon]]\nposition = [15]\n"));
  CHECK(pylon_place<2>(simulation.scene().pylon[0], simulation.walls())[1] == Approx(9));
  Pylons<2> pylons(simulation);
  const std::vector<double> row = *pylons.follow(simulation);
  REQUIRE(row.size() == 10);
  CHECK(row[1] == Approx(3));
  CHECK(row[2] == Approx(10));
  CHECK(row[3] == Approx(0.42));
  CHECK(row[4] == Approx(3));  // the smoke of open cells alone
  CHECK(row[7] == 0);
  CHECK(row[9] == Approx(0.12));
}

TEST_CASE("A run with pylons leaves a row every 0.05 s, one without no table", "[pylons][run]") {
  const TemporaryFolder folder;
  RunOptions options;
  options.folder = folder.path() / "with";
  const std::string block = moving_block(2) + "[output]\npreview = false\n";
  run_scene(scene_of(block + "[pylon]\nposition = [3]\n"), options);
  std::ifstream table(options.folder / "pylons.csv");
  std::string line;
  std::vector<double> times;
  std::getline(table, line);
  CHECK(line == "time_s,pylon1_flow_density_kg_m3,pylon1_flow_speed_m_s,pylon1_flow_pressure_kPa");
  while (std::getline(table, line)) times.push_back(std::stod(line));
  REQUIRE(times.size() == 7);
  for (std::size_t k = 0; k < times.size(); ++k) {
    CHECK(times[k] >= Pylons<2>::interval * static_cast<double>(k) - 1e-12);
    CHECK(times[k] < Pylons<2>::interval * static_cast<double>(k) + 0.011);
  }
  options.folder = folder.path() / "without";
  run_scene(scene_of(block), options);
  CHECK(!std::filesystem::exists(options.folder / "pylons.csv"));
}

TEST_CASE("Pylons stand inside the domain and have names of their own", "[pylons]") {
  const std::string block = moving_block(2);
  CHECK(refusal(block + "[pylon]\n").find("pylon.position: missing, expected [x]") != std::string::npos);
  CHECK(refusal(block + "[pylon]\nposition = [1, 2]\n").find("expected a list of 1, each a length") !=
        std::string::npos);
  CHECK(refusal(block + "[pylon]\nposition = [11]\n").find("pylon.position: reaches 11 along x") != std::string::npos);
  CHECK(refusal(block + "[[pylon]]\nposition = [1]\nname = \"a\"\n[[pylon]]\nposition = [2]\nname = \"a\"\n")
            .find("pylon[1].name: got \"a\", as pylon[0] is called") != std::string::npos);
  CHECK(refusal(block + "[pylon]\nposition = [1]\nname = \"a,b\"\n").find("pylon.name: got \"a,b\"") !=
        std::string::npos);
  const Scene high = scene_of(block + "[pylon]\nposition = [1]\nheight = 30\n");
  CHECK(scene_warnings(high, {}).back().find("pylon: stands out of the domain's top") != std::string::npos);
}

TEST_CASE("Run-out, drop and energy line of snow that moved by a known way", "[instruments]") {
  // One particle at (1.1, 5.1), and fifty below it, of which the farthest five are at x = 3.9, z = 3.1 to 3.9.
  const std::string one = "[[release]]\nshape = \"box\"\nlower = [1, 5]\nupper = [1.2, 5.2]\nvelocity = [10, -4]\n";
  Simulation<2> simulation(
      scene_of(without(moving_block(2), {"release"}) + one +
               "[[release]]\nshape = \"box\"\nlower = [2, 3]\nupper = [4, 4]\nvelocity = [10, -4]\n"));
  REQUIRE(simulation.dense()->particles.size() == 51);
  Instruments<2> instruments;
  CHECK(instruments.run_out(simulation).distance == 0);
  instruments.follow(simulation);
  while (simulation.time() < 0.2) simulation.step();
  const double t = simulation.time();
  const RunOut run_out = instruments.run_out(simulation);
  CHECK(run_out.distance == Approx(2.8 + 10 * t).epsilon(1e-3));
  CHECK(run_out.drop > 1.2 + 4 * t - 1e-9);
  CHECK(run_out.drop < 2.0 + 4 * t + 1e-9);
  CHECK(run_out.angle == Approx(std::atan2(run_out.drop, run_out.distance)));
}
