#pragma once
/// Times of a program's parts in the trace-event format that chrome://tracing and ui.perfetto.dev open.

#include <filesystem>
#include <span>
#include <string_view>

namespace spindrift {

struct TraceSpan {
  std::string_view name;
  double start = 0, duration = 0;  ///< [s]
};

/// Throws Error(io_failed).
void write_chrome_trace(const std::filesystem::path& path, std::span<const TraceSpan> spans);

}  // namespace spindrift
