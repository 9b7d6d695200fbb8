#pragma once
/// Refining a scene of the user's: how far its results are from those of finer runs, and what those cost.

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulation/scene.hpp"
#include "verification/study.hpp"

namespace spindrift {

/// What people read off a run.
struct Reading {
  std::string name;  ///< with the unit
  double value = 0;
};

/// One run of the scene with some of its numbers scaled.
struct RefinedRun {
  std::string factor;  ///< "all" | "spacing" | "cell" | "time step" | "tolerances"
  double scale = 1;    ///< of the factor's numbers; below 1: finer
  Cost cost;
  std::vector<Reading> readings;  ///< of its end
  std::string failure;            ///< why there are none; empty: there are
};

/// What the errors of one reading are relative to.
struct Limit {
  double value = 0;
  double order = 0;           ///< observed, of the three finest runs of "all"; NaN: they do not converge evenly
  bool extrapolated = false;  ///< Richardson's; else the value of the finest run
};

struct Refinement {
  Scene scene;
  std::vector<RefinedRun> runs;  ///< factor after factor, the coarsest first; "all" is the first factor
  std::vector<Limit> limits;     ///< of each reading
};

/// The scene with spacing, cell size, time steps (CFL numbers and longest step) and tolerances scaled, together or one
/// of them. Tolerances go with the square of the scale, as an error of second order does. What the scene does not have
/// stays away.
Scene scaled(const Scene& scene, std::string_view factor, double scale);

/// The runs that a scene calls for: factors that it has, each at its scales. quick: no run finer than the scene's own.
std::vector<RefinedRun> planned_runs(const Scene& scene, bool quick);

/// Limit of values at the scales s, coarsest first: f = f_0 + C s^p through the last three, where p is in [0.5, 4].
/// Pre: scales with a fixed ratio, one value at least.
Limit limit_of(const std::vector<double>& scales, const std::vector<double>& values);

/// Runs them all. A run that fails becomes one with its reason.   runs: as planned_runs gives them for the scene.
Refinement refine(const Scene& scene, std::vector<RefinedRun> runs,
                  const std::function<void(const RefinedRun&)>& on_run);

/// Writes folder/refinement.{csv,md,html,png}.   Throws Error(io_failed).
void write_refinement(const std::filesystem::path& folder, const Refinement& refinement,
                      const std::function<void(const std::string&)>& note);

}  // namespace spindrift
