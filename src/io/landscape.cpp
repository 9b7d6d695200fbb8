#include "io/landscape.hpp"

#include <limits>
#include <optional>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "io/shading.hpp"
#include "io/solids.hpp"
#include "io/sun_map.hpp"

namespace spindrift {
namespace {

constexpr int band_rows = 8;        // of the picture, a task
constexpr int samples = 2;          // of the solid things along a side of each pixel
constexpr float least_ball = 0.8f;  // radius [px]
constexpr double infinity = std::numeric_limits<double>::infinity();

Projection projection_of(const Camera& camera, double radius) {
  Projection projection;
  // In samples, of which a pixel has `samples` along each side; what is nearer than a thousandth of a metre is behind.
  projection.point = [camera](const Vec<3>& x) {
    const Camera::Seen seen = camera.project(x);
    if (!(seen.depth > 1e-3)) return ScreenPoint{0, 0, 0};
    return ScreenPoint{static_cast<float>(samples * seen.x), static_cast<float>(samples * seen.y),
                       static_cast<float>(1 / seen.depth)};
  };
  projection.ball = [camera, radius](const Vec<3>& x) {
    const Camera::Seen seen = camera.project(x);
    if (!(seen.depth > 1.01 * radius + 1e-3)) return ScreenBall{0, 0, 0, 0, 0};
    const float r = std::max(static_cast<float>(camera.focal * radius / seen.depth), least_ball);
    return ScreenBall{static_cast<float>(samples * seen.x), static_cast<float>(samples * seen.y), samples * r,
                      static_cast<float>(1 / seen.depth),
                      static_cast<float>(1 / (seen.depth - radius) - 1 / seen.depth)};
  };
  return projection;
}

/// Where along its half cells a pixel's ray is sampled: neighbours differ, so that no bands are seen; the same in every
/// frame. (Interleaved gradient noise, J. Jimenez 2014.)
double jitter_of(int x, int y) {
  const double s = 0.06711056 * x + 0.00583715 * y;
  const double t = 52.9829189 * (s - std::floor(s));
  return t - std::floor(t);
}

/// The largest of 1, 2 and 5 times a power of ten under `most`.
double round_under(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  return most >= 5 * decade ? 5 * decade : most >= 2 * decade ? 2 * decade : decade;
}

class Drawer {
 public:
  Drawer(const Landscape& landscape, const Camera& camera, const Light& light)
      : landscape_(landscape),
        camera_(camera),
        light_(light),
        smoke_(landscape.smoke.density.empty() ? SmokeVolume()
                                               : SmokeVolume(landscape.smoke, landscape.opaque_smoke, light)) {
    if (!landscape.ground.empty()) surface_.emplace(landscape.ground);
    const ReliefSurface* const surface = surface_ ? &*surface_ : nullptr;
    sun_map_.emplace(landscape, surface, light);
    solids_.emplace(landscape, surface, projection_of(camera, landscape.snow_radius), samples * camera.height);
    if (surface_) contour_interval_ = round_under(std::max(rise() / 8, 1e-3));
  }

  std::vector<std::uint32_t> pixels() const {
    const std::size_t width = static_cast<std::size_t>(camera_.width);
    std::vector<std::uint32_t> pixels(width * static_cast<std::size_t>(camera_.height));
    const auto draw = [&](std::size_t b) {
      const int first = static_cast<int>(b) * band_rows, n = std::min(band_rows, camera_.height - first);
      DepthBand band;
      band.clear(samples * camera_.width, samples * first, samples * n);
      solids_->draw(band);
      for (int y = first; y < first + n; ++y)
        for (int x = 0; x < camera_.width; ++x)
          pixels[static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)] = film_(pixel(band, x, y));
    };
    parallel_for(static_cast<std::size_t>((camera_.height + band_rows - 1) / band_rows), draw, 1);
    return pixels;
  }

 private:
  /// From the lowest to the highest of the ground that is shown [m].
  double rise() const {
    double least = infinity, most = -infinity;
    for_each_index<2>(landscape_.ground.shape, [&](const Index<2>& i) {
      const Vec<3> x = surface_->position(i);
      const Box<2>& shown = landscape_.ground.shown;
      if (!x.allFinite() || !shown.contains(x.head<2>())) return;
      least = std::min(least, x.dot(light_.up));
      most = std::max(most, x.dot(light_.up));
    });
    return most - least;
  }

  /// The solid things of a pixel's samples, each behind the smoke that lies before it.
  Rgb pixel(const DepthBand& band, int x, int y) const {
    struct Sample {
      double depth;
      Rgb light;
    };
    std::array<Sample, samples * samples> all;
    for (int k = 0; k < samples * samples; ++k)
      all[static_cast<std::size_t>(k)] = {depth(band, x, y, k), sample(band, x, y, k)};
    if (!smoke_.empty())
      std::sort(all.begin(), all.end(), [](const Sample& a, const Sample& b) { return a.depth < b.depth; });
    const Vec<3> ray = camera_.ray(x + 0.5, y + 0.5);
    const double jitter = jitter_of(x, y);
    SmokeVolume::Seen seen;
    double from = 0;
    Rgb sum;
    for (const Sample& one : all) {
      if (one.depth > from) smoke_.pass(seen, camera_.eye, ray, from, one.depth, jitter);
      from = one.depth;
      sum = sum + seen.clear * one.light + albedos::smoke * (0.85f * seen.sun * lights::sun + seen.sky * lights::sky);
    }
    return (1.0f / (samples * samples)) * sum;
  }

