#pragma once
/// The way that an avalanche takes down its mountain, along which its front is measured.

#include <array>
#include <vector>

#include "core/vec.hpp"
#include "terrain/height_field.hpp"

namespace spindrift {

/// A line of straight pieces seen from above, laid on the ground. It goes on straight beyond both of its ends, as far
/// as the domain does.
class AvalanchePath {
 public:
  /// points  of the line (x, y), downhill [m];  ground  under it, followed in steps of its cells or less;
  /// domain  seen from above.   Pre: two points or more, in the domain, each other than the one before.
  AvalanchePath(const std::vector<std::array<double, 2>>& points, const HeightField& ground, const Box<2>& domain);

  /// Way on the ground from the first point to that point of the line which is, seen from above, nearest to `place`:
  /// negative before the first point [m].
  double along(const Vec<2>& place) const;

  /// Of the given line on the ground [m].
  double length() const { return length_; }

 private:
  struct Piece {
    Vec<2> start, direction;  ///< direction: a unit vector
    double length;            ///< on the level [m]
    std::vector<double> way;  ///< on the ground, at equal steps from its start to its end [m]
  };
  std::vector<Piece> pieces_;
  double length_ = 0;
};

}  // namespace spindrift
