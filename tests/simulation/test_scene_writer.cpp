#include <catch2/catch.hpp>
#include <limits>

#include "scene_support.hpp"
#include "simulation/scene_writer.hpp"

using namespace spindrift;

TEST_CASE("a written scene reads back as the same scene", "[scene]") {
  const auto dim = GENERATE(2, 3);
  const auto preset = GENERATE(as<std::string>{}, "physical", "paper");
  Scene scene = scene_with_everything(dim, preset);
  const auto variant = GENERATE(0, 1, 2, 3);
  if (variant == 1) {
    scene.terrain->shape = "polyline";
    scene.terrain->points = {{0, 1.0 / 3}, {0.1 + 0.2, -5e-324}, {90, -50}};
    scene.release[0].shape = "box";
    scene.release[0].lower = scene.domain.lower;
    scene.release[0].upper.assign(scene.domain.lower.size(), 1e-300);
  }
  if (variant == 2) {
    scene.terrain->angle = std::nextafter(1.0, 2.0);
    scene.scene.seed = 9223372036854775807U;
    scene.scene.end_time = 1e6;
    scene.coupling->lift.reset();
    scene.suspension->confinement.reset();
    scene.entrainment.reset();
    scene.output.preview = false;
  }
  if (variant == 3) {
    Scene bare;
    bare.scene = scene.scene;
    bare.domain = scene.domain;
    scene = bare;
  }
  const std::string text = write_scene(scene);
  const Scene back = parse_scene(text, "other_name.toml");
  CHECK(same(back, scene));
  CHECK(write_scene(back) == text);
  CHECK(canonical_scene(back) == canonical_scene(scene));
}

TEST_CASE("a written scene states units, and only what exists", "[scene]") {
  const Scene scene = parse_scene(
      "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [9, 9.5]\n[terrain]\nangle = \"38 deg\"\n", "a.toml");
  const std::string text = write_scene(scene);
  CHECK(text.rfind("schema_version = 1\n\n[scene]\nname = \"a\"\ndim = 2\nseed = 1\n", 0) == 0);
  CHECK(text.find("\nupper = [9, 9.5]  # [m]\ngravity = [0, -9.81]  # [m/s^2]\n") != std::string::npos);
  CHECK(text.find("\nangle = 0.6632251157578453  # [rad], 38 deg\n") != std::string::npos);
  CHECK(text.find("front") == std::string::npos);
  CHECK(text.find("points") == std::string::npos);
  CHECK(text.find("dense_flow") == std::string::npos);
  CHECK(text.find("\n[output]\n") != std::string::npos);
}

TEST_CASE("the canonical form depends on values, not on how they are written", "[scene]") {
  const std::string domain = "[domain]\nlower = [0, 0]\nupper = [9, 9]\n";
  const auto canonical = [](const std::string& text, const char* file) {
    return canonical_scene(parse_scene(text, file));
  };
  const std::string a = canonical("schema_version = 1\n" + domain + "[suspension]\ncell_size = \"1 m\"\n", "a.toml");
  CHECK(a == canonical("schema_version = 1\nsuspension = {cell_size = 1.0}\n" + domain, "b.toml"));
  CHECK(a != canonical("schema_version = 1\n" + domain + "[suspension]\ncell_size = 1.0000000000000002\n", "a.toml"));
  CHECK(a != canonical("schema_version = 1\n" + domain, "a.toml"));
}
