#include <cairo/cairo.h>

#include <catch2/catch.hpp>
#include <cstring>
#include <limits>
#include <memory>

#include "core/error.hpp"
#include "io/picture.hpp"

using namespace spindrift;

namespace {

/// A PNG file, decoded.
class Decoded {
 public:
  explicit Decoded(const Picture& picture) : rest_(picture.png()) {
    surface_.reset(cairo_image_surface_create_from_png_stream(read, this));
    REQUIRE(cairo_surface_status(surface_.get()) == CAIRO_STATUS_SUCCESS);
  }
  int width() const { return cairo_image_surface_get_width(surface_.get()); }
  int height() const { return cairo_image_surface_get_height(surface_.get()); }

  /// Red, green, blue, 0 to 255.
  std::array<int, 3> at(int x, int y) const {
    std::uint32_t pixel;
    std::memcpy(
        &pixel,
        cairo_image_surface_get_data(surface_.get()) + y * cairo_image_surface_get_stride(surface_.get()) + 4 * x, 4);
    return {static_cast<int>(pixel >> 16 & 0xff), static_cast<int>(pixel >> 8 & 0xff), static_cast<int>(pixel & 0xff)};
  }
  int brightness(int x, int y) const { return at(x, y)[0] + at(x, y)[1] + at(x, y)[2]; }

 private:
  static cairo_status_t read(void* self, unsigned char* data, unsigned int n) {
    auto& bytes = static_cast<Decoded*>(self)->rest_;
    auto& from = static_cast<Decoded*>(self)->read_;
    if (from + n > bytes.size()) return CAIRO_STATUS_READ_ERROR;
    std::memcpy(data, bytes.data() + from, n);
    from += n;
    return CAIRO_STATUS_SUCCESS;
  }
  struct Destroy {
    void operator()(cairo_surface_t* s) const { cairo_surface_destroy(s); }
  };
  std::vector<std::byte> rest_;
  std::size_t read_ = 0;
  std::unique_ptr<cairo_surface_t, Destroy> surface_;
};

std::array<int, 3> rgb(const Colour& c) {
  const auto channel = [](double v) { return static_cast<int>(std::lround(255 * v)); };
  return {channel(c.red), channel(c.green), channel(c.blue)};
}

/// 20 m x 10 m at 10 pixels a metre.
const Box<2> world{{100, 50}, {120, 60}};

}  // namespace

TEST_CASE("a picture has even sides and the window's shape", "[picture]") {
  CHECK(Picture(world, 200).width() == 200);
  CHECK(Picture(world, 200).height() == 100);
  const Picture odd({{0, 0}, {10, 3.333}}, 101);
  CHECK(odd.width() % 2 == 0);
  CHECK(odd.height() % 2 == 0);
  CHECK(odd.height() == 34);
  CHECK(Decoded(odd).width() == odd.width());
  CHECK(Decoded(odd).height() == odd.height());
}

TEST_CASE("windows that make no picture are refused", "[picture]") {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  const auto size = GENERATE_COPY(Vec<2>(0, 1), Vec<2>(1, 0), Vec<2>(-1, 1), Vec<2>(nan, 1), Vec<2>(1, inf));
  CHECK_THROWS_AS(Picture({{0, 0}, size}, 100), Error);
  CHECK_THROWS_AS(Picture(world, 1), Error);
  CHECK_THROWS_AS(Picture(world, 100000), Error);
  CHECK_THROWS_AS(Picture({{0, 0}, {1, 1e9}}, 100), Error);
}

