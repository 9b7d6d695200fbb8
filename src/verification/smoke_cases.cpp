#include "verification/case_groups.hpp"

namespace spindrift {

std::vector<Case> smoke_cases() {
  return {};
}

}  // namespace spindrift
