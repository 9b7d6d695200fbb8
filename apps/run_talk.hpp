#pragma once
/// What a run says: to people or programs on stderr, and in log.txt of its folder.

#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.hpp"
#include "simulation/plan.hpp"
#include "simulation/run.hpp"

namespace spdlog {
class logger;
}

namespace spindrift {

/// quiet: nothing;   text: one line rewritten on a terminal, a plain line now and then elsewhere;
/// json: one JSON object a line, its "event" being "start", "warning", "progress", "end" or "error"
enum class TalkStyle { quiet, text, json };

/// Says when the next line is due.
struct Pace {
  double seconds;    ///< of wall time after which a line is due
  double share = 2;  ///< of the simulated time after which one is due
  double last_seconds = 0, last_share = 0;
  bool first = true;

  bool due(const Progress& progress);
};

class RunTalk {
 public:
  explicit RunTalk(TalkStyle style);

  void start(const Scene& scene, const Plan& plan, const std::filesystem::path& folder);
  void warn(const std::string& line);
  void progress(const Progress& progress);
  /// Something to tell once the run has ended.
  void note(const std::string& line);
  /// outcome: "done", "stopped", "unstable"
  void end(std::string_view outcome);
  void fail(const Error& error);

 private:
  void log(const std::string& line);

  TalkStyle style_;
  bool on_terminal_;
  Pace line_, log_pace_;
  Progress last_;
  std::vector<std::string> notes_;
  std::filesystem::path folder_;
  std::vector<std::string> pending_;  ///< lines for log.txt from before the folder existed
  std::shared_ptr<spdlog::logger> log_;
};

}  // namespace spindrift
