#include "simulation/picture_frame.hpp"

#include <fmt/format.h>

#include <variant>

#include "core/error.hpp"
#include "io/frame_files.hpp"

namespace spindrift {
namespace {

using Origin = std::array<double, 3>;

template <class T>
std::vector<float> around(const Origin& origin, std::span<const T> positions) {
  std::vector<float> places(positions.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    places[i] = static_cast<float>(static_cast<double>(positions[i]) - origin[i % 3]);
  return places;
}

/// Points: single or double precision.
std::vector<float> around(const Origin& origin, const StoredArray& points) {
  if (const auto* far = std::get_if<std::vector<double>>(&points.values)) return around<double>(origin, *far);
  return around<float>(origin, std::get<std::vector<float>>(points.values));
}

void take_particles(PictureFrame& picture, const std::vector<StoredArray>& arrays, const std::string& file) {
  picture.layer = array_values<std::uint8_t>(arrays, "layer", file);
  picture.entrained_at = array_values<float>(arrays, "entrained_at", file);
  picture.id = array_values<std::int64_t>(arrays, "id", file);
}

void take_smoke(PictureFrame& picture, const Lattice& lattice, const std::vector<StoredArray>& arrays,
                const std::string& file, const Origin& origin) {
  picture.lattice = lattice;
  for (std::size_t k = 0; k < 3; ++k) picture.lattice.origin[k] -= origin[k];
  picture.smoke = array_values<float>(arrays, "density", file);
  picture.solid = array_values<std::uint8_t>(arrays, "solid", file);
}

}  // namespace

PictureFrame picture_frame(double time, const ParticleFrame* particles, const SmokeFrame* smoke, const Origin& origin) {
  PictureFrame picture;
  picture.time = time;
  if (particles) {
    picture.positions = around(origin, particles->positions);
    take_particles(picture, particles->arrays, "a frame");
  }
  if (smoke) take_smoke(picture, smoke->lattice, smoke->arrays, "a frame", origin);
  return picture;
}

PictureFrame picture_frame(const StoredFile* particles, const StoredFile* smoke, const Origin& origin) {
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
    picture.positions = around(origin, stored_points(particles->frame.arrays, name));
    take_particles(picture, particles->frame.arrays, name);
    const std::size_t n = picture.layer.size();
    if (picture.positions.size() != 3 * n || picture.entrained_at.size() != n || picture.id.size() != n)
      throw Error(ExitCode::incompatible_file, name + ": its arrays differ in size");
  }
  if (smoke) take_smoke(picture, *smoke->frame.lattice, smoke->frame.arrays, smoke->path.string(), origin);
  return picture;
}

}  // namespace spindrift
