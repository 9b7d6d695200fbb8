#pragma once
/// Pictures of a 3D run: what they share, found once from the scene, and what a frame adds.

#include <optional>
#include <span>
#include <vector>

#include "io/landscape.hpp"
#include "simulation/picture_frame.hpp"
#include "simulation/scene.hpp"

namespace spindrift {

/// How a picture is to look; what is left empty is chosen so that the whole ground is seen, or the given part of it.
struct View {
  std::optional<Box<2>> part;                        ///< of the domain, as seen from above, to look at [m]
  std::optional<double> azimuth, elevation;          ///< of the camera as seen from the ground's middle [rad]
  std::optional<double> distance;                    ///< from the ground's middle [m]
  double zoom = 1;                                   ///< 2: half the distance
  std::optional<double> sun_azimuth, sun_elevation;  ///< [rad]
  int width = 1380, height = 776;                    ///< [px], even
};

/// Of the pictures that a run leaves: as wide as the scene says, 16 to 9.
View preview_view(const Scene& scene);

class Scenery {
 public:
  /// scene: around the solver's own origin (local_origin.hpp).   Pre: scene.dim == 3.   Throws Error(bad_input):
  /// numbers that describe no ground.
  Scenery(const Scene& scene, const View& view);

  /// A PNG file.   Throws Error(would_not_fit), Error(io_failed).
  std::vector<std::byte> png(const PictureFrame& frame) const;

  const Camera& camera() const { return camera_; }
  const Light& light() const { return light_; }
  /// What the picture of a frame shows; it views the frame's smoke.
  Landscape landscape(const PictureFrame& frame) const;

 private:
  void fill_ground(const Scene& scene);
  void place_camera(const Compass& compass, const View& view);

  Box<3> domain_;
  Relief ground_;  ///< bare
  std::vector<Box<3>> obstacles_;
  double spacing_ = 0;  ///< of the particles [m]
  std::optional<CoverArea> cover_;
  double opaque_smoke_ = 1;
  Camera camera_;
  Light light_;
  double middle_depth_ = 1;  ///< of the ground's middle before the camera [m]
};

}  // namespace spindrift
