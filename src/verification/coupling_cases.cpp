#include "verification/case_groups.hpp"

namespace spindrift {

std::vector<Case> coupling_cases() {
  return {};
}

}  // namespace spindrift
