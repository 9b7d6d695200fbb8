#pragma once
/// Shadows of the solid things of a landscape: how near to the sun the nearest thing is, on a raster across its light.

#include <vector>

#include "io/landscape.hpp"

namespace spindrift {

class SunMap {
 public:
  /// surface: of the landscape's ground, or null.
  SunMap(const Landscape& landscape, const ReliefSurface* surface, const Light& light);

  /// Share of the sun that nothing solid keeps from x, on a surface with the unit normal `normal`: soft over about a
  /// cell of the raster.
  float lit(const Vec<3>& x, const Vec<3>& normal) const;

  double cell() const { return cell_; }  ///< edge of a cell of the raster [m]

 private:
  Vec<3> sun_, across_, along_;     ///< unit, orthogonal
  Vec<2> lower_ = Vec<2>::Zero();   ///< across and along [m]
  double farthest_ = 0, cell_ = 1;  ///< [m]
  int width_ = 0, height_ = 0;      ///< cells
  std::vector<float> nearness_;     ///< towards the sun [m], 0: nothing
};

}  // namespace spindrift