  double depth(const DepthBand& band, int x, int y, int k) const {
    const float nearness = band.nearness(samples * x + k % samples, samples * y + k / samples);
    return nearness > 0 ? 1 / static_cast<double>(nearness) : infinity;
  }

  /// Light from the solid thing, or the sky, that a sample shows.
  Rgb sample(const DepthBand& band, int x, int y, int k) const {
    const int column = samples * x + k % samples, row = samples * y + k / samples;
    const Rgb sky = sky_at((static_cast<float>(y) + 0.5f) / static_cast<float>(camera_.height));
    const std::int32_t what = band.what(column, row);
    if (what == DepthBand::nothing) return sky;
    const double depth = 1 / static_cast<double>(band.nearness(column, row));
    const Vec<3> place = camera_.eye + depth * camera_.ray((column + 0.5) / samples, (row + 0.5) / samples);
    if (what == Solids::ground) return ground(place, depth, sky);
    if (what < solids_->first_ball()) return face(place, what - Solids::first_face);
    return ball(place, static_cast<std::size_t>(what - solids_->first_ball()));
  }

  Rgb ground(const Vec<3>& x, double depth, Rgb sky) const {
    const ReliefSurface::Point point = surface_->at(x[0], x[1]);
    const Vec<3> normal =
        Vec<3>(-static_cast<double>(point.slope_x), -static_cast<double>(point.slope_y), 1).normalized();
    constexpr float white_from = 0.12f;  // of depth of snow [m]
    const float white = std::clamp(point.snow / white_from, 0.0f, 1.0f);
    const Rgb albedo = mix(albedos::bare, albedos::snow, white);
    const Rgb lit = (1 - 0.10f * contour(x, normal, depth)) * light_on(x, normal, albedo);
    return mix(sky, lit, point.shown);
  }

  /// 1 on a line of equal height, 0 beside it. Lines end where the ground is level.
  float contour(const Vec<3>& x, const Vec<3>& normal, double depth) const {
    const double cosine = normal.dot(light_.up), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
    const double height = x.dot(light_.up) / contour_interval_;
    const double aside = std::abs(height - std::round(height)) * contour_interval_ / std::max(sine, 1e-3);
    const double width = 1.2 * depth / camera_.focal;
    return static_cast<float>(std::clamp(1.5 - aside / width, 0.0, 1.0) * std::clamp(10 * sine - 0.5, 0.0, 1.0));
  }

  Rgb face(const Vec<3>& x, std::int32_t number) const {
    const Vec<3> normal = (number % 2 == 0 ? -1.0 : 1.0) * Vec<3>::Unit(number % 6 / 2);
    return light_on(x, normal, albedos::box);
  }

  Rgb ball(const Vec<3>& x, std::size_t i) const {
    // As round as it is drawn, but no rounder than half: a heap of snow is no heap of marbles.
    const Vec<3> out = (x - landscape_.snow[i]).normalized();
    const Vec<3> normal = (out - 0.6 * camera_.forward + 0.6 * light_.up).normalized();
    const bool entrained = !landscape_.snow_kind.empty() && landscape_.snow_kind[i] != 0;
    const float rim = static_cast<float>(1 + out.dot(camera_.forward));  // 0 in the middle, 1 at the rim
    return (1 - 0.25f * rim) * light_on(x, normal, entrained ? albedos::entrained : albedos::released);
  }

  /// What a surface sends back of the sun, of the sky that it sees, and of the light that the snow around throws up.
  Rgb light_on(const Vec<3>& x, const Vec<3>& normal, Rgb albedo) const {
    const float facing = static_cast<float>(std::max(0.0, normal.dot(light_.sun)));
    const float sun = facing > 0 ? facing * sun_map_->lit(x, normal) * with_turned(smoke_.sunlight(x)) : 0.0f;
    const float upward = static_cast<float>(0.5 + 0.5 * normal.dot(light_.up));
    const Rgb around = upward * smoke_.skylight(x) * lights::sky + (0.12f * (1 - upward)) * lights::sun;
    return albedo * (sun * lights::sun + around);
  }

  const Landscape& landscape_;
  const Camera& camera_;
  const Light& light_;
  SmokeVolume smoke_;
  std::optional<ReliefSurface> surface_;
  std::optional<SunMap> sun_map_;
  std::optional<Solids> solids_;
  double contour_interval_ = 1;  // [m]
  Film8 film_;
};

}  // namespace

std::vector<std::uint32_t> draw_landscape(const Landscape& landscape, const Camera& camera, const Light& light) {
  SPINDRIFT_CHECK(landscape.snow_kind.empty() || landscape.snow_kind.size() == landscape.snow.size());
  return Drawer(landscape, camera, light).pixels();
}

std::vector<std::byte> landscape_png(const Landscape& landscape, const Camera& camera, const Light& light, double time,
                                     double bar_depth) {
  const double pixels_per_metre = camera.focal / bar_depth;
  const Vec<2> size = Vec<2>(camera.width, camera.height) / pixels_per_metre;
  Picture picture({Vec<2>::Zero(), size}, camera.width);
  picture.pixels(draw_landscape(landscape, camera, light));
  picture.time(time);
  picture.scale_bar();
  return picture.png();
}

}  // namespace spindrift
