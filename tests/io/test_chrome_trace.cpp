#include <array>
#include <catch2/catch.hpp>
#include <fstream>
#include <nlohmann/json.hpp>

#include "io/chrome_trace.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

TEST_CASE("a trace is JSON in microseconds", "[io]") {
  const TemporaryFolder folder;
  const std::array<TraceSpan, 2> spans{TraceSpan{"step", 0.5, 0.25}, TraceSpan{"a \"part\"", 0.5, 1e-6}};
  write_chrome_trace(folder.path() / "trace.json", spans);
  std::ifstream file(folder.path() / "trace.json");
  const nlohmann::json trace = nlohmann::json::parse(file);
  REQUIRE(trace["traceEvents"].size() == 2);
  CHECK(trace["traceEvents"][0]["ph"] == "X");
  CHECK(trace["traceEvents"][0]["ts"] == 5e5);
  CHECK(trace["traceEvents"][0]["dur"] == 2.5e5);
  CHECK(trace["traceEvents"][1]["name"] == "a \"part\"");
}
