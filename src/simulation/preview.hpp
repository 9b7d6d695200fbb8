#pragma once
/// Pictures of a 2D simulation, like the paper's figures (Sec. 5.1).

#include <memory>

#include "io/picture.hpp"
#include "simulation/picture_frame.hpp"
#include "simulation/simulation.hpp"

namespace spindrift {

/// What a picture shows, copied from the simulation, so that it can be drawn elsewhere while the simulation goes on.
struct PreviewFrame {
  Box<2> world;
  int width = 1380;            ///< [px]
  double time = 0;             ///< [s]
  std::vector<Vec<2>> ground;  ///< the terrain's surface, left to right; may be empty
  std::vector<Box<2>> obstacles;
  std::vector<Vec<2>> cover_base, cover_top;  ///< may be empty
  std::vector<Vec<2>> snow;                   ///< centres of the dense flow's particles, by id
  std::vector<std::uint8_t> snow_kind;        ///< 0 released, 1 entrained
  double snow_radius = 0;                     ///< [m]
  std::vector<float> smoke;                   ///< [kg m^-3]; may be empty
  std::vector<std::uint8_t> solid;
  Index<2> smoke_shape{};
  Vec<2> smoke_lower = Vec<2>::Zero();  ///< lower corner of its grid [m]
  double dx = 1;
  double opaque_smoke = 1;  ///< [kg m^-3]: hides 63 % of what is behind it

  std::vector<std::byte> png() const;
};

PreviewFrame preview_frame(const Simulation<2>& simulation);

/// The same of a frame that was read back, to the digits that it holds.
PreviewFrame preview_frame(const Scene& scene, const Walls<2>& walls, const PictureFrame& stored);

}  // namespace spindrift
