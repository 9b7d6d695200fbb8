#include "simulation/setup.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/ground.hpp"
#include "simulation/initial_flow.hpp"
#include "simulation/outline.hpp"
#include "simulation/release.hpp"
#include "simulation/scene_vectors.hpp"
#include "sph/sampling.hpp"

namespace spindrift {
namespace {

Side side_of(const std::string& word) {
  return word == "open" ? Side::open : Side::closed;
}

/// Arc length of the ground at x [m]; on a height field x itself.
template <int Dim>
double ground_at(const Walls<Dim>& walls, double x) {
  if (walls.terrain->height_field()) return x;
  Vec<Dim> surface = Vec<Dim>::Zero();
  surface[0] = x;
  surface[up_axis<Dim>] = walls.terrain->height(surface);
  return walls.terrain->foot(surface).place[0];
}

ForceLaw law_of(const std::string& word) {
  return word == "paper" ? ForceLaw::paper : ForceLaw::air;
}

template <int Dim>
CoverLayer cover_layer(const Scene& scene, const Walls<Dim>& walls) {
  CoverLayer layer;
  layer.ground_from = ground_at(walls, walls.domain.lower[0]);
  layer.ground_to = ground_at(walls, walls.domain.upper[0]);
  const double begin = way_begins(walls);
  layer.from = std::max(begin + scene.cover->from, layer.ground_from);
  layer.to = scene.cover->to < 0 ? layer.ground_to : begin + scene.cover->to;
  if (walls.terrain->height_field()) layer.to = std::min(layer.to, layer.ground_to);
  layer.y = breadth_of(walls.domain);
  layer.depth = scene.cover->depth;
  if (!scene.cover->areas.empty()) {
    layer.within = extent_of(scene.cover->areas.front());
    for (const Outline& area : scene.cover->areas) layer.within = hull_of(layer.within, extent_of(area));
    layer.accepts = [areas = scene.cover->areas](const Vec<2>& place) { return inside_any(areas, place); };
  }
  layer.seed = scene.scene.seed;
  layer.relaxation_steps = scene.cover->relaxation_steps;
  layer.support_radius = scene.dense_flow->support_radius;
  return layer;
}

template <int Dim>
SnowKind<Dim> cover_snow(const Scene& scene, std::uint64_t first_id) {
  return {.spacing = scene.dense_flow->spacing(), .density = scene.cover->density, .first_id = first_id};
}

}  // namespace

template <int Dim>
Vec<Dim> make_gravity(const Scene& scene) {
  return vector_or<Dim>(scene.domain.gravity, -9.81 * up<Dim>());
}

template <int Dim>
Walls<Dim> make_walls(const Scene& scene) {
  Walls<Dim> walls;
  walls.domain = box_of<Dim>(scene.domain.lower, scene.domain.upper);
  walls.sides[0] = {side_of(scene.domain.left), side_of(scene.domain.right)};
  if constexpr (Dim == 3) walls.sides[1] = {side_of(scene.domain.front), side_of(scene.domain.back)};
  walls.sides[up_axis<Dim>] = {side_of(scene.domain.bottom), side_of(scene.domain.top)};
  for (const ObstacleSection& obstacle : scene.obstacle)
    if (obstacle.shape == "box") walls.obstacles.push_back(box_of<Dim>(obstacle.lower, obstacle.upper));
  if (scene.terrain) walls.terrain.emplace(make_terrain<Dim>(scene));
  if (scene.elevation) walls.known = known_ground(scene);
  return walls;
}

template <int Dim>
std::optional<Cover<Dim>> make_cover(const Scene& scene, const Walls<Dim>& walls, std::uint64_t first_id) {
  if (!scene.cover) return std::nullopt;
  const CoverLayer layer = cover_layer(scene, walls);
  const SnowKind<Dim> kind = cover_snow<Dim>(scene, first_id);
  if (walls.terrain->height_field()) return bare_cover<Dim>(layer, kind);
  return sample_cover<Dim>(*walls.terrain, layer, kind, walls.obstacles);
}

bool cover_sleeps(const Scene& scene) {
  const bool air_everywhere = scene.suspension && !scene.suspension->tiles;
  return scene.cover->sleeping && !air_everywhere && !(scene.entrainment && scene.entrainment->spontaneous);
}

std::optional<CoverArea> make_cover_area(const Scene& scene, const Walls<3>& walls) {
  if (!scene.cover || !walls.terrain->height_field()) return std::nullopt;
  return CoverArea(cover_layer(scene, walls), scene.dense_flow->spacing());
}

std::optional<SleepingCover> make_sleeping_cover(const Scene& scene, const Walls<3>& walls) {
  if (!scene.cover || !walls.terrain->height_field()) return std::nullopt;
  return SleepingCover(cover_layer(scene, walls), cover_snow<3>(scene, 0), walls.obstacles);
}

template <int Dim>
std::optional<DenseFlow<Dim>> make_dense_flow(const Scene& scene, const Walls<Dim>& walls) {
  if (!scene.dense_flow) return std::nullopt;
  const DenseFlowSection& section = *scene.dense_flow;
  DenseFlowOptions options;
  options.support_radius = section.support_radius;
  options.spacing = section.spacing();
  if (section.kernel == "wendland") options.kernel = KernelShape::wendland;
  options.density = section.density;
  options.solver = section.solver == "wcsph" ? DenseSolver::wcsph : DenseSolver::dfsph;
  options.viscosity = section.viscosity;
  options.no_slip = section.wall == "no_slip";
  options.pressure = {section.density_tolerance, section.divergence_tolerance, section.relative_tolerance,
                      section.max_iterations};
  options.sound_speed = section.sound_speed;
  if (section.neighbour_search == "kd_tree") options.neighbour_search = NeighbourSearch::kd_tree;
  if (options.solver == DenseSolver::wcsph && options.sound_speed == 0)
    options.sound_speed = 10 * std::sqrt(2 * make_gravity<Dim>(scene).norm() * walls.domain.size()[up_axis<Dim>]);
  std::optional<DenseFlow<Dim>> dense(options);
  dense->particles = released_snow<Dim>(scene, walls).particles;
  return dense;
}

template <int Dim>
MacGrid<Dim> make_grid(const Scene& scene, const Walls<Dim>& walls) {
  MacGrid<Dim> grid;
  grid.origin = walls.domain.lower;
  grid.dx = scene.suspension->cell_size;
  for (int k = 0; k < Dim; ++k)
    grid.cells[k] = std::max(1, static_cast<int>(std::lround(walls.domain.size()[k] / grid.dx)));
  return grid;
}

template <int Dim>
std::optional<ActiveTiles<Dim>> make_tiles(const Scene& scene, const Walls<Dim>& walls) {
  if (!scene.suspension || !scene.suspension->tiles) return std::nullopt;
  const TilesSection& section = *scene.suspension->tiles;
  const TileOptions options{section.margin, section.still_speed, section.clear_smoke};
  return ActiveTiles<Dim>(make_grid<Dim>(scene, walls), walls.sides, options);
}

template <int Dim>
Suspension<Dim> make_suspension(const Scene& scene, const Walls<Dim>& walls, const MacGrid<Dim>& grid,
                                const typename Suspension<Dim>::Sides& sides) {
  const SuspensionSection& section = *scene.suspension;
  SuspensionOptions<Dim> options;
  options.gravity = make_gravity<Dim>(scene);
  options.air_density = section.air_density;
  options.scheme = section.scheme == "semi_lagrangian" ? AdvectionScheme::semi_lagrangian : AdvectionScheme::maccormack;
  options.reflection = section.scheme == "reflection";
  options.viscosity = section.viscosity;
  options.no_slip = section.wall == "no_slip";
  options.lid = vector_or<Dim>(section.lid);
  options.diffusivity = section.diffusivity;
  options.settling_speed = section.settling_speed;
  if (section.confinement) options.confinement = section.confinement->strength;
  options.pressure = {section.tolerance, section.max_iterations};
  options.moving_core = section.moving_core;
  options.frozen = section.frozen;
  options.wind = vector_or<Dim>(section.wind);
  Suspension<Dim> air(grid, sides, options);
  if (section.initial_flow != "wind" || !options.wind.isZero())
    air.set_velocity(initial_flow<Dim>(section, grid, walls));
  return air;
}

std::optional<BedFriction> make_bed_friction(const Scene& scene) {
  if (!scene.dense_flow || !scene.terrain || scene.dense_flow->friction_acts_on == "none") return std::nullopt;
  return BedFriction{scene.dense_flow->friction_mu, scene.dense_flow->friction_xi};
}

std::optional<CouplingOptions> make_coupling(const Scene& scene) {
  if (!scene.coupling) return std::nullopt;
  const CouplingSection& section = *scene.coupling;
  if (!section.drag && !section.lift && !section.generation && !section.adhesion) return std::nullopt;
  const double spacing = scene.dense_flow->spacing();
  const double initial_mass = scene.dense_flow->density * std::pow(spacing, scene.scene.dim);
  CouplingOptions options;
  options.overlap_fraction = section.overlap_fraction;
  options.smoke.radius = spacing / 2;
  options.smoke.min_mass = section.min_mass * initial_mass;
  options.smoke.max_mass = section.max_mass * initial_mass;
  options.air_density = scene.suspension->air_density;
  if (section.drag) options.drag = ForceOptions{section.drag->constant, law_of(section.drag->law)};
  if (section.lift) options.lift = ForceOptions{section.lift->constant, law_of(section.lift->law)};
  if (section.generation)
    options.smoke.generation = GenerationOptions{section.generation->constant, section.generation->threshold_speed};
  if (section.adhesion) options.smoke.adhesion = AdhesionOptions{section.adhesion->constant};
  return options;
}

std::optional<EntrainmentOptions> make_entrainment(const Scene& scene) {
  if (!scene.entrainment) return std::nullopt;
  const EntrainmentSection& section = *scene.entrainment;
  EntrainmentOptions options;
  options.rule = section.rule == "bernoulli" ? EntrainmentRule::bernoulli : EntrainmentRule::clock;
  options.rate = section.rate;
  options.threshold = {section.threshold_surface, section.threshold_base};
  options.column = section.column == "vertical" ? OverburdenColumn::vertical : OverburdenColumn::normal;
  options.spontaneous = section.spontaneous;
  options.friction_factor = section.friction_strain;
  return options;
}

#define INSTANTIATE(Dim)                                                                              \
  template Vec<Dim> make_gravity<Dim>(const Scene&);                                                  \
  template Walls<Dim> make_walls<Dim>(const Scene&);                                                  \
  template std::optional<Cover<Dim>> make_cover<Dim>(const Scene&, const Walls<Dim>&, std::uint64_t); \
  template std::optional<DenseFlow<Dim>> make_dense_flow<Dim>(const Scene&, const Walls<Dim>&);       \
  template MacGrid<Dim> make_grid<Dim>(const Scene&, const Walls<Dim>&);                              \
  template std::optional<ActiveTiles<Dim>> make_tiles<Dim>(const Scene&, const Walls<Dim>&);          \
  template Suspension<Dim> make_suspension<Dim>(const Scene&, const Walls<Dim>&, const MacGrid<Dim>&, \
                                                const Suspension<Dim>::Sides&);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
