#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <utility>

#include "scene_support.hpp"
#include "simulation/scene_values.hpp"
#include "simulation/scene_writer.hpp"
#include "simulation/units.hpp"

using namespace spindrift;

namespace {

template <class T>
constexpr bool is_optional = false;
template <class T>
constexpr bool is_optional<std::optional<T>> = true;

struct Anything {
  template <class T>
  requires(!is_optional<T>) operator T() const;  // NOLINT(google-explicit-constructor)
};

template <class T, std::size_t... I>
constexpr bool takes(std::index_sequence<I...>) {
  return requires {
    T{(static_cast<void>(I), Anything{})...};
  };
}

/// How many members a plain struct has.
template <class T, std::size_t N = 40>
constexpr std::size_t n_members() {
  if constexpr (takes<T>(std::make_index_sequence<N>{})) {
    return N;
  } else {
    return n_members<T, N - 1>();
  }
}

std::size_t n_keys(std::string_view section) {
  return static_cast<std::size_t>(
      std::count_if(keys().begin(), keys().end(), [&](const Key& key) { return key.section() == section; }));
}

/// A number inside the key's range, not its default.
double example(const Key& key) {
  const double low = std::max(key.range.low, -10.0), high = std::min(key.range.high, low + 2);
  return low + 0.375 * (high - low);
}

/// Whether a value that is good by itself may clash with those of other keys.
bool bound_to_others(const Key& key) {
  const std::set<std::string_view> bound = {"scene.dim",
                                            "scene.preset",
                                            "scene.name",
                                            "release.layers",
                                            "cover.to",
                                            "suspension.cell_size",
                                            "suspension.initial_flow",
                                            "dense_flow.support_radius",
                                            "entrainment.threshold_surface"};
  return bound.contains(key.path) || key.section() == "domain";
}

Scene read_with(int dim, const Key& key, const std::string& value) {
  return parse_scene(write_scene(scene_with_everything(dim)), "a.toml", {key.path + "=" + value});
}

}  // namespace

TEST_CASE("every member of every section has a key", "[registry]") {
  CHECK(n_keys("scene") == n_members<SceneSection>());
  CHECK(n_keys("domain") == n_members<DomainSection>());
  CHECK(n_keys("terrain") == n_members<TerrainSection>());
  CHECK(n_keys("obstacle") == n_members<ObstacleSection>());
  CHECK(n_keys("release") == n_members<ReleaseSection>());
  CHECK(n_keys("smoke") == n_members<SmokeSection>());
  CHECK(n_keys("dense_flow") == n_members<DenseFlowSection>());
  CHECK(n_keys("cover") == n_members<CoverSection>());
  CHECK(n_keys("suspension") == n_members<SuspensionSection>() - 2);  // less confinement, tiles
  CHECK(n_keys("suspension.confinement") == n_members<ConfinementSection>());
  CHECK(n_keys("suspension.tiles") == n_members<TilesSection>());
  CHECK(n_keys("coupling") == n_members<CouplingSection>() - 4);  // less drag, lift, generation, adhesion
  CHECK(n_keys("coupling.drag") == n_members<DragSection>());
  CHECK(n_keys("coupling.lift") == n_members<LiftSection>());
  CHECK(n_keys("coupling.generation") == n_members<GenerationSection>());
  CHECK(n_keys("coupling.adhesion") == n_members<AdhesionSection>());
  CHECK(n_keys("entrainment") == n_members<EntrainmentSection>());
  CHECK(n_keys("pylon") == n_members<PylonSection>());
  CHECK(n_keys("output") == n_members<OutputSection>());
}

TEST_CASE("keys have distinct paths and places, a section, a doc line and a unit that parses", "[registry]") {
  std::set<std::string> paths;
  std::set<const void*> places;
  Scene scene = complete_scene("physical");
  for (const Key& key : keys()) {
    CAPTURE(key.path);
    CHECK(paths.insert(key.path).second);
    CHECK(std::visit([&](auto* value) { return places.insert(value).second; }, key.field(scene)));
    CHECK(find_section(key.section()) != nullptr);
    CHECK(find_key(key.path) == &key);
    CHECK_FALSE(key.doc.empty());
    CHECK_NOTHROW(parse_unit(key.unit));
    CHECK(parse_unit(key.unit).factor == 1);
  }
  CHECK(find_key("dense_flow") == nullptr);
  CHECK(find_section("dense_flow.solver") == nullptr);
}

TEST_CASE("sections come into being with what they are part of, and only then", "[registry]") {
  Scene scene;
  CHECK(find_section("domain")->exists(scene));
  CHECK_FALSE(find_section("coupling.drag")->exists(scene));
  find_section("coupling.drag")->create(scene);
  CHECK(scene.coupling.has_value());
  CHECK(scene.coupling->drag.has_value());
  CHECK_FALSE(scene.coupling->lift.has_value());
  scene.coupling->drag->constant = 7;
  find_section("coupling.drag")->create(scene);
  CHECK(scene.coupling->drag->constant == 7);
}

TEST_CASE("defaults are the structs' own", "[registry]") {
  Scene structs;
  structs.terrain.emplace();
  structs.obstacle.emplace_back();
  structs.release.emplace_back();
  structs.smoke.emplace_back();
  structs.dense_flow.emplace();
  structs.cover.emplace();
  structs.suspension.emplace().confinement.emplace();
  structs.suspension->tiles.emplace();
  structs.coupling.emplace();
  structs.coupling->drag.emplace();
  structs.coupling->lift.emplace();
  structs.coupling->generation.emplace();
  structs.coupling->adhesion.emplace();
  structs.entrainment.emplace();
  structs.path.emplace();
  structs.pylon.emplace_back();
  CHECK(same(complete_scene("physical"), structs));
}

