#pragma once
/// What pictures show of a frame, the simulation's own or one read back: views of its arrays, in three dimensions.
/// Places are around the solver's own origin (local_origin.hpp), where single precision has digits enough.

#include <array>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

#include "io/vtkhdf.hpp"
#include "simulation/frame.hpp"

namespace spindrift {

struct PictureFrame {
  double time = 0;                      ///< [s]
  std::vector<float> positions;         ///< x, y, z of every particle [m]; empty: no snow
  std::span<const std::uint8_t> layer;  ///< 0 dense flow, 1 cover, one a particle
  std::span<const float> entrained_at;  ///< [s], -1: released, one a particle
  std::span<const std::int64_t> id;     ///< one a particle
  Lattice lattice;                      ///< of the smoke
  std::span<const float> smoke;         ///< density [kg m^-3], one a point of the lattice; empty: no smoke
  std::span<const std::uint8_t> solid;  ///< 1: in the ground, one a point
};

/// Of frames of a 3D simulation; either may be null.   origin: Scene::origin of the solver's scene
PictureFrame picture_frame(double time, const ParticleFrame* particles, const SmokeFrame* smoke,
                           const std::array<double, 3>& origin);

/// Of frames that were read back, where they come from for messages; either may be null.
/// Throws    Error(incompatible_file): arrays are missing, of another type or of another size than runs write.
struct StoredFile {
  const StoredFrame& frame;
  std::filesystem::path path;
};
PictureFrame picture_frame(const StoredFile* particles, const StoredFile* smoke, const std::array<double, 3>& origin);

}  // namespace spindrift
