#include "simulation/preview.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <numeric>

#include "sph/ground_bins.hpp"

namespace spindrift {
namespace {

void add_ground(PreviewFrame& frame, const Terrain<2>& terrain) {
  for (const Vec<2>& vertex : terrain.profile()->vertices())
    if (vertex[0] > frame.world.lower[0] && vertex[0] < frame.world.upper[0]) frame.ground.push_back(vertex);
  const auto edge = [&](double x) { return Vec<2>(x, terrain.profile()->height(x)); };
  frame.ground.insert(frame.ground.begin(), edge(frame.world.lower[0]));
  frame.ground.push_back(edge(frame.world.upper[0]));
}

/// What all frames of a scene share.
PreviewFrame empty_frame(const Scene& scene, const Walls<2>& walls, double time) {
  PreviewFrame frame;
  frame.world = walls.domain;
  frame.width = scene.output.preview_width;
  frame.time = time;
  frame.opaque_smoke = scene.output.opaque_smoke;
  if (walls.terrain) add_ground(frame, *walls.terrain);
  frame.obstacles = walls.obstacles;
  return frame;
}

void add_cover(PreviewFrame& frame, const Cover<2>& cover, const Terrain<2>& terrain) {
  for (int b = 0; b < cover.shape[0]; ++b) {
    const Vec<1> place((cover.lower[0] + b + 0.5) * cover.bin_size);
    const Vec<2> base = terrain.position(place, 0);
    if (base[0] < frame.world.lower[0] || base[0] > frame.world.upper[0]) continue;
    frame.cover_base.push_back(base);
    frame.cover_top.push_back(terrain.position(place, cover.surface({cover.lower[0] + b})));
  }
}

void add_snow(PreviewFrame& frame, const DenseFlow<2>& dense) {
  const Particles<2>& p = dense.particles;
  std::vector<std::uint32_t> order(p.size());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) { return p.id[a] < p.id[b]; });
  for (const std::uint32_t i : order) {
    frame.snow.push_back(p.position[i]);
    frame.snow_kind.push_back(p.entrained_at[i] >= 0);
  }
  frame.snow_radius = dense.options().spacing / 2;
}

void add_smoke(PreviewFrame& frame, const Suspension<2>& suspension) {
  frame.smoke_shape = suspension.grid().cells;
  frame.smoke_lower = suspension.grid().box().lower;
  frame.dx = suspension.grid().dx;
  const std::size_t n = count<2>(frame.smoke_shape);
  frame.smoke.resize(n);
  frame.solid.resize(n);
  for (std::size_t c = 0; c < n; ++c) {
    frame.solid[c] = suspension.ground().volume()[c] == 0;
    frame.smoke[c] = frame.solid[c] ? 0 : static_cast<float>(suspension.smoke_density(c));
  }
}

/// Dense flow and cover of a frame that was read back. The cover's surface is that of Cover::surface: over bins of two
/// particles' edge along the ground.
void add_snow(PreviewFrame& frame, double spacing, const Walls<2>& walls, const PictureFrame& stored) {
  frame.snow_radius = spacing / 2;
  const double bin_size = 2 * spacing;
  std::map<int, double> surface;  // [m] above the ground, by bin
  for (std::size_t i = 0; i < stored.layer.size(); ++i) {
    const Vec<2> x(static_cast<double>(stored.positions[3 * i]), static_cast<double>(stored.positions[3 * i + 2]));
    if (stored.layer[i] == 0) {
      frame.snow.push_back(x);
      frame.snow_kind.push_back(stored.entrained_at[i] >= 0);
    } else if (walls.terrain && x.allFinite()) {
      const Foot<2> foot = walls.terrain->foot(x);
      double& top = surface[ground_bin<2>(foot.place, bin_size)[0]];
      top = std::max(top, foot.distance + spacing / 2);
    }
  }
  if (surface.empty()) return;
  for (int b = surface.begin()->first; b <= surface.rbegin()->first; ++b) {
    const Vec<1> place((b + 0.5) * bin_size);
    const Vec<2> base = walls.terrain->position(place, 0);
    if (base[0] < frame.world.lower[0] || base[0] > frame.world.upper[0]) continue;
    const auto top = surface.find(b);
    frame.cover_base.push_back(base);
    frame.cover_top.push_back(walls.terrain->position(place, top == surface.end() ? 0 : top->second));
  }
}

/// Of the two equal layers that a file holds, the first.
void add_smoke(PreviewFrame& frame, const PictureFrame& stored) {
  const std::array<std::int64_t, 3>& shape = stored.lattice.shape;
  frame.smoke_shape = {static_cast<int>(shape[0]), static_cast<int>(shape[2])};
  frame.dx = stored.lattice.spacing[0];
  frame.smoke_lower = {stored.lattice.origin[0] - frame.dx / 2, stored.lattice.origin[2] - frame.dx / 2};
  const std::size_t nx = static_cast<std::size_t>(shape[0]), layers = static_cast<std::size_t>(shape[1]);
  for (std::size_t row = 0; row < static_cast<std::size_t>(shape[2]); ++row)
    for (std::size_t i = 0; i < nx; ++i) {
      const std::size_t c = row * layers * nx + i;
      frame.smoke.push_back(stored.smoke[c]);
      frame.solid.push_back(stored.solid[c]);
    }
}

}  // namespace

PreviewFrame preview_frame(const Simulation<2>& simulation) {
  PreviewFrame frame = empty_frame(simulation.scene(), simulation.walls(), simulation.time());
  if (simulation.cover()) add_cover(frame, *simulation.cover(), *simulation.walls().terrain);
  if (simulation.dense()) add_snow(frame, *simulation.dense());
  if (simulation.suspension()) add_smoke(frame, *simulation.suspension());
  return frame;
}

PreviewFrame preview_frame(const Scene& scene, const Walls<2>& walls, const PictureFrame& stored) {
  PreviewFrame frame = empty_frame(scene, walls, stored.time);
  if (!stored.positions.empty()) add_snow(frame, scene.dense_flow->spacing(), walls, stored);
  if (!stored.smoke.empty()) add_smoke(frame, stored);
  return frame;
}

std::vector<std::byte> PreviewFrame::png() const {
  Picture picture(world, width);
  picture.sky();
  if (!smoke.empty()) {
    SmokeField field;
    field.density = smoke;
    field.shape = smoke_shape;
    field.origin = smoke_lower;
    field.dx = dx;
    field.solid = solid;
    picture.smoke(field, opaque_smoke);
  }
  if (!ground.empty()) picture.ground(ground);
  for (const Box<2>& obstacle : obstacles) picture.box(obstacle);
  if (!cover_base.empty()) picture.cover(cover_base, cover_top);
  constexpr std::array<Colour, 2> palette{colours::snow, colours::entrained};
  if (!snow.empty()) picture.discs(snow, snow_radius, palette, snow_kind);
  picture.time(time);
  picture.scale_bar();
  return picture.png();
}

}  // namespace spindrift
