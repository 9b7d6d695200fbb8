#pragma once
/// The state of a simulation between two steps, as a copy to go back to.

#include <cstdint>
#include <optional>
#include <vector>

#include "grid/suspension.hpp"
#include "simulation/ledger.hpp"
#include "sph/cover.hpp"

namespace spindrift {

/// How far the time step is cut back, because steps failed.
struct BackOff {
  int halvings = 0;    ///< of the time step, in force
  int n_good = 0;      ///< steps since they last changed
  int n_rejected = 0;  ///< trials of the coming step that failed
  std::uint64_t n_rejected_in_all = 0;

  double factor() const { return 1.0 / (1 << halvings); }
  void count_good_step();
  void count_rejection();
};

/// All that steers the steps to come, and what tells of the last one. Terrain, obstacles and options never change; the
/// cover, and with it the ground of the air, only where it is entrained or laid.
template <int Dim>
struct SavedState {
  double time = 0;  ///< [s]
  std::uint64_t n_steps = 0;
  BackOff back_off;
  MassLedger masses;
  StepReport<Dim> report;
  Particles<Dim> dense;
  std::vector<std::uint8_t> overlap;
  std::optional<Cover<Dim>> cover;
  std::optional<SuspensionState<Dim>> suspension;

  std::size_t bytes() const {
    return dense.bytes() + spindrift::bytes(overlap) + (cover ? cover->bytes() : 0) +
           (suspension ? suspension->bytes() : 0);
  }
};

}  // namespace spindrift
