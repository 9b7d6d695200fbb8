#pragma once
/// Pictures of a scene in the x-z plane, in the manner of the paper's figures: white snow before a dark blue sky.
/// Later calls paint over earlier ones; a good order is sky, smoke, ground, boxes, cover, discs, time, scale bar.

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

/// Red, green, blue (sRGB) and opacity, each 0 to 1.
struct Colour {
  double red = 1, green = 1, blue = 1, alpha = 1;
};

namespace colours {
inline constexpr Colour snow{1, 1, 1};
inline constexpr Colour entrained{0.55, 0.58, 0.64};
inline constexpr Colour cover{0.64, 0.70, 0.80};
inline constexpr Colour ground{0.235, 0.192, 0.172};
inline constexpr Colour core_particle{0.98, 0.80, 0.20};     ///< inside the dense flow, where classes are shown
inline constexpr Colour overlap_particle{0.72, 0.38, 0.86};  ///< in the overlap of dense flow and smoke
}  // namespace colours

/// Smoke density on a grid of square cells, x fastest. Values that are negative or not finite count as none.
struct SmokeField {
  std::span<const float> density;       ///< [kg m^-3], one a cell
  Index<2> shape{};                     ///< cells along x and z
  Vec<2> origin = Vec<2>::Zero();       ///< lower left corner of the first cell [m]
  double dx = 1;                        ///< cell size [m]
  std::span<const std::uint8_t> solid;  ///< 1: the cell lies in the ground; empty: none does
};

class Picture {
 public:
  /// A window of the world, `world` [m], at least 2 x 2 pixels. Width and height in pixels are made even, as video
  /// wants them; the scale is the same along both axes, the lower left corner is exact. Throws    Error(would_not_fit):
  /// more than 16384 pixels along an axis; Error(bad_input): an empty window.
  Picture(const Box<2>& world, int width_pixels);
  ~Picture();
  Picture(const Picture&) = delete;
  Picture& operator=(const Picture&) = delete;

  int width() const;   ///< [px]
  int height() const;  ///< [px]

  void sky();

  /// All of it at once: width() x height() pixels 0xffRRGGBB, rows from above.
  void pixels(std::span<const std::uint32_t> all);

  /// Everything below the polyline `surface` [m], left to right; its ends go on level.
  void ground(std::span<const Vec<2>> surface);

  /// Something solid [m], in the ground's colour.
  void box(const Box<2>& box);

  /// The layer between the polylines `base` and `surface` [m], both left to right.
  void cover(std::span<const Vec<2>> base, std::span<const Vec<2>> surface);

  /// White blended over the picture with opacity 1 - exp(-density / opaque_density), shaded by the smoke between it and
  /// the light.   opaque_density: at which 63 % of the background are hidden [kg m^-3]
  void smoke(const SmokeField& field, double opaque_density);

  /// Discs of `radius` [m] (never less than 0.8 px) about `centres` [m], in the given order.
  /// kind: for each disc a number of `palette`, or empty: all have the first colour.
  void discs(std::span<const Vec<2>> centres, double radius, std::span<const Colour> palette,
             std::span<const std::uint8_t> kind = {});

  /// "12.35 s" in the upper left corner.
  void time(double seconds);

  /// A bar of a round length with its label, in the lower right corner.
  void scale_bar();

  /// The picture as a PNG file.   Throws Error(io_failed).
  std::vector<std::byte> png() const;

 private:
  struct Canvas;
  std::unique_ptr<Canvas> canvas_;
};

}  // namespace spindrift
