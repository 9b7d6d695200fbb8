#include "simulation/preview.hpp"

#include <algorithm>
#include <numeric>

namespace spindrift {
namespace {

void add_ground(PreviewFrame& frame, const Simulation<2>& simulation) {
  const Terrain<2>& terrain = *simulation.walls().terrain;
  for (const Vec<2>& vertex : terrain.profile()->vertices())
    if (vertex[0] > frame.world.lower[0] && vertex[0] < frame.world.upper[0]) frame.ground.push_back(vertex);
  const auto edge = [&](double x) { return Vec<2>(x, terrain.profile()->height(x)); };
  frame.ground.insert(frame.ground.begin(), edge(frame.world.lower[0]));
  frame.ground.push_back(edge(frame.world.upper[0]));
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
  frame.dx = suspension.grid().dx;
  const std::size_t n = count<2>(frame.smoke_shape);
  frame.smoke.resize(n);
  frame.solid.resize(n);
  for (std::size_t c = 0; c < n; ++c) {
    frame.solid[c] = suspension.ground().volume()[c] == 0;
    frame.smoke[c] = frame.solid[c] ? 0 : static_cast<float>(suspension.smoke_density(c));
  }
}

}  // namespace

PreviewFrame preview_frame(const Simulation<2>& simulation) {
  PreviewFrame frame;
  frame.world = simulation.walls().domain;
  frame.width = simulation.scene().output.preview_width;
  frame.time = simulation.time();
  frame.opaque_smoke = simulation.scene().output.opaque_smoke;
  if (simulation.walls().terrain) add_ground(frame, simulation);
  frame.obstacles = simulation.walls().obstacles;
  if (simulation.cover()) add_cover(frame, *simulation.cover(), *simulation.walls().terrain);
  if (simulation.dense()) add_snow(frame, *simulation.dense());
  if (simulation.suspension()) add_smoke(frame, *simulation.suspension());
  return frame;
}

std::vector<std::byte> PreviewFrame::png() const {
  Picture picture(world, width);
  picture.sky();
  if (!smoke.empty()) {
    SmokeField field;
    field.density = smoke;
    field.shape = smoke_shape;
    field.origin = world.lower;
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
