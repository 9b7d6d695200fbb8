#include "core/error.hpp"

namespace spindrift {

void check_failed(const char* condition, const char* file, int line) {
  throw Error(ExitCode::bug, std::string("check failed: ") + condition + " at " + file + ":" + std::to_string(line));
}

}  // namespace spindrift
