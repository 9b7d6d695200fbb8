#include "io/chrome_trace.hpp"

#include <fmt/format.h>

#include <iterator>
#include <nlohmann/json.hpp>

#include "io/commit.hpp"

namespace spindrift {

void write_chrome_trace(const std::filesystem::path& path, std::span<const TraceSpan> spans) {
  std::string text = "{\"displayTimeUnit\": \"ms\", \"traceEvents\": [\n";
  for (std::size_t i = 0; i < spans.size(); ++i)
    fmt::format_to(std::back_inserter(text),
                   "{}{{\"name\": {}, \"ph\": \"X\", \"pid\": 1, \"tid\": 1, \"ts\": {:.3f}, \"dur\": {:.3f}}}",
                   i > 0 ? ",\n" : "", nlohmann::json(spans[i].name).dump(), 1e6 * spans[i].start,
                   1e6 * spans[i].duration);
  commit(path, text + "\n]}\n");
}

}  // namespace spindrift
