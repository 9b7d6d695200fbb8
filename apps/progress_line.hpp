#pragma once
/// Tells on stderr how far a run is: one line rewritten on a terminal, a plain line now and then elsewhere.

#include "simulation/run.hpp"

namespace spindrift {

class ProgressLine {
 public:
  ProgressLine();
  void show(const Progress& progress);
  void end();  ///< leaves the last line standing
  const Progress& last() const { return last_; }

 private:
  bool due(const Progress& progress) const;

  bool on_terminal_;
  bool shown_ = false;
  double shown_wall_ = 0, shown_fraction_ = 0;
  Progress last_;
};

}  // namespace spindrift
