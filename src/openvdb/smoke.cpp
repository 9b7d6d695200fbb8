#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <sstream>

#include "io/openvdb_module.hpp"

namespace spindrift {
namespace {

std::vector<std::byte> smoke_bytes(const Lattice& lattice, std::span<const float> density,
                                   std::span<const float> velocity, double least) {
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

}  // namespace

extern "C" const OpenvdbModule spindrift_module{smoke_bytes};

}  // namespace spindrift
