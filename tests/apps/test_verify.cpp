// `spindrift verify` as users run it.

#include <algorithm>
#include <catch2/catch.hpp>
#include <filesystem>

#include "small_scenes.hpp"
#include "workplace.hpp"

using namespace spindrift::testing;

TEST_CASE("verify names its cases, one a line", "[verify]") {
  const Workplace place;
  const Outcome list = place.run("verify --list");
  CHECK(list.code == 0);
  CHECK(std::count(list.out.begin(), list.out.end(), '\n') >= 30);
  CHECK(list.out.find("dam_break ") != std::string::npos);
  CHECK(place.n_entries() == 0);
}

TEST_CASE("verify refuses what it cannot do, and touches nothing", "[verify]") {
  const Workplace place;
  place.write("a.toml", box_scene);
  place.write("bad.toml", "schema_version = 1\n[domain]\nlower = [0, 0]\n");
  struct Row {
    std::string words, message;
  };
  const auto row = GENERATE(Row{"verify dam_brake", "did you mean \"dam_break\"?"},
                            Row{"verify cavity --set scene.seed=2", "--set changes a scene of your own"},
                            Row{"verify a.toml cavity", "a scene is refined alone"},
                            Row{"verify nowhere.toml", "nowhere.toml"}, Row{"verify bad.toml", "domain.upper"},
                            Row{"verify --stability a.toml", "--stability has scenes and settings of its own"});
  const Outcome outcome = place.run(row.words);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find(row.message) != std::string::npos);
  CHECK(outcome.out.empty());
  CHECK(place.n_entries() == 2);
}

TEST_CASE("verify writes a page, the same as HTML, and a table of all points", "[verify]") {
  const Workplace place;
  const Outcome outcome = place.run("verify projection --quick -o out");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "out/verification.md\n");
  const std::string page = text_of(place.folder() / "out/verification.md"),
                    html = text_of(place.folder() / "out/verification.html");
  const std::string points = text_of(place.folder() / "out/verification/points.csv");
  CHECK(page.find("| `projection` |") != std::string::npos);
  CHECK(html.find("<code>projection</code>") != std::string::npos);
  CHECK(std::count(points.begin(), points.end(), '\n') == 1 + 2);
  const bool drawn = std::filesystem::exists(place.folder() / "out/verification/projection.png");
  CHECK(drawn == (html.find("data:image/png;base64,iVBOR") != std::string::npos));
  CHECK(drawn == (outcome.err.find("no pictures") == std::string::npos));
}

TEST_CASE("verify refines a scene of the user's", "[verify]") {
  const Workplace place;
  place.write("a.toml", box_scene);
  const Outcome outcome = place.run("verify a.toml --quick -o out --set scene.end_time=0.05");
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "out/refinement.md\n");
  CHECK(text_of(place.folder() / "out/refinement.md").find("| all | x 1 |") != std::string::npos);
  CHECK(text_of(place.folder() / "out/refinement.csv").starts_with("order,quantity,factor,level,scale,value,"));
}