TEST_CASE("ground, cover and sky lie where they should", "[picture]") {
  Picture picture(world, 200);
  picture.sky();
  const std::vector<Vec<2>> ground{{102, 53}, {118, 53}}, surface{{102, 54}, {118, 54}};
  picture.ground(ground);
  picture.cover(ground, surface);
  const Decoded image(picture);
  for (const int x : {1, 100, 198}) CHECK(image.at(x, 98) == rgb(colours::ground));
  CHECK(image.at(100, 65) == rgb(colours::cover));
  CHECK(image.at(100, 2)[2] > image.at(100, 2)[0] + 40);
  CHECK(image.brightness(100, 50) > image.brightness(100, 2));
  CHECK(image.at(5, 65) == image.at(195, 65));
  CHECK(image.at(5, 65)[2] > image.at(5, 65)[0] + 40);
}

TEST_CASE("discs have their colours, their place and smooth edges", "[picture]") {
  Picture picture(world, 200);
  picture.sky();
  const std::vector<Vec<2>> centres{{105, 55}, {110, 55}, {115, 55}};
  const std::vector<Colour> palette{colours::snow, colours::entrained};
  const std::vector<std::uint8_t> kind{0, 1, 200};
  picture.discs(centres, 0.15, palette, kind);  // 1.5 px
  const Decoded image(picture);
  CHECK(image.at(50, 50) == std::array{255, 255, 255});
  CHECK(image.at(49, 49) == std::array{255, 255, 255});
  CHECK(image.at(100, 50) == rgb(colours::entrained));
  CHECK(image.at(150, 50) == rgb(colours::entrained));  // beyond the palette: its last colour
  CHECK(image.brightness(51, 50) > image.brightness(55, 50));
  CHECK(image.brightness(51, 50) < 3 * 255);
  CHECK(image.at(51, 50) == image.at(48, 50));
  CHECK(image.at(55, 50) == image.at(60, 50));
}

TEST_CASE("discs outside, far away or nowhere change nothing", "[picture]") {
  Picture picture(world, 200);
  picture.sky();
  const auto before = picture.png();
  const double nan = std::numeric_limits<double>::quiet_NaN(), huge = 1e300;
  const std::vector<Vec<2>> centres{{90, 55}, {110, 70}, {nan, 55}, {110, nan}, {huge, 55}, {110, -huge}};
  picture.discs(centres, 0.1, std::vector{colours::snow});
  picture.discs({}, 0.1, std::vector{colours::snow});
  picture.ground({});
  picture.cover({}, {});
  CHECK(picture.png() == before);
}

TEST_CASE("smoke whitens by 1 - exp(-density / opaque density)", "[picture]") {
  const Index<2> shape{40, 20};
  std::vector<float> density(count<2>(shape), 0.5f);
  Picture picture(world, 200), background(world, 200);
  picture.sky();
  background.sky();
  const double opaque_density = GENERATE(0.1, 0.5, 5.0);
  picture.smoke({density, shape, world.lower, 0.5, {}}, opaque_density);
  const Decoded image(picture), sky(background);
  // The top row is lit: white of the opacity asked for, apart from the billows' shading.
  const double alpha = 1 - std::exp(-0.5 / opaque_density);
  const auto over = [&](double snow) { return sky.at(100, 8)[0] * (1 - alpha) + snow * alpha; };
  CHECK(image.at(100, 8)[0] <= over(255) + 1);
  CHECK(image.at(100, 8)[0] >= over(200) - 1);
  CHECK(image.brightness(100, 60) < image.brightness(100, 8) + sky.brightness(100, 60) - sky.brightness(100, 8) + 1);
}

