#include "io/picture.hpp"

#include <fmt/format.h>

#include <numbers>
#include <string>

#include "core/error.hpp"
#include "io/canvas.hpp"

namespace spindrift {

namespace {

constexpr int largest_side = 16384;    // [px]
constexpr double smallest_disc = 0.8;  // radius [px]

int even(double pixels) {
  return 2 * static_cast<int>(std::lround(pixels / 2));
}

void set_colour(cairo_t* context, const Colour& c, double alpha = 1) {
  cairo_set_source_rgba(context, c.red, c.green, c.blue, c.alpha * alpha);
}

/// Height of the letters, and the measure of all that is set beside them [px].
double letter_size(int picture_height) {
  return std::clamp(0.048 * picture_height, 11.0, 40.0);
}

/// White letters with a soft dark rim, legible on snow and on sky.
void write_text(cairo_t* context, double x, double y, double size, const std::string& text) {
  cairo_set_font_size(context, size);
  cairo_move_to(context, x, y);
  cairo_text_path(context, text.c_str());
  cairo_set_line_width(context, 0.2 * size);
  cairo_set_source_rgba(context, 0.05, 0.08, 0.18, 0.35);
  cairo_stroke_preserve(context);
  set_colour(context, colours::snow);
  cairo_fill(context);
}

/// 1, 2 or 5 times a power of ten, the largest that is not over `most`.
double round_length(double most) {
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  for (const double factor : {5.0, 2.0})
    if (factor * decade <= most) return factor * decade;
  return decade;
}

}  // namespace

Picture::Canvas::Canvas(const Box<2>& world, int width_pixels) : lower_left(world.lower) {
  const Vec<2> size = world.size();
  if (!(size.array() > 0).all() || !size.allFinite() || !world.lower.allFinite() || width_pixels < 2)
    throw Error(ExitCode::bad_input, "a picture needs a window that is not empty");
  const double height_pixels = width_pixels * size[1] / size[0];
  if (width_pixels > largest_side || height_pixels > largest_side)
    throw Error(ExitCode::would_not_fit, fmt::format("a picture of {} x {:.0f} pixels is larger than {} x {}",
                                                     width_pixels, height_pixels, largest_side, largest_side));
  width = even(width_pixels);
  pixels_per_metre = width / size[0];
  height = std::max(2, even(height_pixels));
  surface = cairo_image_surface_create(CAIRO_FORMAT_RGB24, width, height);
  context = cairo_create(surface);
  if (cairo_status(context) != CAIRO_STATUS_SUCCESS) {
    cairo_destroy(context);
    cairo_surface_destroy(surface);
    throw Error(ExitCode::would_not_fit, "no memory for a picture");
  }
  cairo_font_options_t* font = cairo_font_options_create();
  cairo_font_options_set_antialias(font, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(font, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(font, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, font);
  cairo_font_options_destroy(font);
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL, CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_line_join(context, CAIRO_LINE_JOIN_ROUND);
}

Picture::Canvas::~Canvas() {
  cairo_destroy(context);
  cairo_surface_destroy(surface);
}

Picture::Picture(const Box<2>& world, int width_pixels) : canvas_(std::make_unique<Canvas>(world, width_pixels)) {}
Picture::~Picture() = default;

int Picture::width() const {
  return canvas_->width;
}
int Picture::height() const {
  return canvas_->height;
}

void Picture::sky() {
  cairo_pattern_t* gradient = cairo_pattern_create_linear(0, 0, 0, canvas_->height);
  cairo_pattern_add_color_stop_rgb(gradient, 0, 0.070, 0.145, 0.335);
  cairo_pattern_add_color_stop_rgb(gradient, 1, 0.170, 0.345, 0.605);
  cairo_set_source(canvas_->context, gradient);
  cairo_paint(canvas_->context);
  cairo_pattern_destroy(gradient);
}

void Picture::pixels(std::span<const std::uint32_t> all) {
  const std::size_t width = static_cast<std::size_t>(canvas_->width);
  SPINDRIFT_CHECK(all.size() == width * static_cast<std::size_t>(canvas_->height));
  Canvas::Pixels pixels(canvas_->surface);
  for (int y = 0; y < canvas_->height; ++y)
    std::copy_n(all.data() + static_cast<std::size_t>(y) * width, width, pixels.row(y));
}

void Picture::ground(std::span<const Vec<2>> surface) {
  if (surface.empty()) return;
  cairo_t* const context = canvas_->context;
  const double below = canvas_->height + 1.0;
  const Vec<2> first = canvas_->to_pixels(surface.front()), last = canvas_->to_pixels(surface.back());
  const double left = std::min(first[0], -1.0), right = std::max(last[0], canvas_->width + 1.0);
  const auto trace_surface = [&] {
    cairo_move_to(context, left, first[1]);
    for (const Vec<2>& x : surface) {
      const Vec<2> p = canvas_->to_pixels(x);
      cairo_line_to(context, p[0], p[1]);
    }
    cairo_line_to(context, right, last[1]);
  };
  cairo_save(context);
  trace_surface();
  cairo_line_to(context, right, below);
  cairo_line_to(context, left, below);
  cairo_close_path(context);
  set_colour(context, colours::ground);
  cairo_fill_preserve(context);
  cairo_clip(context);
  // The ground is lighter near its surface: strokes along it, from wide and dark to narrow and light.
  const double depth = letter_size(canvas_->height);
  constexpr int n_strokes = 10;
  for (int k = 1; k <= n_strokes; ++k) {
    const double light = 1 + 0.45 * k * k / (n_strokes * n_strokes);
    const Colour& c = colours::ground;
    trace_surface();
    cairo_set_line_width(context, 3 * depth * (n_strokes + 1 - k) / n_strokes);
    set_colour(context, {c.red * light, c.green * light, c.blue * light});
    cairo_stroke(context);
  }
  cairo_restore(context);
}

void Picture::box(const Box<2>& box) {
  const Vec<2> corner = canvas_->to_pixels({box.lower[0], box.upper[1]});
  const Vec<2> size = canvas_->to_pixels({box.upper[0], box.lower[1]}) - corner;
  cairo_rectangle(canvas_->context, corner[0], corner[1], size[0], size[1]);
  set_colour(canvas_->context, colours::ground);
  cairo_fill(canvas_->context);
}

void Picture::cover(std::span<const Vec<2>> base, std::span<const Vec<2>> surface) {
  if (base.empty() || surface.empty()) return;
  cairo_t* const context = canvas_->context;
  const auto line_to = [&](const Vec<2>& x) {
    const Vec<2> p = canvas_->to_pixels(x);
    cairo_line_to(context, p[0], p[1]);
  };
  for (const Vec<2>& x : base) line_to(x);
  for (std::size_t i = surface.size(); i-- > 0;) line_to(surface[i]);
  cairo_close_path(context);
  set_colour(context, colours::cover);
  cairo_fill(context);
  for (const Vec<2>& x : surface) line_to(x);
  cairo_set_line_width(context, 0.05 * letter_size(canvas_->height));
  set_colour(context, colours::snow, 0.55);
  cairo_stroke(context);
}

void Picture::discs(std::span<const Vec<2>> centres, double radius, std::span<const Colour> palette,
                    std::span<const std::uint8_t> kind) {
  SPINDRIFT_CHECK(!palette.empty() && (kind.empty() || kind.size() == centres.size()));
  const float r = static_cast<float>(std::max(radius * canvas_->pixels_per_metre, smallest_disc));
  const float rim = r > 2 ? 0.22f : 0.0f;  // large discs darken towards their rim, so that each is seen
  const double reach = r + 1.0;
  Canvas::Pixels pixels(canvas_->surface);
  for (std::size_t i = 0; i < centres.size(); ++i) {
    const Vec<2> p = canvas_->to_pixels(centres[i]);
    if (!(p[0] > -reach && p[0] < canvas_->width + reach && p[1] > -reach && p[1] < canvas_->height + reach)) continue;
    const Colour& colour = palette[kind.empty() ? 0 : std::min<std::size_t>(kind[i], palette.size() - 1)];
    const int x0 = std::max(static_cast<int>(p[0] - reach), 0), y0 = std::max(static_cast<int>(p[1] - reach), 0);
    const int x1 = std::min(static_cast<int>(p[0] + reach) + 1, canvas_->width);
    const int y1 = std::min(static_cast<int>(p[1] + reach) + 1, canvas_->height);
    for (int y = y0; y < y1; ++y) {
      std::uint32_t* const row = pixels.row(y);
      const float dy = static_cast<float>(y + 0.5 - p[1]);
      for (int x = x0; x < x1; ++x) {
        const float dx = static_cast<float>(x + 0.5 - p[0]);
        const float distance = std::sqrt(dx * dx + dy * dy);
        const float coverage = std::min(r + 0.5f - distance, 1.0f);
        if (coverage <= 0) continue;
        const float q = distance / r, light = 255 * (1 - rim * q * q);
        blend(row[x], light * static_cast<float>(colour.red), light * static_cast<float>(colour.green),
              light * static_cast<float>(colour.blue), coverage * static_cast<float>(colour.alpha));
      }
    }
  }
}

void Picture::time(double seconds) {
  const double size = letter_size(canvas_->height);
  write_text(canvas_->context, 0.7 * size, 1.4 * size, size, fmt::format("{:.2f} s", seconds));
}

void Picture::scale_bar() {
  cairo_t* const context = canvas_->context;
  const double size = letter_size(canvas_->height), margin = 0.8 * size;
  const double length = round_length(0.18 * canvas_->width / canvas_->pixels_per_metre);
  const double right = canvas_->width - margin, left = right - length * canvas_->pixels_per_metre;
  const double y = canvas_->height - margin, tick = 0.22 * size;
  const auto trace = [&](double line_width) {
    for (const double x : {left, right}) {
      cairo_move_to(context, x, y - tick);
      cairo_line_to(context, x, y + tick);
    }
    cairo_move_to(context, left, y);
    cairo_line_to(context, right, y);
    cairo_set_line_width(context, line_width);
    cairo_stroke(context);
  };
  cairo_set_source_rgba(context, 0.05, 0.08, 0.18, 0.35);
  trace(0.28 * size);
  set_colour(context, colours::snow);
  trace(0.1 * size);

  const std::string label = length < 1000 ? fmt::format("{:g} m", length) : fmt::format("{:g} km", length / 1000);
  cairo_text_extents_t extents;
  cairo_set_font_size(context, size);
  cairo_text_extents(context, label.c_str(), &extents);
  write_text(context, (left + right - extents.x_advance) / 2, y - 0.5 * size, size, label);
}

std::vector<std::byte> Picture::png() const {
  std::vector<std::byte> bytes;
  const auto append = [](void* into, const unsigned char* data, unsigned int n) {
    auto& sink = *static_cast<std::vector<std::byte>*>(into);
    const auto* begin = reinterpret_cast<const std::byte*>(data);
    sink.insert(sink.end(), begin, begin + n);
    return CAIRO_STATUS_SUCCESS;
  };
  const cairo_status_t status = cairo_surface_write_to_png_stream(canvas_->surface, append, &bytes);
  if (status != CAIRO_STATUS_SUCCESS)
    throw Error(ExitCode::io_failed, std::string("cannot encode a picture: ") + cairo_status_to_string(status));
  return bytes;
}

}  // namespace spindrift
