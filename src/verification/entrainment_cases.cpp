#include "verification/case_groups.hpp"

namespace spindrift {

std::vector<Case> entrainment_cases() {
  return {};
}

}  // namespace spindrift
