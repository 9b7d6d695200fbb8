// The machinery of `spindrift verify`: norms, orders, verdicts.

#include <catch2/catch.hpp>
#include <limits>

#include "verification/cases.hpp"
#include "verification/curve.hpp"
#include "verification/quoted.hpp"
#include "verification/study.hpp"

using namespace spindrift;

TEST_CASE("Error norms are relative to the reference, absolute where it is zero", "[study]") {
  ErrorNorms norms;
  norms.add(3.1, 3, 2);
  norms.add(-4.2, -4);
  CHECK(norms.l2() == Approx(std::sqrt((2 * 0.01 + 0.04) / (2 * 9 + 16))));
  CHECK(norms.max() == Approx(0.2 / 4));
  ErrorNorms absolute;
  absolute.add(0.3, 0);
  CHECK(absolute.l2() == Approx(0.3));
  CHECK(absolute.max() == Approx(0.3));
  absolute.add(std::numeric_limits<double>::quiet_NaN(), 0);
  CHECK(!(absolute.max() <= 1));
  CHECK(!(absolute.l2() <= 1));
}

TEST_CASE("A result knows its order, its verdict and its cheapest run", "[study]") {
  Case what;
  what.series = {{"resolution", "a", {}, {{"1", {}, 1}, {"2", {}, 0.5}, {"3", {}, 0.25}}}};
  CaseResult result{what, {}};
  for (const auto& [size, error, seconds] :
       {std::array{1.0, 0.16, 1.0}, std::array{0.5, 0.04, 4.0}, std::array{0.25, 0.01, 16.0}}) {
    Point point{"resolution", "a", "", size, 0.2, {error, error, {}}, {}, {}};
    point.cost.seconds = seconds;
    result.points.push_back(point);
  }
  CHECK(result.order(what.series[0]) == Approx(2));
  CHECK(result.passed());
  CHECK(result.cheapest(0.05)->cost.seconds == 4);
  CHECK(result.cheapest(0.001) == nullptr);
  result.what.least_order = 2.1;
  CHECK(!result.passed());
  result.what.least_order = 1.9;
  CHECK(result.passed());
  result.what.series.push_back({"stiffness", "b", {}, {{"1", {}, 1}, {"2", {}, 0.5}}});
  for (const double size : {1.0, 0.5})
    result.points.push_back({"stiffness", "b", "", size, 0.2, {0.1 * size, 0.1 * size, {}}, {}, {}});
  CHECK(result.passed());
  result.what.n_gated = 2;
  CHECK(!result.passed());  // of first order
  result.what.least_order = 0.9;
  CHECK(result.passed());
  result.points[1].outcome.checks.push_back({"a check", 2, 1});
  CHECK(!result.passed());
  result.points[1].outcome.checks.clear();
  result.points[2].failure = "unstable";
  CHECK(!result.passed());
}

TEST_CASE("Further series keep the settings of the one that they come from", "[study]") {
  const Series base{"resolution", "a", {"x=1"}, {{"1", {"d=1"}, 1, 0.1}, {"2", {"d=2"}, 0.5, 0.1}}};
  const Series other = with_settings(base, "solver", "b", {"y=2"});
  CHECK(other.settings == std::vector<std::string>{"x=1", "y=2"});
  CHECK(other.levels[1].settings == base.levels[1].settings);
  CHECK(other.levels[1].gate > 1e300);
  CHECK(first_levels(other, 1).levels.size() == 1);
  const Series values = over_values(base, 1, "cfl", "c", {"3", "4"});
  CHECK(values.settings == std::vector<std::string>{"x=1", "d=2"});
  CHECK(values.levels[1].settings == std::vector<std::string>{"c=4"});
}

TEST_CASE("Text in a table keeps its commas and quotes, on one line", "[study]") {
  CHECK(quoted("") == "\"\"");
  CHECK(quoted("a, \"b\"\nc") == "\"a, \"\"b\"\" c\"");
}

TEST_CASE("A curve goes on beyond its ends", "[study]") {
  const Curve curve{{0, 1}, {1, 3}, {3, 4}};
  CHECK(interpolated(curve, 0.5) == Approx(2));
  CHECK(interpolated(curve, 2) == Approx(3.5));
  CHECK(interpolated(curve, 5) == Approx(5));
  CHECK(interpolated(curve, -1) == Approx(-1));
}

TEST_CASE("Every case has a scene, a source and a default series, and its settings are read", "[study]") {
  for (const Case& what : verification_cases()) {
    CAPTURE(what.name);
    CHECK(!what.title.empty());
    CHECK(!what.source.empty());
    CHECK(!what.reference.empty());
    REQUIRE(!what.series.empty());
    CHECK(what.series[0].levels.size() >= 2);
    for (const Series& series : what.series)
      for (const Level& level : series.levels) {
        const Scene scene = scene_of(what, series, level);
        CHECK(scene.scene.dim == (what.compare.index() == 0 ? 2 : 3));
      }
  }
}
