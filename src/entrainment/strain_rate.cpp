#include "entrainment/strain_rate.hpp"

#include <algorithm>
#include <cmath>

namespace spindrift {

double cover_viscosity(double density) {
  return 8.5e6 * std::exp(0.021 * density);
}

double strain_rate(double overburden, double g_tangential, double viscosity, double friction_traction,
                   double friction_factor) {
  return (overburden * g_tangential + friction_factor * friction_traction) / viscosity;
}

double failure_strain_rate(const FailureThreshold& threshold, double depth, double thickness) {
  if (!(thickness > 0)) return threshold.surface;
  const double relative_depth = std::clamp(depth / thickness, 0.0, 1.0);
  return threshold.surface * std::pow(threshold.base / threshold.surface, relative_depth);
}

}  // namespace spindrift
