#pragma once
/// Running verification cases: every level of every series, with its errors and its cost.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "verification/case.hpp"

namespace spindrift {

/// What a run took. No output is written meanwhile.
struct Cost {
  double seconds = 0;  ///< of the steps alone, median of the repeats
  int repeats = 0;
  std::uint64_t steps = 0;
  double time_step = 0;            ///< mean [s]
  double dense_iterations = 0;     ///< of the dense flow's pressure, a step
  double pressure_iterations = 0;  ///< of the air's pressure, a step
  std::size_t bytes = 0;           ///< of state and scratch at the end
  std::size_t n_particles = 0, n_cells = 0;
};

/// One run of a case.
struct Point {
  std::string factor, series, level;
  double size = 0, gate = 0;
  Outcome outcome;
  Cost cost;
  std::string failure;  ///< why there is no outcome; empty: there is one
  bool inside() const;  ///< its gate and its checks
};

struct CaseResult {
  Case what;
  std::vector<Point> points;  ///< series after series, as in the case

  std::vector<const Point*> of(const Series& series) const;
  /// Slope of log(error) over log(size) of a series, by least squares; NaN: fewer than two sizes or no error.
  double order(const Series& series) const;
  /// The default series is inside its gates and its order.
  bool passed() const;
  /// Fewest seconds of all points with at most that error, of the series that compute the same case otherwise; null:
  /// none reaches it.
  const Point* cheapest(double l2) const;
};

struct StudyOptions {
  bool quick = false;    ///< two levels of the gated series, one repeat
  int repeats = 3;       ///< of runs shorter than `long_run`; longer ones are run once
  double long_run = 10;  ///< [s]
  std::function<void(const Case&, const Point&)> on_point;  ///< after every run; may be empty
};

/// Runs a scene to its end. Throws Error as Simulation does.
template <int Dim>
Cost run_timed(Simulation<Dim>& simulation, const std::function<void(const Simulation<Dim>&)>& after_step);

/// A run that fails becomes a point with its reason.
CaseResult run_case(const Case& what, const StudyOptions& options);

/// The scene of a case with the settings of a series and a level.
Scene scene_of(const Case& what, const Series& series, const Level& level);

}  // namespace spindrift
