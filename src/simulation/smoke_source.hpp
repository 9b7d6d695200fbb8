#pragma once
/// Smoke that keeps coming as long as a run lasts.

#include "grid/suspension.hpp"

namespace spindrift {

/// It appears with the velocity of the air around it: it changes none, and brings momentum as it brings mass.
template <int Dim>
class SmokeSource {
 public:
  /// rate: of each cell [kg s^-1]
  explicit SmokeSource(const Field<Dim>& rate);

  /// What comes within dt [s]; valid until the next call.
  const GridSources<Dim>& over(double dt, const Suspension<Dim>& air);
  double total_rate() const { return total_rate_; }  ///< [kg s^-1]
  std::size_t bytes() const;

 private:
  GridSources<Dim> rate_;  ///< of cells, and of their faces half of each neighbour's [kg s^-1]
  GridSources<Dim> now_;
  double total_rate_ = 0;
};

}  // namespace spindrift
