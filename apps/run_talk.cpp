#include "run_talk.hpp"

#include <fmt/format.h>
#include <spdlog/sinks/basic_file_sink.h>
#include <spdlog/spdlog.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "plain_text.hpp"

namespace spindrift {
namespace {

using Json = nlohmann::ordered_json;

double fraction(const Progress& p) {
  return p.end_time > 0 ? std::clamp(p.time / p.end_time, 0.0, 1.0) : 1;
}

double seconds_left(const Progress& p) {
  return fraction(p) > 0 ? p.wall_seconds * (1 - fraction(p)) / fraction(p) : 0;
}

std::string progress_text(const Progress& p) {
  return fmt::format(
      "{:.2f} / {:g} s  {:3.0f} %  step {}  dt {:.3g} ms ({})  {} particles, {} entrained  smoke {:.3g} kg  "
      "{}, {} left",
      p.time, p.end_time, 100 * fraction(p), count_text(static_cast<double>(p.step)), 1e3 * p.dt, p.limiter,
      count_text(static_cast<double>(p.n_dense)), count_text(static_cast<double>(p.n_entrained)), p.smoke_mass,
      duration_text(p.wall_seconds), duration_text(seconds_left(p)));
}

std::string end_text(std::string_view outcome, const Progress& p) {
  return fmt::format("{}: {:.6g} of {:g} s simulated in {} steps and {}", outcome, p.time, p.end_time,
                     count_text(static_cast<double>(p.step)), duration_text(p.wall_seconds));
}

Json progress_json(std::string_view event, const Progress& p) {
  return {{"event", event},
          {"time", p.time},
          {"end_time", p.end_time},
          {"step", p.step},
          {"dt", p.dt},
          {"limiter", p.limiter},
          {"n_dense", p.n_dense},
          {"n_entrained", p.n_entrained},
          {"smoke_mass", p.smoke_mass},
          {"wall_seconds", p.wall_seconds},
          {"seconds_left", seconds_left(p)}};
}

void say(const Json& event) {
  fmt::print(stderr, "{}\n", event.dump(-1, ' ', false, Json::error_handler_t::replace));
}

}  // namespace

bool Pace::due(const Progress& progress) {
  const bool now = first || progress.wall_seconds - last_seconds >= seconds || fraction(progress) - last_share >= share;
  if (now) first = false, last_seconds = progress.wall_seconds, last_share = fraction(progress);
  return now;
}

RunTalk::RunTalk(TalkStyle style)
    : style_(style),
      on_terminal_(isatty(STDERR_FILENO) != 0),
      line_{style == TalkStyle::json ? 1.0
            : on_terminal_           ? 0.1
                                     : 5.0,
            on_terminal_ ? 2.0 : 0.1},
      log_pace_{60, 0.1} {}

void RunTalk::start(const Scene& scene, const Plan& plan, const std::filesystem::path& folder) {
  folder_ = folder;
  log(fmt::format("spindrift {}: {}, {}D, {:g} s, seed {}; about {} released and {} cover particles, {} cells",
                  SPINDRIFT_VERSION, scene.scene.name, scene.scene.dim, scene.scene.end_time, scene.scene.seed,
                  count_text(plan.n_release), count_text(plan.n_cover), count_text(plan.n_cells)));
  if (style_ == TalkStyle::json)
    say({{"event", "start"},
         {"version", SPINDRIFT_VERSION},
         {"scene", scene.scene.name},
         {"folder", folder.string()},
         {"end_time", scene.scene.end_time},
         {"n_release", static_cast<std::uint64_t>(plan.n_release)},
         {"n_cover", static_cast<std::uint64_t>(plan.n_cover)},
         {"n_cells", static_cast<std::uint64_t>(plan.n_cells)}});
}

void RunTalk::warn(const std::string& line) {
  log(line);
  if (style_ == TalkStyle::text) fmt::print(stderr, "{}\n", line);
  if (style_ == TalkStyle::json) say({{"event", "warning"}, {"message", line}});
}

void RunTalk::progress(const Progress& progress) {
  last_ = progress;
  if (log_pace_.due(progress)) log(progress_text(progress));
  if (style_ == TalkStyle::quiet || !line_.due(progress)) return;
  if (style_ == TalkStyle::json) {
    say(progress_json("progress", progress));
  } else if (on_terminal_) {
    fmt::print(stderr, "\r{}\x1b[K", progress_text(progress));
    std::fflush(stderr);
  } else {
    fmt::print(stderr, "{}\n", progress_text(progress));
  }
}

void RunTalk::note(const std::string& line) {
  log(line);
  notes_.push_back(line);
}

void RunTalk::end(std::string_view outcome) {
  const std::string text = end_text(outcome, last_);
  log(text);
  if (style_ == TalkStyle::json) {
    Json event = progress_json("end", last_);
    event["status"] = outcome;
    event["notes"] = notes_;
    say(event);
  } else if (style_ == TalkStyle::text) {
    if (on_terminal_ && !line_.first) fmt::print(stderr, "\r{}\x1b[K\n", progress_text(last_));
    fmt::print(stderr, "{}\n", text);
    for (const std::string& note : notes_) fmt::print(stderr, "{}\n", note);
  }
}

void RunTalk::fail(const Error& error) {
  log(error.what());
  if (on_terminal_ && style_ == TalkStyle::text && !line_.first) fmt::print(stderr, "\n");
  if (style_ == TalkStyle::json)
    say({{"event", "error"}, {"code", static_cast<int>(error.code())}, {"message", error.what()}});
}

/// A log that cannot be written is no reason to end a run: what cannot be missed has its own files.
void RunTalk::log(const std::string& line) {
  pending_.push_back(line);
  std::error_code error;
  if (folder_.empty() || !std::filesystem::is_directory(folder_, error)) return;
  try {
    if (!log_) {
      log_ = std::make_shared<spdlog::logger>(
          "run", std::make_shared<spdlog::sinks::basic_file_sink_st>((folder_ / "log.txt").string(), true));
      log_->set_pattern("%Y-%m-%d %H:%M:%S  %v");
      log_->flush_on(spdlog::level::info);
      log_->set_error_handler([](const std::string&) {});
    }
    for (const std::string& text : pending_) log_->info("{}", text);
  } catch (const spdlog::spdlog_ex&) {
    log_.reset();
  }
  pending_.clear();
}

}  // namespace spindrift
