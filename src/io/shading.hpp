#pragma once
/// Colours of a landscape in its light. They are linear: twice the number is twice the light.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace spindrift {

struct Rgb {
  float red = 0, green = 0, blue = 0;

  friend Rgb operator+(Rgb a, Rgb b) { return {a.red + b.red, a.green + b.green, a.blue + b.blue}; }
  friend Rgb operator*(Rgb a, Rgb b) { return {a.red * b.red, a.green * b.green, a.blue * b.blue}; }
  friend Rgb operator*(float s, Rgb a) { return {s * a.red, s * a.green, s * a.blue}; }
};

inline Rgb mix(Rgb a, Rgb b, float share_of_b) {
  return (1 - share_of_b) * a + share_of_b * b;
}

namespace lights {
inline constexpr Rgb sun{1.30f, 1.20f, 1.03f};  ///< on a surface that faces it
inline constexpr Rgb sky{0.40f, 0.52f, 0.76f};  ///< on a surface that sees all of the sky
}  // namespace lights

/// Share of the light that comes back from each.
namespace albedos {
inline constexpr Rgb snow{0.54f, 0.58f, 0.64f};
inline constexpr Rgb bare{0.105f, 0.086f, 0.072f};
inline constexpr Rgb released{0.80f, 0.88f, 0.98f};
inline constexpr Rgb entrained{0.58f, 0.61f, 0.66f};
inline constexpr Rgb box{0.36f, 0.27f, 0.21f};
inline constexpr Rgb smoke{0.94f, 0.96f, 0.99f};
}  // namespace albedos

/// The sky behind everything: `share` of the way from the picture's upper to its lower edge.
inline Rgb sky_at(float share) {
  return mix({0.0061f, 0.0185f, 0.092f}, {0.042f, 0.118f, 0.32f}, share);
}

/// Light as a colour on screens, 0xffRRGGBB: bright light is held back so that it keeps its shades, then the curve of
/// sRGB.
class Film8 {
 public:
  Film8() {
    for (std::size_t i = 0; i < curve_.size(); ++i) {
      const double c = static_cast<double>(i) / static_cast<double>(curve_.size() - 1);
      const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
      curve_[i] = static_cast<std::uint8_t>(std::lround(255 * s));
    }
  }
  std::uint32_t operator()(Rgb light) const {
    return 0xff000000u | std::uint32_t{tone(light.red)} << 16 | std::uint32_t{tone(light.green)} << 8 |
           tone(light.blue);
  }

 private:
  std::uint8_t tone(float light) const {
    constexpr float knee = 0.6f;  // up to it, light is as it is; beyond it nears 1
    const float held = light <= knee ? std::max(light, 0.0f) : 1 - (1 - knee) * std::exp((knee - light) / (1 - knee));
    return curve_[static_cast<std::size_t>(held * static_cast<float>(curve_.size() - 1) + 0.5f)];
  }
  std::array<std::uint8_t, 4096> curve_;
};

}  // namespace spindrift
