#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>
#include <fstream>
#include <numbers>

#include "bad_scenes.hpp"
#include "scene_support.hpp"

using namespace spindrift;

namespace {

/// A file in the system's folder for such, gone at the end.
struct TemporaryFile {
  std::filesystem::path path;
  explicit TemporaryFile(const std::string& name, const std::string& text)
      : path(std::filesystem::temp_directory_path() / name) {
    std::ofstream(path, std::ios::binary) << text;
  }
  ~TemporaryFile() { std::filesystem::remove(path); }
};

std::string file_refusal(const std::filesystem::path& path) {
  try {
    read_scene(path);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

std::size_t n_lines(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n')) + 1;
}

}  // namespace

TEST_CASE("the smallest scene has a domain and nothing else", "[scene]") {
  const Scene scene = parse_scene(head, "folder/my slope.toml");
  CHECK(scene.scene.name == "my-slope");
  CHECK(scene.scene.dim == 2);
  CHECK(scene.scene.preset == "physical");
  CHECK(scene.domain.upper == std::vector<double>{100, 50});
  CHECK(scene.domain.gravity == std::vector<double>{0, -9.81});
  CHECK_FALSE(scene.terrain.has_value());
  CHECK(scene.release.empty());
  CHECK_FALSE(scene.dense_flow.has_value());
  CHECK_FALSE(scene.cover.has_value());
  CHECK_FALSE(scene.suspension.has_value());
  CHECK_FALSE(scene.coupling.has_value());
  CHECK_FALSE(scene.entrainment.has_value());
}

TEST_CASE("an empty section switches its physics on with all defaults", "[scene]") {
  const Scene scene =
      parse_scene(snow + "[cover]\n[suspension.confinement]\n[coupling.drag]\n[entrainment]\n", "a.toml");
  CHECK(scene.release[0].velocity == std::vector<double>{0, 0});
  CHECK(scene.dense_flow->support_radius == DenseFlowSection{}.support_radius);
  CHECK(scene.suspension->confinement->strength == ConfinementSection{}.strength);
  CHECK(scene.coupling->drag->law == "air");
  CHECK_FALSE(scene.coupling->lift.has_value());
  CHECK(scene.entrainment->rate == 10);
}

TEST_CASE("values come as numbers, with units, in lists and in dotted keys", "[scene]") {
  const Scene scene = parse_scene(R"(schema_version = 1
scene = {dim = 3, end_time = "2 min", seed = 12345678901234567}
domain.lower = ["-1 km", 0, 0.5]
domain.upper = [1e3, "20000 cm", 100]
domain.gravity = [3.0, 0, -9]
[terrain]
shape = "polyline"
angle = "30 deg"
points = [[0, "0.05 km"], [10, 45.0], [10, 30], ["100 m", 0]]
[dense_flow]
support_radius = "210 mm"
)",
                                  "a.toml");
  CHECK(scene.scene.end_time == 120);
  CHECK(scene.scene.seed == 12345678901234567U);
  CHECK(scene.domain.lower == std::vector<double>{-1000, 0, 0.5});
  CHECK(scene.domain.upper == std::vector<double>{1000, 200, 100});
  CHECK(scene.domain.gravity == std::vector<double>{3, 0, -9});
  CHECK(scene.terrain->angle == Approx(std::numbers::pi / 6));
  CHECK(scene.terrain->points == std::vector<std::array<double, 2>>{{0, 50}, {10, 45}, {10, 30}, {100, 0}});
  CHECK(scene.dense_flow->support_radius == Approx(0.21));
}

TEST_CASE("a preset stands under the file's own values", "[scene]") {
  const std::string text =
      snow + "friction_mu = 0.4\n[suspension]\n[coupling.generation]\n[scene]\npreset = \"paper\"\n";
  const Scene paper = parse_scene(text, "a.toml");
  CHECK(paper.coupling->generation->constant == 0.2);
  CHECK(paper.coupling->generation->threshold_speed == 0);
  CHECK(paper.suspension->settling_speed == 0);
  CHECK(paper.dense_flow->friction_mu == 0.4);
  CHECK(paper.dense_flow->friction_xi == 0);
  CHECK(parse_scene(text, "a.toml", {"scene.preset=physical"}).coupling->generation->constant == 0.02);
}

TEST_CASE("settings stand above the file, the last one above the others", "[scene]") {
  const Scene scene = parse_scene(snow + "support_radius = 0.4\n", "a.toml",
                                  {"dense_flow.support_radius=0.5", "dense_flow.support_radius = 30 cm", "scene.seed=7",
                                   "dense_flow.solver=wcsph", "domain.lower=[-1, \"-2 m\"]", "cover.depth=1",
                                   "suspension={}", "coupling={drag = {constant = 3}}", "output.preview=false"});
  CHECK(scene.dense_flow->support_radius == 0.3);
  CHECK(scene.scene.seed == 7);
  CHECK(scene.dense_flow->solver == "wcsph");
  CHECK(scene.domain.lower == std::vector<double>{-1, -2});
  CHECK(scene.cover->depth == 1);
  CHECK(scene.suspension.has_value());
  CHECK(scene.coupling->drag->constant == 3);
  CHECK_FALSE(scene.output.preview);
}

TEST_CASE("bad settings are refused at --set", "[scene]") {
  CHECK(refusal(snow, {"foo"}) == "--set: \"foo\": expected key=value, as in scene.end_time=5");
  CHECK(refusal(snow, {"=5"}) == "--set: \"=5\": expected key=value, as in scene.end_time=5");
  CHECK(refusal(snow, {"scene.end_tme=5"}) == "--set: scene.end_tme: unknown key; did you mean \"end_time\"?");
  CHECK(refusal(snow, {"a.b.c.d.e=5"}) == "--set: a.b.c.d.e: unknown key");
  CHECK(refusal(snow, {"release=5"}) == "--set: release: got 5, expected a section [release]");
  CHECK(refusal(snow, {"scene.seed=5\nscene.dim=3"}) ==
        "--set: scene.seed: got \"5\\x0ascene.dim=3\", expected a whole number from 0");
  CHECK(refusal(snow, {"scene.seed=-1"}) == "--set: scene.seed: got -1, expected a whole number from 0");
  CHECK(refusal(snow, {"domain.lower=[1,2"}) ==
        "--set: domain.lower: got \"[1,2\", expected a list of 2, each a length from -1e+07 to 1e+07 m");
  const std::string two = head + "[terrain]\n[dense_flow]\n[[release]]\n[[release]]\nat = 20\n";
  CHECK(refusal(two, {"release.at=3"}) == "--set: release.at: which of the 2? release[0] to release[1]");
  CHECK(refusal(two, {"release[2].at=3"}) ==
        "--set: release[2].at: there is no release[2]; the scene has 2, counted from 0");
  CHECK(refusal(two, {"release[1].at=-3"}) == "--set: release[1].at: got -3, expected a length from 0 to 1e+06 m");
  CHECK(parse_scene(two, "a.toml", {"release[1].at=30"}).release[1].at == 30);
  CHECK(parse_scene(snow, "a.toml", {"release[0].at=30"}).release[0].at == 30);
  CHECK(refusal(snow, {"schema_version=2"}) == "--set: schema_version: got 2, expected 1");
}

TEST_CASE("bad scenes are refused with place, key, what was got and what is expected", "[scene]") {
  const BadScene bad = GENERATE(from_range(bad_scenes()));
  CHECK(refusal(bad.text) == bad.message);
}

TEST_CASE("at most twenty errors are shown, in the order of the file", "[scene]") {
  std::string text = head + "[output]\n";
  for (int i = 0; i < 30; ++i) text += "zzzzzz" + std::to_string(i) + " = 1\n";
  const std::string said = refusal(text);
  CHECK(n_lines(said) == 21);
  CHECK(said.rfind("a.toml:6:1: output.zzzzzz0: unknown key\n", 0) == 0);
  CHECK(said.find("\n10 more errors") == said.size() - 15);
}

TEST_CASE("hostile texts are refused, and fast", "[scene]") {
  const std::string deep(10000, '[');
  std::string dotted = "a";
  for (int i = 0; i < 32000; ++i) dotted += ".a";
  const auto text = GENERATE_REF(values<std::string>({"",
                                                      "\n\n",
                                                      "\xEF\xBB\xBF",
                                                      std::string(1, '\0'),
                                                      "\xFF\xFE" + std::string("a\0=\0", 4),
                                                      head + "[release]\nat = \"\xC3\x28\"\n",
                                                      "x = " + deep,
                                                      "x = " + deep + std::string(10000, ']'),
                                                      deep + "x" + std::string(10000, ']'),
                                                      dotted + " = 1",
                                                      "[" + dotted + "]",
                                                      "x = {" + dotted + " = 1}",
                                                      "x = [\"\"\" \" \"\"\", {" + dotted + " = 1}]",
                                                      head + "[[release]]\n",
                                                      head + "[release",
                                                      head + "[dense_flow]\nsupport_radius = ",
                                                      head + "[dense_flow]\nsupport_radius = 1e",
                                                      head + "[dense_flow]\nsolver = \"dfs",
                                                      std::string(60000, '"'),
                                                      std::string(60000, '\\'),
                                                      head + "domain = 3",
                                                      "schema_version = 99999999999999999999"}));
  CHECK_FALSE(refusal(text).empty());
}

TEST_CASE("a text cut anywhere, or with any byte changed, is taken or refused with a message", "[scene]") {
  const std::string whole = snow + "support_radius = \"0.3 m\"\n[suspension]\ncell_size = 1.5 # m\n[coupling.drag]\n";
  REQUIRE(refusal(whole).empty());
  for (std::size_t n = 0; n < whole.size(); ++n) {
    CHECK_NOTHROW(refusal(whole.substr(0, n)));
    for (const char c : {'\0', '"', '[', '}', '.', '\xFF', '9', '\n'}) {
      std::string changed = whole;
      changed[n] = c;
      CHECK_NOTHROW(refusal(changed));
    }
  }
}

TEST_CASE("only regular files of at most 4 MB are read", "[scene]") {
  const TemporaryFile good("spindrift_good.toml", head);
  CHECK(read_scene(good.path).scene.name == "spindrift_good");
  CHECK(file_refusal("/no/such/file.toml") == "/no/such/file.toml: there is no such file");
  const std::string folder = std::filesystem::temp_directory_path().string();
  CHECK(file_refusal(folder) == folder + ": not a regular file");
  CHECK(file_refusal("/dev/zero") == "/dev/zero: not a regular file");
  const TemporaryFile big("spindrift_big.toml", head + std::string(4 * 1024 * 1024, '#'));
  CHECK(file_refusal(big.path) == big.path.string() + ": longer than the 4 MB that a scene may have");
  const TemporaryFile full("spindrift_full.toml", head + std::string(65536 - head.size(), '#'));
  CHECK(file_refusal(full.path) == "");
}
