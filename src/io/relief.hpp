#pragma once
/// The ground of a picture: heights on a square grid, which whoever draws fills in.

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

/// Heights at the points of a grid, x fastest. Where a height is not finite there is no ground.
struct Relief {
  Index<2> shape{};                ///< points along x and y, at least 2 x 2; none: there is no ground
  Vec<2> origin = Vec<2>::Zero();  ///< of the first point [m]
  double spacing = 1;              ///< [m]
  std::vector<float> height;       ///< z of the surface, snow and all [m]
  std::vector<float> snow;         ///< depth of the snow cover, normal to the ground [m]; empty: none anywhere
  Box<2> shown;                    ///< beyond it the ground fades away towards the grid's rim

  bool empty() const { return shape[0] < 2 || shape[1] < 2; }
  Vec<2> place(const Index<2>& i) const { return origin + spacing * Vec<2>(i[0], i[1]); }
};

/// What the light needs to know of a relief, at any place.
class ReliefSurface {
 public:
  struct Point {
    float slope_x, slope_y;  ///< dz/dx, dz/dy
    float snow;              ///< [m]
    float shown;             ///< 1 within Relief::shown, 0 at the grid's rim
  };

  /// Pre: relief is not empty, and lives as long as this.
  explicit ReliefSurface(const Relief& relief);

  /// Between the grid's points by the values around, beyond the grid as at its rim.
  Point at(double x, double y) const;

  const Relief& relief() const { return relief_; }
  Vec<3> position(const Index<2>& i) const {
    const Vec<2> place = relief_.place(i);
    return {place[0], place[1], static_cast<double>(relief_.height[flat<2>(i, relief_.shape)])};
  }

 private:
  const Relief& relief_;
  std::vector<Point> points_;
};

}  // namespace spindrift
