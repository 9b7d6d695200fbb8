#include "io/series.hpp"

#include <nlohmann/json.hpp>

#include "io/commit.hpp"

namespace spindrift {

void commit_series(const std::filesystem::path& path, std::span<const SeriesEntry> entries) {
  nlohmann::ordered_json index{{"file-series-version", "1.0"}, {"files", nlohmann::ordered_json::array()}};
  for (const SeriesEntry& entry : entries) index["files"].push_back({{"name", entry.name}, {"time", entry.time}});
  commit(path, index.dump(1) + "\n");
}

}  // namespace spindrift
