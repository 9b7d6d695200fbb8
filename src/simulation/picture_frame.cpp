#include "simulation/picture_frame.hpp"

#include <fmt/format.h>

#include "core/error.hpp"
#include "io/frame_files.hpp"

namespace spindrift {
namespace {

void take_particles(PictureFrame& picture, const std::vector<StoredArray>& arrays, const std::string& file) {
  picture.layer = array_values<std::uint8_t>(arrays, "layer", file);
  picture.entrained_at = array_values<float>(arrays, "entrained_at", file);
}

void take_smoke(PictureFrame& picture, const Lattice& lattice, const std::vector<StoredArray>& arrays,
                const std::string& file) {
  picture.lattice = lattice;
  picture.smoke = array_values<float>(arrays, "density", file);
  picture.solid = array_values<std::uint8_t>(arrays, "solid", file);
}

}  // namespace

PictureFrame picture_frame(double time, const ParticleFrame* particles, const SmokeFrame* smoke) {
  PictureFrame picture;
  picture.time = time;
  if (particles) {
    picture.positions = std::get<std::vector<float>>(particles->positions.values);
    take_particles(picture, particles->arrays, "a frame");
  }
  if (smoke) take_smoke(picture, smoke->lattice, smoke->arrays, "a frame");
  return picture;
}

PictureFrame picture_frame(const StoredFile* particles, const StoredFile* smoke) {
  PictureFrame picture;
  for (const StoredFile* file : {particles, smoke}) {
    if (!file) continue;
    picture.time = frame_number(file->frame, "time", file->path);
    if (file->frame.lattice.has_value() != (file == smoke))
      throw Error(ExitCode::incompatible_file,
                  fmt::format("{}: expected {}", file->path.string(), file == smoke ? "smoke" : "particles"));
  }
  if (particles) {
    const std::string name = particles->path.string();
    picture.positions = array_values<float>(particles->frame.arrays, "Points", name);
    take_particles(picture, particles->frame.arrays, name);
    const std::size_t n = picture.layer.size();
    if (picture.positions.size() != 3 * n || picture.entrained_at.size() != n)
      throw Error(ExitCode::incompatible_file, name + ": its arrays differ in size");
  }
  if (smoke) take_smoke(picture, *smoke->frame.lattice, smoke->frame.arrays, smoke->path.string());
  return picture;
}

}  // namespace spindrift
