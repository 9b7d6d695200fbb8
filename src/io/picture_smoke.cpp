#include <cmath>
#include <vector>

#include "core/error.hpp"
#include "io/canvas.hpp"

namespace spindrift {

namespace {

/// Weights of the quadratic B-spline through three cells: smooth, without the staircase of the cells.
struct Spline {
  int first;  // of the three cells
  float weight[3];

  /// s: position in cells, cell i's centre at i + 0.5.
  explicit Spline(double s) {
    const double centre = std::floor(s);
    const float t = static_cast<float>(s - centre);
    first = static_cast<int>(centre) - 1;
    weight[0] = 0.5f * (1 - t) * (1 - t);
    weight[2] = 0.5f * t * t;
    weight[1] = 1 - weight[0] - weight[2];
  }
};

/// What is drawn of the smoke, a value a cell.
struct SmokeCells {
  int nx, nz;
  std::vector<float> depth;  // optical, of the whole smoke: density / opaque_density
  std::vector<float> light;  // that reaches the cell, times depth, so that clear cells do not weigh

  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(j) * static_cast<std::size_t>(nx) + static_cast<std::size_t>(i);
  }
};

/// The first layers of cells in the ground take the mean of their neighbours in the air, so that smoke reaches the
/// ground's edge, which is drawn over them.
void extend_into_ground(SmokeCells& cells, std::span<const std::uint8_t> solid) {
  std::vector<std::uint8_t> unknown(solid.begin(), solid.end());
  for (int layer = 0; layer < 2; ++layer) {
    const std::vector<std::uint8_t> before = unknown;
    for (int j = 0; j < cells.nz; ++j)
      for (int i = 0; i < cells.nx; ++i) {
        if (!before[cells.at(i, j)]) continue;
        float sum = 0;
        int n = 0;
        for (int dj = -1; dj <= 1; ++dj)
          for (int di = -1; di <= 1; ++di) {
            const int a = i + di, b = j + dj;
            if (a < 0 || b < 0 || a >= cells.nx || b >= cells.nz || before[cells.at(a, b)]) continue;
            sum += cells.depth[cells.at(a, b)];
            ++n;
          }
        cells.depth[cells.at(i, j)] = n > 0 ? sum / static_cast<float>(n) : 0;
        unknown[cells.at(i, j)] = n == 0;
      }
  }
}

/// Light from above and a little from the right, dimmed by the smoke it has come through lately: `memory` is the length
/// [cells] after which a shadow has faded to a third. Billows turned towards the light are brighter, the others darker.
void light_cells(SmokeCells& cells, float memory) {
  constexpr float slant = 0.5f;     // cells to the right for one upwards
  constexpr float strength = 0.9f;  // of the shadow under opaque smoke
  constexpr float relief = 0.7f;    // of the billows
  const float fade = std::exp(-1 / memory);
  const auto nx = static_cast<std::size_t>(cells.nx);
  std::vector<float> above(nx + 1, 0.0f), here(nx + 1, 0.0f);
  cells.light.resize(cells.depth.size());
  for (int j = cells.nz - 1; j >= 0; --j) {
    const float* const depth = cells.depth.data() + cells.at(0, j);
    const float* const upper = cells.depth.data() + cells.at(0, std::min(j + 1, cells.nz - 1));
    const float* const lower = cells.depth.data() + cells.at(0, std::max(j - 1, 0));
    float* const light = cells.light.data() + cells.at(0, j);
    for (std::size_t i = 0; i < nx; ++i) {
      const float shadow = fade * ((1 - slant) * above[i] + slant * above[i + 1]);
      const float towards_light =
          lower[i] - upper[i] + slant * (depth[i > 0 ? i - 1 : i] - depth[std::min(i + 1, nx - 1)]);
      const float turned = towards_light / (depth[i] + 0.5f);
      light[i] = depth[i] * std::exp(-strength * shadow) * (1 + relief * std::clamp(turned, -0.4f, 0.4f));
      here[i] = shadow + (1 - fade) * std::min(depth[i], 2.0f);
    }
    here.swap(above);
  }
}

/// One row of the picture between the cells' rows: three rows of `cells` combined.
void combine_rows(const std::vector<float>& values, const SmokeCells& cells, const Spline& spline,
                  std::vector<float>& row) {
  std::ranges::fill(row, 0.0f);
  for (int k = 0; k < 3; ++k) {
    const int j = spline.first + k;
    if (j < 0 || j >= cells.nz) continue;
    const float* const from = values.data() + cells.at(0, j);
    for (std::size_t i = 0; i < static_cast<std::size_t>(cells.nx); ++i) row[i + 2] += spline.weight[k] * from[i];
  }
}

}  // namespace

