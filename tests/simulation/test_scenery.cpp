#include <catch2/catch.hpp>
#include <numbers>

#include "simulation/frame.hpp"
#include "simulation/preview.hpp"
#include "simulation/scenery.hpp"
#include "simulation/setup.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

Scene slice(const std::vector<std::string>& settings = {}) {
  return parse_scene(small_avalanche_3d, "slice.toml", settings);
}

Vec<3> on_ground(const Scene& scene, double x, double y) {
  const Walls<3> walls = make_walls<3>(scene);
  return {x, y, walls.terrain->height({x, y, 0})};
}

}  // namespace

TEST_CASE("pictures of 3D runs see the whole ground from the valley's side, in light from the left", "[scenery]") {
  const Scene scene = slice();
  const View view = preview_view(scene);
  CHECK(view.width == 1380);
  CHECK(view.height == 776);
  const Scenery scenery(scene, view);
  const Camera& camera = scenery.camera();
  for (const double x : {0.0, 4.0, 8.0})
    for (const double y : {0.0, 1.0}) {
      const Camera::Seen seen = camera.project(on_ground(scene, x, y));
      CHECK((seen.x > 0 && seen.x < view.width && seen.y > 0 && seen.y < view.height && seen.depth > 0));
    }
  // The slope falls to +x: the avalanche comes down and towards the eye.
  const Camera::Seen upper = camera.project(on_ground(scene, 0.5, 0.5)),
                     lower = camera.project(on_ground(scene, 6, 0.5));
  CHECK(upper.y < lower.y);
  CHECK(upper.depth > lower.depth);
  CHECK(camera.eye[2] > 5);
  CHECK(scenery.light().up == Vec<3>(0, 0, 1));
  CHECK(scenery.light().sun.dot(camera.right) < -0.3);
  CHECK(scenery.light().sun[2] > 0.3);
}

TEST_CASE("up in a picture is against gravity", "[scenery]") {
  // The box lies along a slope of 35 degrees.
  const double angle = 35 * std::numbers::pi / 180;
  Scene scene = slice();
  scene.terrain->shape = "polyline";
  scene.terrain->points = {{0, 1}, {8, 1}};
  scene.domain.gravity = {9.81 * std::sin(angle), 0, -9.81 * std::cos(angle)};
  const Scenery scenery(scene, preview_view(scene));
  const Camera& camera = scenery.camera();
  const Vec<3> up(-std::sin(angle), 0, std::cos(angle));
  CHECK((scenery.light().up - up).norm() < 1e-12);
  CHECK(camera.right.dot(up) == Approx(0).margin(1e-12));
  CHECK(camera.up.dot(up) > 0.8);
  const Camera::Seen upper = camera.project({0.5, 0.5, 1}), lower = camera.project({7.5, 0.5, 1});
  CHECK(upper.y < lower.y);
  CHECK(upper.depth > lower.depth);
}

TEST_CASE("a picture can be asked for from anywhere", "[scenery]") {
  const Scene scene = slice();
  View view = preview_view(scene);
  view.azimuth = 0;
  view.elevation = 0.5;
  view.distance = 30;
  view.sun_azimuth = std::numbers::pi / 2;
  view.sun_elevation = 0;
  const Scenery scenery(scene, view);
  CHECK((scenery.light().sun - Vec<3>(1, 0, 0)).norm() < 1e-12);
  CHECK(scenery.camera().forward[1] == Approx(-std::cos(0.5)));
  CHECK(scenery.camera().eye[1] == Approx(0.5 + 30 * std::cos(0.5)).margin(0.02));
  view.zoom = 2;
  CHECK(Scenery(scene, view).camera().eye[1] == Approx(0.5 + 15 * std::cos(0.5)).margin(0.02));
}

TEST_CASE("a picture's landscape has the ground under its cover, the snow by kind, and the smoke", "[scenery]") {
  const Scene scene = slice();
  Simulation<3> simulation(scene);
  while (simulation.time() < 0.1) simulation.step();
  const ParticleFrame snow = particle_frame(simulation);
  const SmokeFrame smoke = smoke_frame(simulation);
  const Scenery scenery(scene, preview_view(scene));
  const Landscape landscape = scenery.landscape(picture_frame(simulation.time(), &snow, &smoke, {}));
  CHECK(landscape.snow.size() == simulation.dense()->particles.size());
  CHECK(std::ranges::count(landscape.snow_kind, 1) == static_cast<std::ptrdiff_t>(simulation.masses().n_entrained));
  CHECK(landscape.smoke.density.size() == simulation.suspension()->smoke_mass().size());
  CHECK(landscape.smoke.origin == simulation.suspension()->grid().cell_centre({}));

  const ReliefSurface surface(landscape.ground);
  const double cos_slope = std::cos(38 * std::numbers::pi / 180);
  // Away from the flow the cover is as deep as the scene says, and goes on beyond the domain.
  for (const double y : {0.4, 1.3}) {
    const ReliefSurface::Point point = surface.at(3.2, y);
    CHECK(static_cast<double>(point.snow) == Approx(0.3).margin(0.05));
    CHECK(static_cast<double>(point.slope_x) == Approx(-std::tan(std::acos(cos_slope))).margin(0.15));
  }
  const double bare_height = make_walls<3>(scene).terrain->height({3.2, 0, 0});
  const Index<2> near{static_cast<int>((3.2 - landscape.ground.origin[0]) / landscape.ground.spacing), 5};
  const Vec<3> top = surface.position(near);
  CHECK(top[2] - bare_height + (top[0] - 3.2) * std::tan(std::acos(cos_slope)) == Approx(0.3 / cos_slope).margin(0.06));
  const PictureFrame bare = picture_frame(0, nullptr, nullptr, {});
  CHECK(scenery.landscape(bare).ground.snow.empty());
  CHECK(scenery.landscape(bare).snow.empty());
}

TEST_CASE("frames that were read back give the picture of a 2D simulation again", "[scenery]") {
  const Scene scene = parse_scene(small_avalanche, "small.toml");
  Simulation<2> simulation(scene);
  while (simulation.time() < 0.1) simulation.step();
  const PreviewFrame drawn = preview_frame(simulation);
  const StoredFrame snow = read_vtkhdf(particle_frame(simulation).file(), "snow");
  const StoredFrame smoke = read_vtkhdf(smoke_frame(simulation).file(), "smoke");
  const StoredFile snow_file{snow, "snow"}, smoke_file{smoke, "smoke"};
  const PreviewFrame again = preview_frame(scene, simulation.walls(), picture_frame(&snow_file, &smoke_file, {}));
  CHECK(again.width == drawn.width);
  CHECK(again.time == drawn.time);
  CHECK(again.ground == drawn.ground);
  CHECK(again.smoke == drawn.smoke);
  CHECK(again.solid == drawn.solid);
  CHECK(again.smoke_shape == drawn.smoke_shape);
  CHECK(again.snow_kind == drawn.snow_kind);
  CHECK(again.snow_radius == drawn.snow_radius);
  REQUIRE(again.snow.size() == drawn.snow.size());
  for (std::size_t i = 0; i < drawn.snow.size(); ++i) CHECK((again.snow[i] - drawn.snow[i]).norm() < 1e-5);
  REQUIRE(again.cover_top.size() == drawn.cover_top.size());
  CHECK(again.cover_base == drawn.cover_base);
  for (std::size_t i = 0; i < drawn.cover_top.size(); ++i)
    CHECK((again.cover_top[i] - drawn.cover_top[i]).norm() < 1e-5);
}
