#include "io/vdb.hpp"

#include <span>
#include <sstream>

#include "core/error.hpp"
#include "io/frame_files.hpp"

#ifdef SPINDRIFT_OPENVDB
#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>
#endif

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
  const Lattice& lattice = *frame.lattice;
  const bool flat = lattice.spacing[1] != lattice.spacing[0];  // two equal layers a metre apart

  openvdb::initialize();
  const auto place = openvdb::math::Transform::createLinearTransform(lattice.spacing[0]);
  place->postTranslate({lattice.origin[0], lattice.origin[1], lattice.origin[2]});
  const auto smoke = openvdb::FloatGrid::create(0.0f);
  const auto air = openvdb::Vec3SGrid::create(openvdb::Vec3s(0.0f));
  smoke->setName("density");
  smoke->setGridClass(openvdb::GRID_FOG_VOLUME);
  air->setName("velocity");
  air->setVectorType(openvdb::VEC_CONTRAVARIANT_RELATIVE);
  smoke->setTransform(place);
  air->setTransform(place);

  auto put_smoke = smoke->getAccessor();
  auto put_air = air->getAccessor();
  std::size_t n = 0;
  for (int k = 0; k < lattice.shape[2]; ++k)
    for (int j = 0; j < lattice.shape[1]; ++j)
      for (int i = 0; i < lattice.shape[0]; ++i, ++n) {
        if (!(static_cast<double>(density[n]) > least) || (flat && j > 0)) continue;
        put_smoke.setValue({i, j, k}, density[n]);
        put_air.setValue({i, j, k}, {velocity[3 * n], velocity[3 * n + 1], velocity[3 * n + 2]});
      }

  std::ostringstream stream;
  openvdb::io::Stream(stream).write(openvdb::GridCPtrVec{smoke, air});
  const std::string text = stream.str();
  const auto bytes = std::as_bytes(std::span(text));
  return {bytes.begin(), bytes.end()};
}

#endif

}  // namespace spindrift