void Picture::smoke(const SmokeField& field, double opaque_density) {
  SPINDRIFT_CHECK(field.density.size() == count<2>(field.shape) && opaque_density > 0);
  SPINDRIFT_CHECK(field.solid.empty() || field.solid.size() == field.density.size());
  SmokeCells cells{field.shape[0], field.shape[1], {}, {}};
  cells.depth.reserve(field.density.size());
  const float per_density = static_cast<float>(1 / opaque_density);
  for (const float density : field.density)
    cells.depth.push_back(density > 0 && std::isfinite(density) ? density * per_density : 0.0f);
  if (!field.solid.empty()) extend_into_ground(cells, field.solid);
  const double pixels_per_cell = canvas_->pixels_per_metre * field.dx;
  light_cells(cells, static_cast<float>(std::max(0.03 * canvas_->width / pixels_per_cell, 1.0)));

  // Pixels of the cells, and of half a cell around them.
  const Vec<2> upper(field.dx * (cells.nx + 0.5), field.dx * (cells.nz + 0.5));
  const Vec<2> lower = Vec<2>::Constant(-0.5 * field.dx);
  const Vec<2> top_left = canvas_->to_pixels(field.origin + Vec<2>(lower[0], upper[1]));
  const Vec<2> bottom_right = canvas_->to_pixels(field.origin + Vec<2>(upper[0], lower[1]));
  const auto pixel = [](double p, int most) { return static_cast<int>(std::clamp(std::ceil(p), 0.0, double(most))); };
  const int x0 = pixel(top_left[0], canvas_->width), x1 = pixel(bottom_right[0], canvas_->width);
  const int y0 = pixel(top_left[1], canvas_->height), y1 = pixel(bottom_right[1], canvas_->height);

  const Vec<2> zero = canvas_->to_pixels(field.origin);
  std::vector<Spline> columns;
  for (int x = x0; x < x1; ++x) columns.emplace_back((x + 0.5 - zero[0]) / pixels_per_cell);
  std::vector<float> depth(static_cast<std::size_t>(cells.nx) + 4), light(depth.size());  // two clear cells a side
  Canvas::Pixels pixels(canvas_->surface);
  for (int y = y0; y < y1; ++y) {
    const Spline across((zero[1] - y - 0.5) / pixels_per_cell);
    combine_rows(cells.depth, cells, across, depth);
    combine_rows(cells.light, cells, across, light);
    std::uint32_t* const row = pixels.row(y);
    for (int x = x0; x < x1; ++x) {
      const Spline& along = columns[static_cast<std::size_t>(x - x0)];
      const auto through = [&along](const std::vector<float>& values) {
        const float* const v = values.data() + along.first + 2;
        return along.weight[0] * v[0] + along.weight[1] * v[1] + along.weight[2] * v[2];
      };
      const float d = through(depth);
      if (d < 1e-3f) continue;
      const float lit = std::min(through(light) / d, 1.0f);
      // From a cool grey in the shadow to white in the light.
      blend(row[x], 150 + 105 * lit, 168 + 87 * lit, 200 + 55 * lit, 1 - std::exp(-d));
    }
  }
}

}  // namespace spindrift
