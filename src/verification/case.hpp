#pragma once
/// A verification case: a scene file, what is varied in it, and what its result is compared with.

#include <algorithm>
#include <functional>
#include <limits>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "simulation/simulation.hpp"

namespace spindrift {

/// One more number of a run that has to stay within a limit.
struct Check {
  std::string name;  ///< with the unit
  double value = 0, limit = 0;
  bool passed() const { return value <= limit; }
};

/// How far a run is from its reference.
struct Outcome {
  double l2 = 0;   ///< L2(difference) / L2(reference)
  double max = 0;  ///< max |difference| / max |reference|
  std::vector<Check> checks;
};

/// The errors of a field against its reference, value by value; absolute where the reference is 0.
class ErrorNorms {
 public:
  /// weight: of the value in L2, as its volume
  void add(double value, double reference, double weight = 1);
  double l2() const;
  double max() const;

 private:
  double difference_squared_ = 0, reference_squared_ = 0, difference_max_ = 0, reference_max_ = 0;
};

/// How a case looks at its simulation. What it does is not part of the run time.
template <int Dim>
struct Comparison {
  std::function<void(const Simulation<Dim>&)> after_step;  ///< may be empty
  std::function<Outcome(const Simulation<Dim>&)> outcome;  ///< at the end
};

/// Made for every run, from the simulation before its first step.
template <int Dim>
using Compare = std::function<Comparison<Dim>(const Simulation<Dim>& start)>;

/// One choice of the number that a series varies.
struct Level {
  std::string label;
  std::vector<std::string> settings;                      ///< "key=value", over those of the series
  double size = 0;                                        ///< spacing, cell or time step, for the order; 0: it has none
  double gate = std::numeric_limits<double>::infinity();  ///< largest L2 error that is right
};

/// Runs that make one curve of the work-precision diagram.
struct Series {
  std::string factor;                 ///< what tells it from the default: "resolution", "scheme", "tolerance", ...
  std::string label;                  ///< of the curve
  std::vector<std::string> settings;  ///< "key=value", over those of the scene file
  std::vector<Level> levels;          ///< the coarsest first
};

struct Case {
  std::string name;       ///< on the command line
  std::string title;      ///< one line
  std::string reference;  ///< what the result is held against, formula and all
  std::string source;     ///< of the reference
  std::string quantity;   ///< of which the errors are
  std::string scene;      ///< file under configs/
  /// The first is the default: its levels refine, and carry the gates.
  std::vector<Series> series;
  double least_order = 0;   ///< observed order of the default series that is right; 0: none is asked for
  std::size_t n_gated = 1;  ///< the first so many series must have that order, and be inside what gates they have
  bool quick = false;       ///< one of those of the quick form
  std::string remark;  ///< what the numbers mean, where the reference does not hold, what is left out; may be empty
  std::variant<Compare<2>, Compare<3>> compare;

  std::span<const Series> gated() const { return {series.data(), std::min(n_gated, series.size())}; }
};

/// The default series with more settings: one more curve over the same levels. Its levels have no gates.
Series with_settings(const Series& base, std::string factor, std::string label,
                     const std::vector<std::string>& settings);

/// The first `n` levels of a series alone.
Series first_levels(Series series, std::size_t n);

/// A curve at one resolution, the level of `base` with that number, over the values of one key.
Series over_values(const Series& base, std::size_t level, std::string factor, std::string key,
                   const std::vector<std::string>& values);

/// A curve of a kernel over its support radius in particle spacings, at the spacing of the level of `base` with that
/// number, which is its size [m].
Series over_supports(const Series& base, std::size_t level, std::string factor, std::string kernel,
                     const std::vector<double>& ratios);

}  // namespace spindrift
