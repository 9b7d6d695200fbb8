#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "simulation/registry.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/scene_reference.hpp"
#include "simulation/scene_schema.hpp"
#include "simulation/scene_warnings.hpp"
#include "simulation/scene_writer.hpp"

using namespace spindrift;

namespace {

/// "/properties/coupling/properties/drag" of "coupling.drag".
std::string pointer_to(std::string_view path) {
  std::string pointer;
  for (std::size_t begin = 0; begin <= path.size();) {
    const std::size_t end = std::min(path.find('.', begin), path.size());
    pointer += "/properties/" + std::string(path.substr(begin, end - begin));
    begin = end + 1;
  }
  return pointer;
}

}  // namespace

TEST_CASE("The schema has every section and key, each with what it means, and nothing else", "[scene]") {
  const nlohmann::json schema = nlohmann::json::parse(scene_schema());
  CHECK(schema["properties"].size() ==
        1 + static_cast<std::size_t>(std::count_if(sections().begin(), sections().end(), [](const Section& s) {
          return s.path.find('.') == std::string_view::npos;
        })));
  for (const Section& section : sections()) {
    const nlohmann::json& object = schema.at(nlohmann::json::json_pointer(pointer_to(section.path)));
    CHECK((section.repeats ? object["items"]["type"] : object["type"]) == "object");
    if (section.repeats) CHECK(object["type"] == nlohmann::json({"object", "array"}));
    CHECK(object["additionalProperties"] == false);
    CHECK(!object["description"].get<std::string>().empty());
  }
  for (const Key& key : keys()) {
    CAPTURE(key.path);
    const nlohmann::json& property = schema.at(nlohmann::json::json_pointer(pointer_to(key.path)));
    CHECK(property["description"].get<std::string>().starts_with(key.doc));
    CHECK((property.contains("type") || property.contains("anyOf") || property.contains("enum")));
    if (!key.words.empty()) CHECK(property["enum"].size() == key.words.size());
  }
}

TEST_CASE("Ranges and units are in the schema", "[scene]") {
  const nlohmann::json schema = nlohmann::json::parse(scene_schema());
  const auto at = [&](std::string_view path) { return schema.at(nlohmann::json::json_pointer(pointer_to(path))); };
  const nlohmann::json depth = at("cover.depth");
  CHECK(depth["anyOf"][0]["exclusiveMinimum"] == 0);
  CHECK(depth["anyOf"][1]["type"] == "string");
  CHECK(at("dense_flow.friction_mu")["minimum"] == 0);
  CHECK(at("dense_flow.friction_mu")["type"] == "number");
  CHECK(at("terrain.start")["maxItems"] == 2);
  CHECK(at("output.preview")["default"] == true);
  CHECK(schema["required"] == nlohmann::json({"schema_version", "domain"}));
}

TEST_CASE("The described defaults are a scene, once it has a box", "[scene]") {
  const auto preset = GENERATE(as<std::string>{}, "physical", "paper");
  std::string text = described_defaults(preset);
  for (const auto& [from, to] : {std::pair<std::string, std::string>{"# lower = []", "lower = [0, 0]"},
                                 {"# upper = []", "upper = [90, 60]"},
                                 {"start = [0, 0]", "start = [0, 55]"}})
    text.replace(text.find(from), from.size(), to);
  const Scene scene = parse_scene(text, "defaults.toml", {"scene.preset=" + preset});
  Scene expected = complete_scene(preset);
  CHECK(scene.coupling->generation->constant == expected.coupling->generation->constant);
  CHECK(scene.dense_flow->friction_mu == expected.dense_flow->friction_mu);
  CHECK(scene.terrain->angle == Approx(expected.terrain->angle).epsilon(1e-7));
}

TEST_CASE("docs/scene.md is what the program writes, and its example is a scene", "[scene]") {
  std::ifstream file(SPINDRIFT_SOURCE_DIR "/docs/scene.md");
  const std::string page{std::istreambuf_iterator<char>(file), {}};
  CHECK(page == scene_reference());
  const std::size_t begin = page.find("```toml\n") + 8;
  const std::string example = page.substr(begin, page.find("```", begin) - begin);
  Origins origins;
  const Scene scene = parse_scene(example, "example.toml", {}, &origins);
  CHECK(scene.release.size() == 2);
  CHECK(scene_warnings(scene, origins).empty());
  for (const Key& key : keys()) CHECK(page.find(fmt::format("| `{}` | {}", key.name(), key.doc)) != std::string::npos);
}

TEST_CASE("Origins name the place in the file, --set, or nothing", "[scene]") {
  const std::string text =
      "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [9, 9]\n[suspension]\ncell_size = 1\ncfl = 2\n";
  Origins origins;
  const Scene scene = parse_scene(text, "my.toml", {"suspension.cfl=0.5"}, &origins);
  CHECK(origins.at("suspension.cell_size") == "my.toml:6:13");
  CHECK(origins.at("suspension.cfl") == "--set");
  CHECK_FALSE(origins.contains("suspension.scheme"));
  const std::string written = write_scene(scene, &origins);
  CHECK(written.find("cell_size = 1  # [m], my.toml:6:13\n") != std::string::npos);
  CHECK(written.find("cfl = 0.5  # --set\n") != std::string::npos);
  CHECK(written.find("scheme = \"maccormack\"  # default\n") != std::string::npos);
  CHECK(write_scene(parse_scene(written, "again.toml")) == write_scene(scene));
}