TEST_CASE("every default lies in its range and its words", "[registry]") {
  for (const int dim : {2, 3}) {
    const std::string text = write_scene(scene_with_everything(dim));
    CHECK(refusal(text) == "");
  }
}

TEST_CASE("the presets differ where the paper's constants differ", "[registry]") {
  const Scene paper = complete_scene("paper"), physical = complete_scene("physical");
  CHECK(paper.coupling->generation->constant == 0.2);
  CHECK(paper.coupling->generation->threshold_speed == 0);
  CHECK(paper.dense_flow->compaction_time == 0);
  CHECK(paper.dense_flow->friction_mu == 0);
  CHECK(paper.suspension->settling_speed == 0);
  CHECK(paper.coupling->drag->law == "air");
  CHECK(physical.coupling->generation->constant == 0.02);
  CHECK(physical.coupling->generation->threshold_speed == 5);
  CHECK(physical.dense_flow->friction_mu == 0.155);
  CHECK(physical.dense_flow->friction_xi == 4000);
  CHECK(physical.suspension->settling_speed == 0.5);
  CHECK(physical.coupling->drag->law == "air");
}

TEST_CASE("every key takes its value in every form", "[registry]") {
  for (const Key& key : keys()) {
    if (bound_to_others(key)) continue;
    CAPTURE(key.path);
    Scene probe = complete_scene("physical");
    const Slot slot = key.field(probe);
    if (std::holds_alternative<double*>(slot)) {
      const double x = example(key);
      const std::string number = number_text(x), unit(key.unit);
      const std::string glue = unit.starts_with('1') ? " " : "";
      for (const std::string& form :
           {number, '"' + number + ' ' + unit + '"', number + glue + unit, " " + number + " " + unit + " "}) {
        CAPTURE(form);
        Scene scene = read_with(2, key, form);
        CHECK(*std::get<double*>(key.field(scene)) == x);
      }
    } else if (std::holds_alternative<int*>(slot)) {
      Scene scene = read_with(2, key, "77");
      CHECK(*std::get<int*>(key.field(scene)) == 77);
    } else if (std::holds_alternative<bool*>(slot)) {
      for (const bool b : {true, false}) {
        Scene scene = read_with(2, key, b ? "true" : "false");
        CHECK(*std::get<bool*>(key.field(scene)) == b);
      }
    } else if (std::holds_alternative<std::string*>(slot)) {
      for (const std::string_view word : key.words) {
        const std::set<std::string_view> need_more = {"polyline", "area", "box", "ball", "polygon"};
        if (need_more.contains(word) || std::ranges::count(field_shapes, word) > 0) continue;
        Scene bare = read_with(2, key, std::string(word)), quoted = read_with(2, key, '"' + std::string(word) + '"');
        CHECK(*std::get<std::string*>(key.field(bare)) == word);
        CHECK(*std::get<std::string*>(key.field(quoted)) == word);
      }
    }
  }
}

TEST_CASE("every key refuses other types and numbers beyond its range", "[registry]") {
  const std::string text = write_scene(scene_with_everything(3));
  for (const Key& key : keys()) {
    CAPTURE(key.path);
    Scene probe = complete_scene("physical");
    const Slot slot = key.field(probe);
    std::vector<std::string> bad = {"{}", "1979-05-27"};
    if (!std::holds_alternative<std::string*>(slot))
      bad.insert(bad.end(), {"\"\"", "word", "nan", "inf", "-inf", "1e308"});
    if (!std::holds_alternative<bool*>(slot)) bad.emplace_back("true");
    if (!key.words.empty()) bad.insert(bad.end(), {"\"\"", "1", "nonsense"});
    const bool whole = std::holds_alternative<int*>(slot);
    const auto beyond = [&](double bound, bool bound_itself, double step) {
      if (std::isinf(bound)) return;
      bad.push_back(number_text(bound_itself ? bound
                                : whole      ? bound + step
                                             : bound + step * (1 + 0.01 * std::abs(bound))));
    };
    beyond(key.range.high, key.range.below_high, 1);
    beyond(key.range.low, key.range.above_low, -1);
    for (const std::string& value : bad) {
      CAPTURE(value);
      const std::string said = refusal(text, {key.path + "=" + value});
      CHECK(said.rfind("--set: " + key.path, 0) == 0);
      CHECK(said.find("expected ") != std::string::npos);
    }
  }
}

TEST_CASE("what a key expects, in words", "[registry]") {
  CHECK(expectation(*find_key("dense_flow.support_radius")) == "a length above 0 and at most 100 m");
  CHECK(expectation(*find_key("terrain.angle")) == "an angle from 0 and below 90 deg");
  CHECK(expectation(*find_key("dense_flow.solver")) == "\"dfsph\" or \"wcsph\"");
  CHECK(expectation(*find_key("release.shape")) == "\"slab\", \"area\", \"box\", \"ball\" or \"polygon\"");
  CHECK(expectation(*find_key("coupling.min_mass")) == "a number from 0 and below 1");
  CHECK(expectation(*find_key("scene.dim")) == "a whole number from 2 to 3");
  CHECK(expectation(*find_key("output.smoke")) == "true or false");
}
