#include "verification/study_page.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/parallel.hpp"
#include "io/commit.hpp"
#include "verification/page.hpp"
#include "verification/plot.hpp"
#include "verification/quoted.hpp"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

std::string error_text(double error) {
  return std::isfinite(error) ? fmt::format("{:.3g}", error) : "not finite";
}

std::string seconds_text(double seconds) {
  if (seconds < 0.1) return fmt::format("{:.2g} ms", 1000 * seconds);
  return fmt::format("{:.{}f} s", seconds, seconds < 10 ? 2 : 0);
}

std::string verdict(const CaseResult& result) {
  return result.passed() ? "inside" : "*outside*";
}

const Point& finest(const CaseResult& result) {
  return *result.of(result.what.series.front()).back();
}

std::string order_text(const CaseResult& result) {
  std::vector<std::string> orders;
  for (const Series& series : result.what.gated())
    if (const double order = result.order(series); std::isfinite(order)) orders.push_back(fmt::format("{:.2f}", order));
  if (orders.empty()) return "-";
  const std::string all = fmt::format("{}", fmt::join(orders, ", "));
  return result.what.least_order > 0 ? fmt::format("{} (at least {:g})", all, result.what.least_order) : all;
}

std::string cheapest_text(const CaseResult& result, double error) {
  const Point* point = result.cheapest(error);
  if (!point) return "none";
  return fmt::format("{}, {}: {}", point->series, point->level, seconds_text(point->cost.seconds));
}

std::string checks_text(const Outcome& outcome) {
  std::string text;
  for (const Check& check : outcome.checks)
    text += fmt::format("{}{} {:.3g} ({}{:g})", text.empty() ? "" : "; ", check.name, check.value,
                        check.passed() ? "at most " : "*above* ", check.limit);
  return text;
}

void add_summary(Page& page, const std::vector<CaseResult>& results) {
  std::vector<Page::Row> rows;
  for (const CaseResult& result : results) {
    const Point& point = finest(result);
    const std::string gate = std::isfinite(point.gate) ? fmt::format(" (at most {:g})", point.gate) : "";
    rows.push_back({fmt::format("`{}`", result.what.name), result.what.title, result.what.source,
                    (point.failure.empty() ? error_text(point.outcome.l2) : "failed") + gate, order_text(result),
                    verdict(result), cheapest_text(result, 0.05), cheapest_text(result, 0.01)});
  }
  page.table({"case", "what", "source", "error, finest", "order", "gates", "cheapest to 5 %", "cheapest to 1 %"},
             std::move(rows));
}

void add_limits(Page& page, const std::vector<CaseResult>& results) {
  page.heading(2, "Where Spindrift is not accurate");
  bool none = true;
  for (const CaseResult& result : results) {
    if (result.passed()) continue;
    none = false;
    page.item(fmt::format("*{}*: {} of {} is {} at the finest level{}. {}", result.what.name, "the error",
                          result.what.quantity, error_text(finest(result).outcome.l2),
                          std::isfinite(finest(result).gate) ? fmt::format(", its gate {:g}", finest(result).gate) : "",
                          result.what.remark));
  }
  if (none) page.paragraph("Every case is inside its gates.");
}

void add_case(Page& page, const CaseResult& result) {
  const Case& what = result.what;
  page.heading(3, fmt::format("{}: {}", what.name, what.title));
  page.paragraph(fmt::format("Scene `configs/{}`. Reference: {} ({}). Errors are of {}. Observed order {}; {}.",
                             what.scene, what.reference, what.source, what.quantity, order_text(result),
                             verdict(result)));
  if (!what.remark.empty()) page.paragraph(what.remark);
  page.picture(fmt::format("verification/{}.png", what.name), fmt::format("{}: error against seconds", what.name));
  std::vector<Page::Row> rows;
  for (const Series& series : what.series) {
    const auto points = result.of(series);
    for (const Point* point : points) {
      const Cost& cost = point->cost;
      const bool first = point == points.front();
      const std::string order =
          first && std::isfinite(result.order(series)) ? fmt::format("{:.2f}", result.order(series)) : "";
      if (!point->failure.empty()) {
        rows.push_back({first ? series.factor : "", first ? series.label : "", point->level, point->failure});
        rows.back().resize(11);
        continue;
      }
      rows.push_back({first ? series.factor : "", first ? series.label : "", point->level,
                      error_text(point->outcome.l2), error_text(point->outcome.max), order, seconds_text(cost.seconds),
                      fmt::format("{}", cost.steps),
                      fmt::format("{:.1f} / {:.1f}", cost.dense_iterations, cost.pressure_iterations),
                      fmt::format("{:.1f} MB", static_cast<double>(cost.bytes) / 1e6), checks_text(point->outcome)});
    }
  }
  page.table({"varied", "curve", "level", "L2 error", "max error", "order", "time", "steps",
              "iterations a step, snow / air", "memory", "checks"},
             std::move(rows));
}

Page study_page(const std::vector<CaseResult>& results) {
  Page page;
  page.heading(1, "Verification");
  page.paragraph(fmt::format(
      "Written by `spindrift verify` of version {}, on {} threads. Each case is a scene of `configs/` and a reference; "
      "every curve of its diagram varies one factor around the defaults. Errors are relative: L2(difference) / "
      "L2(reference), and the same with the maximum. The order is the slope of log(error) over log(spacing, cell or "
      "time step), by least squares over the levels. Times are of the steps alone, without output, medians of the "
      "repeats; memory is that of state and scratch. All points: [points.csv](verification/points.csv).",
      SPINDRIFT_VERSION, n_threads()));
  add_summary(page, results);
  add_limits(page, results);
  page.heading(2, "The cases");
  for (const CaseResult& result : results) add_case(page, result);
  return page;
}

}  // namespace

std::string points_csv(const std::vector<CaseResult>& results) {
  std::string text =
      "case,factor,series,level,size,error_l2,error_max,gate,inside,seconds,repeats,steps,time_step,dense_iterations,"
      "pressure_iterations,bytes,particles,cells,checks,failure\n";
  for (const CaseResult& result : results)
    for (const Point& p : result.points) {
      const Cost& c = p.cost;
      text += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", result.what.name,
                          quoted(p.factor), quoted(p.series), quoted(p.level), p.size, p.outcome.l2, p.outcome.max,
                          p.gate, p.inside() ? 1 : 0, c.seconds, c.repeats, c.steps, c.time_step, c.dense_iterations,
                          c.pressure_iterations, c.bytes, c.n_particles, c.n_cells, quoted(checks_text(p.outcome)),
                          quoted(p.failure));
    }
  return text;
}

void write_points(const fs::path& folder, const std::vector<CaseResult>& results) {
  make_folder(folder / "verification");
  commit(folder / "verification/points.csv", points_csv(results));
}

void write_study(const fs::path& folder, const std::vector<CaseResult>& results,
                 const std::function<void(const std::string&)>& note) {
  write_points(folder, results);
  if (const auto why = plot("cases", folder / "verification")) note(*why);
  const Page page = study_page(results);
  commit(folder / "verification.md", page.markdown());
  commit(folder / "verification.html", page.html("Spindrift: verification", folder));
}

}  // namespace spindrift
