#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "io/series.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

TEST_CASE("the series index names every file and its time exactly", "[series]") {
  const TemporaryFolder folder;
  const auto path = folder.path() / "particles.hdf.series";
  const std::vector<SeriesEntry> entries{{"frames/particles_000000.hdf", 0}, {"frames/\"odd\".hdf", 0.1 + 0.2}};
  commit_series(path, entries);
  const auto json = nlohmann::json::parse(text_of(path));
  CHECK(json.at("file-series-version") == "1.0");
  REQUIRE(json.at("files").size() == 2);
  for (std::size_t i = 0; i < 2; ++i) {
    CHECK(json["files"][i].at("name") == entries[i].name);
    CHECK(json["files"][i].at("time").get<double>() == entries[i].time);
  }
  commit_series(path, {});
  CHECK(nlohmann::json::parse(text_of(path)).at("files").empty());
  CHECK(folder.n_entries() == 1);
}
