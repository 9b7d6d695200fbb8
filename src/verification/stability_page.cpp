#include <fmt/format.h>

#include <algorithm>

#include "io/commit.hpp"
#include "verification/page.hpp"
#include "verification/plot.hpp"
#include "verification/quoted.hpp"
#include "verification/stability.hpp"

namespace spindrift {
namespace {

std::string csv_of(const std::vector<TrialResult>& results) {
  const auto point = std::ranges::find_if(results, [](const TrialResult& r) { return !r.trial.parameters.empty(); });
  std::string text =
      "set,name,verdict,good,beyond,steps,rejected,slowest_step_s,shortest_dt_s,mass_error,energy_growth,fastest_m_s,"
      "pressure_iterations,reason";
  if (point != results.end())
    for (const auto& [name, value] : point->trial.parameters) text += "," + quoted(name);
  text += "\n";
  for (const TrialResult& r : results) {
    text +=
        fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}", r.trial.set, quoted(r.trial.name), name_of(r.verdict),
                    r.good() ? 1 : 0, r.trial.beyond ? 1 : 0, r.steps, r.rejected, r.seconds, r.shortest_step,
                    r.mass_error, r.energy_growth, r.fastest, r.pressure_iterations, quoted(r.reason));
    if (point != results.end())
      for (std::size_t k = 0; k < point->trial.parameters.size(); ++k)
        text += r.trial.parameters.empty() ? "," : fmt::format(",{}", r.trial.parameters[k].second);
    text += "\n";
  }
  return text;
}

std::string verdict_text(const TrialResult& r) {
  return fmt::format("{}{}", name_of(r.verdict), r.good() ? "" : " - *not as it should*");
}

/// The first sentence will do for a table.
std::string short_reason(const std::string& reason) {
  return reason.substr(0, std::min(reason.find('\n'), std::size_t{160}));
}

std::size_t count(const std::vector<TrialResult>& results, auto&& condition) {
  return static_cast<std::size_t>(std::ranges::count_if(results, condition));
}

void add_extremes(Page& page, const std::vector<TrialResult>& results) {
  page.heading(2, "The extreme set");
  std::vector<Page::Row> rows;
  for (const TrialResult& r : results) {
    if (r.trial.set == "map") continue;
    const bool ran = r.steps > 0;
    rows.push_back({r.trial.set, r.trial.name, verdict_text(r), fmt::format("{}", r.steps),
                    ran ? fmt::format("{:.1e}", r.mass_error) : "",
                    ran ? fmt::format("{:.1g} %", 100 * r.energy_growth) : "",
                    ran ? fmt::format("{:.3g}", r.fastest) : "", ran ? fmt::format("{}", r.pressure_iterations) : "",
                    short_reason(r.reason) + (r.good() || r.trial.remark.empty() ? "" : ": " + r.trial.remark)});
  }
  page.table({"set", "what is extreme", "verdict", "steps", "mass error", "energy growth", "fastest [m/s]",
              "most pressure iterations", "reason"},
             std::move(rows));
}

void add_map(Page& page, const std::vector<TrialResult>& results) {
  std::vector<TrialResult> points;
  std::ranges::copy_if(results, std::back_inserter(points), [](const TrialResult& r) { return r.trial.set == "map"; });
  if (points.empty()) return;
  page.heading(2, "The map");
  page.paragraph(fmt::format(
      "A seeded Latin hypercube of {} points over {} axes, 100 steps each of a small avalanche with everything in it. "
      "In the documented range: {} points, {} passed. Beyond it (snow lighter than the air with its smoke): {} points, "
      "{} passed, {} ended with exit code 3 and the last good state.",
      points.size(), points.front().trial.parameters.size(),
      count(points, [](const auto& r) { return !r.trial.beyond; }),
      count(points, [](const auto& r) { return !r.trial.beyond && r.verdict == Verdict::passed; }),
      count(points, [](const auto& r) { return r.trial.beyond; }),
      count(points, [](const auto& r) { return r.trial.beyond && r.verdict == Verdict::passed; }),
      count(points, [](const auto& r) { return r.trial.beyond && r.verdict == Verdict::stopped; })));
  page.picture("stability.png", "the stability map");
  Page::Row head{"point", "verdict", "reason"};
  for (const auto& [name, value] : points.front().trial.parameters) head.push_back(name);
  std::vector<Page::Row> rows;
  for (const TrialResult& r : points) {
    if (r.verdict == Verdict::passed) continue;
    Page::Row row{r.trial.name, verdict_text(r), short_reason(r.reason)};
    for (const auto& [name, value] : r.trial.parameters) row.push_back(fmt::format("{:.3g}", value));
    rows.push_back(std::move(row));
  }
  if (rows.empty()) return page.paragraph("Every point passed.");
  page.paragraph("The points that did not pass:");
  page.table(std::move(head), std::move(rows));
}

Page stability_page(const std::vector<TrialResult>& results) {
  Page page;
  page.heading(1, "Stability");
  page.paragraph(fmt::format(
      "Written by `spindrift verify --stability` of version {}. Every trial is a small scene of "
      "`configs/verification/` with settings far from the usual, run twice, the second time on one thread. It passes "
      "where every state was finite, masses and volumes were positive, the mass ledger closed to 1e-10, the mechanical "
      "energy of snow, cover, smoke and air never exceeded that of the start by more than 5 %, the air's pressure "
      "converged, no step took longer than two seconds and both runs ended in the same bits. *Refused*: the scene was "
      "not accepted, with a reason. *Stopped*: steps were rejected and halved six times, then the run ended with exit "
      "code 3 and its last good state. All numbers: [stability.csv](stability.csv).",
      SPINDRIFT_VERSION));
  page.paragraph(
      fmt::format("Of {} trials {} went as they should; largest mass error {:.1e}, steps rejected and mended {}.",
                  results.size(), count(results, [](const TrialResult& r) { return r.good(); }),
                  std::ranges::max(results, {}, &TrialResult::mass_error).mass_error, [&] {
                    std::uint64_t n = 0;
                    for (const TrialResult& r : results) n += r.rejected;
                    return n;
                  }()));
  add_map(page, results);
  add_extremes(page, results);
  return page;
}

}  // namespace

void write_stability(const std::filesystem::path& folder, const std::vector<TrialResult>& results,
                     const std::function<void(const std::string&)>& note) {
  make_folder(folder);
  commit(folder / "stability.csv", csv_of(results));
  if (const auto why = plot("stability", folder)) note(*why);
  const Page page = stability_page(results);
  commit(folder / "stability.md", page.markdown());
  commit(folder / "stability.html", page.html("Spindrift: stability", folder));
}

}  // namespace spindrift
