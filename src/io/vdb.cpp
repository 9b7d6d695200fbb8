#include "io/vdb.hpp"

#include "core/error.hpp"
#include "io/frame_files.hpp"
#include "io/openvdb_module.hpp"

namespace spindrift {

#ifndef SPINDRIFT_OPENVDB

bool writes_vdb() {
  return false;
}

std::vector<std::byte> vdb_bytes(const StoredFrame&, double, const std::string&) {
  throw Error(ExitCode::bad_input,
              "this build writes no OpenVDB; install libopenvdb-dev, then configure and build again");
}

#else

bool writes_vdb() {
  return true;
}

std::vector<std::byte> vdb_bytes(const StoredFrame& frame, double least, const std::string& name) {
  if (!frame.lattice) throw Error(ExitCode::incompatible_file, name + ": expected smoke");
  const auto& density = array_values<float>(frame.arrays, "density", name);
  const auto& velocity = array_values<float>(frame.arrays, "velocity", name);
  return load_module<OpenvdbModule>(name + " as OpenVDB").smoke_bytes(*frame.lattice, density, velocity, least);
}

#endif

}  // namespace spindrift
