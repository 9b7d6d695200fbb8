// The cases of the quick form, at their first two levels: inside their gates, error and order.

#include <catch2/catch.hpp>

#include "verification/cases.hpp"
#include "verification/study.hpp"

using namespace spindrift;

TEST_CASE("The quick verification cases are inside their gates", "[cases][slow]") {
  StudyOptions options;
  options.quick = true;
  for (const Case& what : verification_cases()) {
    if (!what.quick) continue;
    const CaseResult result = run_case(what, options);
    CAPTURE(what.name, result.order(result.what.series.front()));
    for (const Point& point : result.points) {
      CAPTURE(point.level, point.outcome.l2, point.gate, point.failure);
      for (const Check& check : point.outcome.checks) {
        CAPTURE(check.name);
        CHECK(check.value <= check.limit);
      }
      CHECK(point.inside());
    }
    CHECK(result.passed());
  }
}
