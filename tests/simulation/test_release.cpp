#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "simulation/release.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/setup.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

namespace {

const std::string box_2d = "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [20, 10]\n";
const std::string snow_2d = box_2d + "[dense_flow]\nsupport_radius = 0.2\n";

ReleasedSnow<2> snow_of(const std::string& text) {
  const Scene scene = parse_scene(text, "a.toml");
  return released_snow<2>(scene, make_walls<2>(scene));
}

}  // namespace

TEST_CASE("Every shape of release holds its volume of snow", "[release]") {
  const auto count = [](const std::string& shape) { return snow_of(snow_2d + "[release]\n" + shape).particles.size(); };
  const double a_square_metre = 100;
  CHECK(count("shape = \"box\"\nlower = [1, 1]\nupper = [3, 2]\n") == 200);
  CHECK(static_cast<double>(count("shape = \"ball\"\ncenter = [5, 5]\nradius = 2\n")) ==
        Approx(4 * std::numbers::pi * a_square_metre).epsilon(0.01));
  CHECK(static_cast<double>(count("shape = \"polygon\"\npoints = [[1, 1], [9, 1], [9, 5]]\n")) ==
        Approx(16 * a_square_metre).epsilon(0.02));
  const std::string ground = "[terrain]\nstart = [0, 8]\ndrop = 6\nangle = 0.5\n";
  CHECK(snow_of(snow_2d + ground + "[release]\nlength = 3\nlayers = 4\n").particles.size() == 30 * 4);
}

TEST_CASE("The support radius over support_ratio is the spacing of all particles", "[release]") {
  const std::string snow = box_2d +
                           "[terrain]\nstart = [0, 8]\ndrop = 6\nangle = 0.5\n[cover]\n[release]\nlayers = 4\n" +
                           "[dense_flow]\nsupport_radius = 0.3\nsupport_ratio = 3\nkernel = \"wendland\"\n";
  const Scene scene = parse_scene(snow, "a.toml");
  CHECK(scene.dense_flow->spacing() == Approx(0.1));
  CHECK(scene.release[0].thickness == Approx(0.4));
  const Walls<2> walls = make_walls<2>(scene);
  const auto dense = make_dense_flow<2>(scene, walls);
  CHECK(dense->options().spacing == scene.dense_flow->spacing());
  CHECK(dense->options().kernel == KernelShape::wendland);
  CHECK(dense->particles.volume[0] == Approx(0.01));
  const auto cover = make_cover<2>(scene, walls, 0);
  CHECK(cover->spacing == scene.dense_flow->spacing());
  CHECK(cover->support_radius == 0.3);
}

TEST_CASE("A ball of snow in 3D holds its volume", "[release]") {
  const Scene scene = parse_scene(
      "schema_version = 1\n[scene]\ndim = 3\n[domain]\nlower = [0, 0, 0]\nupper = [4, 4, 4]\n"
      "[dense_flow]\nsupport_radius = 0.2\n[release]\nshape = \"ball\"\ncenter = [2, 2, 2]\nradius = 1\n",
      "a.toml");
  CHECK(static_cast<double>(released_snow<3>(scene, make_walls<3>(scene)).particles.size()) ==
        Approx(1000 * 4 * std::numbers::pi / 3).epsilon(0.02));
}

TEST_CASE("Several releases keep their densities and velocities, and never lie in each other", "[release]") {
  const ReleasedSnow<2> snow = snow_of(snow_2d +
                                       "[[release]]\nshape = \"box\"\nlower = [1, 1]\nupper = [2, 2]\ndensity = 150\n"
                                       "velocity = [3, 0]\n"
                                       "[[release]]\nshape = \"box\"\nlower = [1.5, 1]\nupper = [2.5, 2]\n");
  REQUIRE(snow.releases.size() == 2);
  CHECK(snow.releases[0].placed == 100);
  CHECK(snow.releases[1].placed == 50);
  CHECK(snow.releases[1].doubled == 50);
  CHECK(snow.particles.mass[0] == Approx(1.5));
  CHECK(snow.particles.velocity[0] == Vec<2>(3, 0));
  CHECK(snow.particles.mass[149] == Approx(3.0));
  CHECK(snow.particles.velocity[149] == Vec<2>(0, 0));
  for (std::size_t i = 0; i < snow.particles.size(); ++i) CHECK(snow.particles.id[i] == i);
}

