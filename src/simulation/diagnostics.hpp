#pragma once
/// The table of steps, diagnostics.csv: one row a step, its last column the name of the limit that ruled dt (written by
/// Recorder).

#include <string>
#include <string_view>
#include <vector>

#include "simulation/instruments.hpp"

namespace spindrift {

struct Diagnostic {
  std::string_view name;  ///< with the unit
  int axis;               ///< of a momentum's component; -1: a scalar
  double value;
};

/// The last step's numbers, always the same columns in the same order. Momenta are in kg m/s.
template <int Dim>
std::vector<Diagnostic> diagnostics(const Simulation<Dim>& simulation, const Instruments<Dim>& instruments);

/// The column's heading: the name, a momentum's with its axis.
template <int Dim>
std::string heading(const Diagnostic& diagnostic);

}  // namespace spindrift