TEST_CASE("smoke is smooth, stays near its cells and keeps out what is not a density", "[picture]") {
  const Index<2> shape{40, 20};
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  std::vector<float> density(count<2>(shape), 0.0f);
  Picture picture(world, 200), background(world, 200);
  picture.sky();
  background.sky();
  const Decoded sky(background);
  SECTION("nothing to see") {
    density[flat<2>({3, 3}, shape)] = nan;
    density[flat<2>({9, 9}, shape)] = inf;
    density[flat<2>({20, 9}, shape)] = -3;
    picture.smoke({density, shape, world.lower, 0.5, {}}, 0.1);
    CHECK(picture.png() == background.png());
  }
  SECTION("a block of smoke") {
    for (int j = 8; j < 12; ++j)
      for (int i = 18; i < 22; ++i) density[flat<2>({i, j}, shape)] = 1;
    picture.smoke({density, shape, world.lower, 0.5, {}}, 0.5);
    const Decoded image(picture);
    CHECK(image.brightness(100, 50) > sky.brightness(100, 50) + 200);
    CHECK(image.at(100, 20) == sky.at(100, 20));
    CHECK(image.at(60, 50) == sky.at(60, 50));
    for (int x = 70; x < 130; ++x)  // an edge is spread over cells of 5 px, never a step
      CHECK(std::abs(image.brightness(x + 1, 50) - image.brightness(x, 50)) < 110);
  }
  SECTION("smoke reaches into solid cells, where ground will be painted over it") {
    std::vector<std::uint8_t> solid(density.size(), 0);
    for (int j = 0; j < 20; ++j)
      for (int i = 0; i < 40; ++i) {
        solid[flat<2>({i, j}, shape)] = j < 10;
        if (j >= 10) density[flat<2>({i, j}, shape)] = 1;
      }
    Picture plain(world, 200);
    plain.sky();
    plain.smoke({density, shape, world.lower, 0.5, {}}, 0.5);
    picture.smoke({density, shape, world.lower, 0.5, solid}, 0.5);
    const Decoded with(picture), without(plain);
    CHECK(with.brightness(100, 52) > without.brightness(100, 52) + 100);
    CHECK(with.at(100, 80) == sky.at(100, 80));
  }
}

TEST_CASE("smoke outside the window or larger than it is clipped", "[picture]") {
  const Index<2> shape{8, 8};
  const std::vector<float> density(count<2>(shape), 1.0f);
  Picture picture(world, 200), background(world, 200);
  picture.sky();
  background.sky();
  for (const Vec<2>& far : {Vec<2>(1000, 50), Vec<2>(-1000, 50), Vec<2>(110, 1000), Vec<2>(110, -1000)})
    picture.smoke({density, shape, far, 0.5, {}}, 0.5);
  CHECK(picture.png() == background.png());
  picture.smoke({density, shape, {0, 0}, 100, {}}, 0.5);
  CHECK(Decoded(picture).brightness(100, 50) > Decoded(background).brightness(100, 50) + 100);
}

TEST_CASE("time and scale bar are white marks in their corners, whatever the scale", "[picture]") {
  const double size = GENERATE(0.003, 1.0, 20.0, 3e4);
  const Box<2> window{{0, 0}, {2 * size, size}};
  Picture picture(window, 600), background(window, 600);
  background.sky();
  picture.sky();
  picture.time(12.35);
  picture.scale_bar();
  const Decoded image(picture);
  const auto n_white = [&](int x0, int x1, int y0, int y1) {
    int n = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x) n += image.brightness(x, y) > 750;
    return n;
  };
  CHECK(n_white(0, 150, 0, 50) > 20);
  CHECK(n_white(400, 600, 230, 300) > 80);
  CHECK(n_white(200, 400, 0, 300) == 0);
  CHECK(n_white(0, 200, 100, 300) == 0);
}

TEST_CASE("the same picture has the same bytes", "[picture]") {
  const auto paint = [] {
    Picture picture(world, 200);
    picture.sky();
    const std::vector<float> density(200, 0.3f);
    picture.smoke({density, {20, 10}, world.lower, 0.5, {}}, 0.4);
    picture.ground(std::vector<Vec<2>>{{100, 53}, {120, 51}});
    picture.discs(std::vector<Vec<2>>{{110, 55}, {111.3, 55.2}}, 0.1, std::vector{colours::snow});
    picture.time(1);
    picture.scale_bar();
    return picture.png();
  };
  CHECK(paint() == paint());
}