TEST_CASE("Snow is left out of ground, cover, obstacles and closed sides", "[release]") {
  const std::string ground = "[terrain]\nshape = \"polyline\"\npoints = [[0, 2], [20, 2]]\n";
  const std::string box = "[release]\nshape = \"box\"\nlower = [4, 1]\nupper = [6, 4]\n";
  CHECK(snow_of(snow_2d + box).releases[0].buried == 0);
  CHECK(snow_of(snow_2d + ground + box).releases[0].buried == 200);
  CHECK(snow_of(snow_2d + ground + "[cover]\ndepth = 0.5\n" + box).releases[0].buried == 300);
  CHECK(snow_of(snow_2d + ground + "[cover]\ndepth = 0.5\nto = 3\n" + box).releases[0].buried == 200);
  CHECK(snow_of(snow_2d + ground + "[obstacle]\nlower = [5, 0]\nupper = [7, 5]\n" + box).releases[0].buried == 400);
}

TEST_CASE("A slab lies on the cover where there is one, else on the ground", "[release]") {
  const std::string text = snow_2d +
                           "[terrain]\nshape = \"polyline\"\npoints = [[0, 2], [20, 2]]\n[release]\nat = 5\n"
                           "length = 2\nthickness = 1\n[cover]\ndepth = 0.5\n";
  const auto lowest = [](const ReleasedSnow<2>& snow) {
    double z = 1e9;
    for (const Vec<2>& x : snow.particles.position) z = std::min(z, x[1]);
    return z;
  };
  CHECK(lowest(snow_of(text)) == Approx(2.55));
  CHECK(lowest(snow_of(text + "to = 4\n")) == Approx(2.05));
  CHECK(lowest(snow_of(text + "from = 8\n")) == Approx(2.05));
  CHECK(lowest(snow_of(text + "from = 6\n")) == Approx(2.55));
  CHECK(snow_of(text + "from = 6\n").releases[0].buried == 0);
}

TEST_CASE("Shear and rotation start as they say", "[release]") {
  const ReleasedSnow<2> snow = snow_of(snow_2d +
                                       "[release]\nshape = \"box\"\nlower = [1, 1]\nupper = [3, 2]\nvelocity = [1, 2]\n"
                                       "shear = 4\nrotation = 0.5\n");
  for (std::size_t i = 0; i < snow.particles.size(); ++i) {
    const Vec<2>& x = snow.particles.position[i];
    CHECK(snow.particles.velocity[i][0] == Approx(1 + 4 * (x[1] - 1.05) - 0.5 * (x[1] - 1.5)));
    CHECK(snow.particles.velocity[i][1] == Approx(2 + 0.5 * (x[0] - 2)));
  }
}

TEST_CASE("Smoke fills boxes exactly and balls nearly, whatever the cells", "[release]") {
  const std::string air = box_2d + "[suspension]\ncell_size = 0.3\n";
  const Simulation<2> box(parse_scene(air + "[smoke]\nlower = [1.05, 1]\nupper = [4.4, 2.5]\ndensity = 2\n", "a.toml"));
  CHECK(box.smoke_mass() == Approx(2 * 3.35 * 1.5).epsilon(1e-12));
  CHECK(box.masses().initial == box.smoke_mass());
  const Simulation<2> ball(
      parse_scene(air + "[smoke]\nshape = \"ball\"\ncenter = [5, 5]\nradius = 2\ndensity = 3\n", "a.toml"));
  CHECK(ball.smoke_mass() == Approx(3 * std::numbers::pi * 4).epsilon(0.01));
}

