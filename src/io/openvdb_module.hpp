#pragma once
/// What the module of src/openvdb does for vdb_bytes.

#include <cstddef>
#include <span>
#include <vector>

#include "io/module.hpp"
#include "io/vtkhdf.hpp"

namespace spindrift {

struct OpenvdbModule {
  static constexpr const char* file = "spindrift_openvdb.so";

  /// density     n_points  [kg m^-3]
  /// velocity    n_points x 3  [m s^-1]
  std::vector<std::byte> (*smoke_bytes)(const Lattice& lattice, std::span<const float> density,
                                        std::span<const float> velocity, double least);
};

}  // namespace spindrift
