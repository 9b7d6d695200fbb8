#include <catch2/catch.hpp>
#include <cmath>

#include "scene_support.hpp"
#include "simulation/plan.hpp"

using namespace spindrift;

namespace {

ExitCode outcome(const Scene& scene) {
  try {
    require_fit(scene, plan_scene(scene), "runs/some");
  } catch (const Error& error) {
    return error.code();
  }
  return ExitCode::done;
}

}  // namespace

TEST_CASE("a plan counts particles, cells and frames", "[plan]") {
  Scene scene = scene_with_everything(2);
  scene.suspension->tiles.reset();
  scene.dense_flow->support_radius = 0.5;
  scene.release[0].length = 10;
  scene.release[0].thickness = 2;
  scene.cover->from = 5;
  scene.cover->to = 25;
  scene.cover->depth = 0.5;
  scene.suspension->cell_size = 0.5;
  scene.scene.end_time = 3;
  scene.output.frames_per_second = 10;
  const Plan plan = plan_scene(scene);
  CHECK(plan.n_release == 320);  // 20 m2 at 16 a m2
  CHECK(plan.n_cover == 160);
  CHECK(plan.grid == std::vector<double>{400, 400});
  CHECK(plan.n_cells == 160000);
  CHECK(plan.n_frames == 31);
  CHECK(outcome(scene) == ExitCode::done);
}

TEST_CASE("in 3D the plan counts the width", "[plan]") {
  Scene scene = scene_with_everything(3);
  scene.dense_flow->support_radius = 2;
  scene.domain.lower[1] = 0;
  scene.domain.upper[1] = 7;
  scene.release[0].length = 10;
  scene.release[0].thickness = 2;
  CHECK(plan_scene(scene).n_release == 140);
}

TEST_CASE("on tiles the plan counts what a cloud may fill, whatever the domain", "[plan]") {
  const std::string text =
      "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [WIDTH, 500]\n[dense_flow]\n[release]\nshape = "
      "\"box\"\nlower = [1, 1]\nupper = [3, 4]\n[suspension]\ncell_size = 0.5\n[suspension.tiles]\n";
  const auto cells = [&](const std::string& width) {
    std::string of_width = text;
    return plan_scene(parse_scene(of_width.replace(of_width.find("WIDTH"), 5, width), "a.toml")).n_cells;
  };
  CHECK(cells("2000") == 600 * 6 / 0.25);
  CHECK(cells("20000") == cells("2000"));
  CHECK(cells("4") == 8 * 1000);
}

TEST_CASE("absent layers need nothing", "[plan]") {
  Scene scene = scene_with_everything(2);
  scene.suspension.reset();
  scene.cover.reset();
  scene.release.clear();
  const Plan plan = plan_scene(scene);
  CHECK(plan.n_cells == 0);
  CHECK(plan.grid.empty());
  CHECK(plan.n_release == 0);
  CHECK(plan.n_cover == 0);
}

TEST_CASE("the cover of a whole slope follows the ground", "[plan]") {
  Scene scene = scene_with_everything(2);
  scene.dense_flow->support_radius = 2;
  scene.cover->depth = 1;
  scene.terrain->shape = "polyline";
  scene.terrain->points = {{0, 40}, {30, 0}, {80, 0}};
  CHECK(plan_scene(scene).n_cover == 100);
  scene.terrain->shape = "slope";
  scene.terrain->start = {0, 40};
  scene.terrain->angle = std::atan2(40, 30);
  scene.terrain->drop = 40;
  CHECK(plan_scene(scene).n_cover == Approx(120).margin(1));
}

TEST_CASE("the longest step counts the steps of air at rest", "[plan]") {
  Scene scene = scene_with_everything(2);
  scene.dense_flow.reset();
  scene.cover.reset();
  scene.release.clear();
  scene.suspension->wind.assign(2, 0);
  scene.scene.end_time = 3;
  scene.scene.max_step = 0.5;
  CHECK(plan_scene(scene).n_steps == 6);
}

TEST_CASE("what would not fit is refused at once, with exit code 6", "[plan]") {
  Scene scene = scene_with_everything(3);
  const auto absurd = GENERATE(range(0, 6));
  if (absurd == 0) scene.suspension->cell_size = 1e-9;
  if (absurd == 1) scene.suspension->cell_size = 5e-324;
  if (absurd == 2) scene.dense_flow->support_radius = 1e-300;
  if (absurd == 3) scene.release[0].length = 1e18;
  if (absurd == 4) scene.output.frames_per_second = 1e15;
  if (absurd == 5) scene.cover->depth = 1e12;
  CHECK(outcome(scene) == ExitCode::would_not_fit);
}

TEST_CASE("what is available is a number", "[plan]") {
  CHECK(memory_available() > 1e6);
  CHECK(disk_available("no/such/folder/yet") > 0);
  CHECK(std::isfinite(disk_available("no/such/folder/yet")));
}