TEST_CASE("Smoke fills polygons nearly, as it fills boxes and the snow's polygons", "[release]") {
  const auto cell = GENERATE(0.3, 0.075);
  const std::string air = box_2d + "[suspension]\ncell_size = " + std::to_string(cell) + "\n";
  const auto mass = [&](const std::string& points) {
    return Simulation<2>(
               parse_scene(air + "[smoke]\nshape = \"polygon\"\ndensity = 2\npoints = " + points + "\n", "a.toml"))
        .smoke_mass();
  };
  const double error = 0.3 * cell * cell;  // corners are cut within a cell
  CHECK(mass("[[1, 1], [9, 1], [9, 5]]") == Approx(2 * 16).epsilon(error));
  CHECK(mass("[[1, 1], [5, 1], [5, 5], [3, 2], [1, 5]]") == Approx(2 * 10).epsilon(error));  // a notch
  CHECK(mass("[[1, 1], [5, 1], [1, 5], [5, 5]]") == Approx(2 * 8).epsilon(error));           // an hourglass
  // On the lines of the grid.
  const std::string box = "lower = [1.2, 1.5]\nupper = [4.5, 3]\n";
  const Scene boxed = parse_scene(air + "[smoke]\ndensity = 2\n" + box, "a.toml");
  const Scene drawn = parse_scene(
      air + "[smoke]\nshape = \"polygon\"\ndensity = 2\n" + "points = [[1.2, 1.5], [4.5, 1.5], [4.5, 3], [1.2, 3]]\n",
      "a.toml");
  const Simulation<2> a(boxed), b(drawn);
  for (std::size_t i = 0; i < a.suspension()->smoke_mass().size(); ++i)
    REQUIRE(b.suspension()->smoke_mass()[i] == Approx(a.suspension()->smoke_mass()[i]).margin(1e-9));
}

TEST_CASE("A polygon of smoke in 3D goes over the whole breadth", "[release]") {
  const Scene scene = parse_scene(
      "schema_version = 1\n[scene]\ndim = 3\n[domain]\nlower = [0, 0, 0]\nupper = [4, 2, 4]\n[suspension]\n"
      "cell_size = 0.25\n[smoke]\nshape = \"polygon\"\ndensity = 3\npoints = [[1, 1], [3, 1], [1, 3]]\n",
      "a.toml");
  CHECK(Simulation<3>(scene).smoke_mass() == Approx(3 * 2 * 2).epsilon(0.04));
}

TEST_CASE("Obstacles stop snow and air", "[release]") {
  Simulation<2> simulation(parse_scene(
      box_2d + "left = \"closed\"\nright = \"closed\"\n[dense_flow]\nsupport_radius = 0.2\n"
               "[release]\nshape = \"box\"\nlower = [1, 0]\nupper = [3, 2]\nvelocity = [12, 0]\n"
               "[obstacle]\nlower = [5, 0]\nupper = [7, 10]\n[suspension]\ncell_size = 0.25\n[coupling.drag]\n"
               "[coupling.generation]\nconstant = 0.2\nthreshold_speed = 0\n",
      "a.toml"));
  for (int i = 0; i < 300; ++i) simulation.step();
  double farthest = 0;
  for (const Vec<2>& x : simulation.dense()->particles.position) farthest = std::max(farthest, x[0]);
  CHECK(farthest <= 5.0);
  CHECK(farthest > 4.8);
  const Suspension<2>& air = *simulation.suspension();
  CHECK(simulation.smoke_mass() > 0);
  for_each_index<2>(air.grid().cells, [&](const Index<2>& cell) {
    if (air.grid().cell_centre(cell)[0] > 5) REQUIRE(air.smoke_mass()[cell] == 0);
  });
  CHECK(std::abs(simulation.mass_error()) < 1e-12);
}
