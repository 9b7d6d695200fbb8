#pragma once
/// How tables and point clouds call the components of an array.

#include <string>

namespace spindrift {

/// "velocity", 3 components, number 1 -> "velocity_y"; two components are x and z; without a name "y".
inline std::string component_name(const std::string& name, int components, int number) {
  if (components == 1) return name;
  const std::string axis = components == 2   ? std::string(1, "xz"[number])
                           : components == 3 ? std::string(1, "xyz"[number])
                                             : std::to_string(number);
  return name.empty() ? axis : name + "_" + axis;
}

}  // namespace spindrift
