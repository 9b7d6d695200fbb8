#include <fmt/format.h>

#include <cmath>

#include "io/commit.hpp"
#include "verification/page.hpp"
#include "verification/plot.hpp"
#include "verification/refinement.hpp"

namespace spindrift {
namespace {

/// |value / limit - 1|, absolute where the limit is 0.
double error_of(const Reading& reading, const Limit& limit) {
  const double difference = std::abs(reading.value - limit.value);
  return limit.value != 0 ? difference / std::abs(limit.value) : difference;
}

std::string level_of(const RefinedRun& run) {
  return fmt::format("x {:.3g}", run.scale);
}

std::string csv_of(const Refinement& refinement) {
  std::string text =
      "order,quantity,factor,level,scale,value,error_l2,seconds,steps,time_step,particles,cells,failure\n";
  for (std::size_t n = 0; n < refinement.runs.size(); ++n) {
    const RefinedRun& run = refinement.runs[n];
    const Cost& cost = run.cost;
    for (std::size_t k = 0; k < run.readings.size(); ++k)
      text +=
          fmt::format("{:03},{},{},{},{},{},{},{},{},{},{},{},\n", n, run.readings[k].name, run.factor, level_of(run),
                      run.scale, run.readings[k].value, error_of(run.readings[k], refinement.limits[k]), cost.seconds,
                      cost.steps, cost.time_step, cost.n_particles, cost.n_cells);
  }
  return text;
}

Page page_of(const Refinement& refinement) {
  Page page;
  page.heading(1, fmt::format("{}: error against run time", refinement.scene.scene.name));
  page.paragraph(
      "The scene run again with its spacing, cell size, time steps and tolerances scaled, together (*all*) and one of "
      "them alone; x 0.5 is twice as fine, tolerances go with the square. Counts are of particles as large as the "
      "scene's own. The errors are relative to Richardson's limit of *all* where its three finest runs converge "
      "evenly, otherwise to the finest run, whose error then shows as 0. An avalanche is chaotic: differences between "
      "runs that do not shrink with the scale are its spread, as between seeds, not an error of the discretisation.");
  Page::Row head{"varied", "scale", "time"};
  std::vector<Page::Row> rows;
  for (const RefinedRun& run : refinement.runs) {
    Page::Row row{run.factor, level_of(run), fmt::format("{:.3g} s", run.cost.seconds)};
    if (!run.failure.empty()) row.push_back(run.failure);
    for (std::size_t k = 0; k < run.readings.size(); ++k)
      row.push_back(fmt::format("{:.5g} ({:.2g} %)", run.readings[k].value,
                                100 * error_of(run.readings[k], refinement.limits[k])));
    rows.push_back(std::move(row));
  }
  std::vector<Page::Row> limits;
  for (const RefinedRun& run : refinement.runs) {
    if (run.readings.empty()) continue;
    for (std::size_t k = 0; k < run.readings.size(); ++k) {
      const Limit& limit = refinement.limits[k];
      head.push_back(run.readings[k].name);
      limits.push_back(
          {run.readings[k].name, fmt::format("{:.5g}", limit.value),
           limit.extrapolated ? fmt::format("Richardson's limit, order {:.2f}", limit.order) : "the finest run"});
    }
    break;
  }
  for (Page::Row& row : rows) row.resize(head.size());
  page.table(std::move(head), std::move(rows));
  page.heading(2, "What the errors are relative to");
  page.table({"quantity", "reference", "which is"}, std::move(limits));
  page.picture("refinement.png", "error against seconds");
  return page;
}

}  // namespace

void write_refinement(const std::filesystem::path& folder, const Refinement& refinement,
                      const std::function<void(const std::string&)>& note) {
  make_folder(folder);
  commit(folder / "refinement.csv", csv_of(refinement));
  if (const auto why = plot("refinement", folder)) note(*why);
  const Page page = page_of(refinement);
  commit(folder / "refinement.md", page.markdown());
  commit(folder / "refinement.html", page.html(refinement.scene.scene.name, folder));
}

}  // namespace spindrift
