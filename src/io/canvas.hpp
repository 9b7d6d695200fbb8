#pragma once
/// The surface that a Picture paints on, and its pixels. Only the picture's own files include this.

#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "io/picture.hpp"

namespace spindrift {

struct Picture::Canvas {
  cairo_surface_t* surface;
  cairo_t* context;
  int width, height;  // [px]
  double pixels_per_metre;
  Vec<2> lower_left;  // [m]

  Canvas(const Box<2>& world, int width_pixels);
  ~Canvas();
  Canvas(const Canvas&) = delete;
  Canvas& operator=(const Canvas&) = delete;

  /// From the world [m] to the picture [px], whose y points down.
  Vec<2> to_pixels(const Vec<2>& x) const {
    return {(x[0] - lower_left[0]) * pixels_per_metre, height - (x[1] - lower_left[1]) * pixels_per_metre};
  }

  /// The pixels themselves, 0xffRRGGBB, while nothing else paints.
  class Pixels {
   public:
    explicit Pixels(cairo_surface_t* surface) : surface_(surface) {
      cairo_surface_flush(surface);
      data_ = cairo_image_surface_get_data(surface);
      stride_ = cairo_image_surface_get_stride(surface);
    }
    ~Pixels() { cairo_surface_mark_dirty(surface_); }
    Pixels(const Pixels&) = delete;
    Pixels& operator=(const Pixels&) = delete;

    std::uint32_t* row(int y) { return reinterpret_cast<std::uint32_t*>(data_ + std::ptrdiff_t{y} * stride_); }

   private:
    cairo_surface_t* surface_;
    unsigned char* data_;
    int stride_;
  };
};

/// pixel becomes pixel (1 - alpha) + (red, green, blue) alpha; colours 0 to 255, alpha 0 to 1.
inline void blend(std::uint32_t& pixel, float red, float green, float blue, float alpha) {
  const auto mix = [alpha](std::uint32_t below, float above) {
    const float b = static_cast<float>(below);
    return static_cast<std::uint32_t>(b + (above - b) * alpha + 0.5f);
  };
  pixel = 0xff000000u | mix((pixel >> 16) & 0xff, red) << 16 | mix((pixel >> 8) & 0xff, green) << 8 |
          mix(pixel & 0xff, blue);
}

}  // namespace spindrift
