#include "verification/case_groups.hpp"

namespace spindrift {

std::vector<Case> slope_flow_cases() {
  return {};
}

}  // namespace spindrift
