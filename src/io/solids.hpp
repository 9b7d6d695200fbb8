#pragma once
/// The solid things of a landscape as they stand in a picture: as a camera sees them, or as the sun does.

#include <functional>
#include <vector>

#include "io/depth_band.hpp"
#include "io/landscape.hpp"

namespace spindrift {

/// How positions get into a picture.
struct Projection {
  std::function<ScreenPoint(const Vec<3>&)> point;
  std::function<ScreenBall(const Vec<3>&)> ball;  ///< of the flow's particles
};

class Solids {
 public:
  /// Pre: `surface`, where there is ground, and `landscape` live as long as this.
  Solids(const Landscape& landscape, const ReliefSurface* surface, const Projection& projection, int height);

  /// Draws what reaches into the band, under the numbers below.
  void draw(DepthBand& band) const;

  static constexpr std::int32_t ground = 0;
  static constexpr std::int32_t first_face = 1;  ///< six a box: lower and upper along x, y, z
  std::int32_t first_ball() const { return first_face + 6 * static_cast<std::int32_t>(landscape_.boxes.size()); }

 private:
  struct Rows {
    float first, last;  ///< [px]
  };
  void draw_ground(DepthBand& band) const;
  void draw_boxes(DepthBand& band) const;

  const Landscape& landscape_;
  Index<2> shape_{};                  ///< of the ground's grid
  std::vector<ScreenPoint> points_;   ///< of the ground; nearness 0 where there is none
  std::vector<Rows> rows_;            ///< of the picture that each row of squares reaches over
  std::vector<ScreenPoint> corners_;  ///< eight a box
  std::vector<ScreenBall> balls_;
  std::vector<std::uint32_t> sorted_, first_;  ///< balls by the stripe of the picture that they begin in
  float most_radius_ = 0;                      ///< [px]
};

}  // namespace spindrift
