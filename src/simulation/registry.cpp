#include "simulation/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numbers>

#include "simulation/registry_rows.hpp"

namespace spindrift {
namespace {

void add_snow(Registry& r) {
  using R = ReleaseSection;
  Rows<&Scene::release>(r, "release", "snow let go at the start; there may be several")
      .words<&R::shape>(
          "shape", {"slab", "area", "box", "ball", "polygon"},
          "slab: lies on the ground or the cover, over the whole breadth; area: the same under a polygon seen from "
          "above (3D); polygon: in the x-z plane, in 3D over the whole breadth")
      .number<&R::density>("density", "kg/m^3", from(0, 1e5), "0: that of the dense flow")
      .with("shape", {"slab"})
      .number<&R::at>("at", "m", from(0, 1e6), "way along the ground to the slab's upper end")
      .number<&R::length>("length", "m", extent, "of the slab along the ground")
      .with("shape", {"slab", "area"})
      .number<&R::thickness>("thickness", "m", above(0, 1000), "of slab or area, normal to the ground")
      .number<&R::layers>("layers", "", from(0, 1e6), "of particles, in place of a thickness; 0: by the thickness")
      .with("shape", {"box"})
      .number<&R::lower>("lower", "m", position, "lower corner")
      .number<&R::upper>("upper", "m", position, "upper corner")
      .with("shape", {"ball"})
      .number<&R::center>("center", "m", position, "middle of the ball")
      .number<&R::radius>("radius", "m", extent, "of the ball")
      .with("shape", {"area", "polygon"})
      .number<&R::points>("points", "m", position,
                          "corners one after the other: (x, y) of an area, (x, z) of a polygon")
      .with("shape", {"area"})
      .plain<&R::file>(
          "file",
          "in place of points: a shapefile or another map of polygons, a release each; their `thickness` or "
          "`d0` counts where none is said")
      .always()
      .number<&R::velocity>("velocity", "m/s", speed, "initial velocity; default 0")
      .number<&R::shear>("shear", "1/s", from(-1e6, 1e6),
                         "growth of the velocity along x with height over the lowest snow")
      .number<&R::rotation>("rotation", "1/s", from(-1e6, 1e6),
                            "initial angular velocity about the snow's middle; positive turns x towards z");

  using F = DenseFlowSection;
  Rows<&Scene::dense_flow>(r, "dense_flow", "the flowing snow, as particles")
      .words<&F::solver>("solver", {"dfsph", "wcsph"}, "pressure: implicit on volume, or an equation of state", "R11")
      .words<&F::kernel>("kernel", {"cubic_spline", "wendland"}, "W; wendland: of class C2", "Eq. (4)")
      .number<&F::support_radius>("support_radius", "m", above(0, 100), "h, of the kernel", "Sec. 5")
      .number<&F::support_ratio>("support_ratio", "", from(2, 4), "h over the particle spacing d", "Sec. 5")
      .number<&F::density>("density", "kg/m^3", above(0, 1e5), "of the flowing snow", "R20")
      .number<&F::viscosity>("viscosity", "Pa s", from(0, 1e6), "mu, of the flowing snow", "Eq. (2)")
      .words<&F::wall>("wall", {"slip", "no_slip"},
                       "viscous stress at walls: none, or as at a wall that holds the snow")
      .number<&F::cfl>("cfl", "", above(0, 1), "largest way of a particle in a step, in spacings")
      .with("solver", {"dfsph"})
      .number<&F::density_tolerance>("density_tolerance", "", between(0, 1), "mean compression allowed")
      .number<&F::divergence_tolerance>("divergence_tolerance", "", above(0, 1000),
                                        "mean rate of compression allowed, in percent of the volume a step")
      .number<&F::relative_tolerance>(
          "relative_tolerance", "", from(0, 1),
          "mean compression left by a solve, over what the velocities alone would make; 0: not asked for")
      .number<&F::max_iterations>("max_iterations", "", iterations, "of each pressure solve")
      .with("solver", {"wcsph"})
      .number<&F::sound_speed>("sound_speed", "m/s", from(0, 1e5),
                               "of the equation of state; 0: ten times the largest speed expected")
      .always()
      .number<&F::friction_mu>("friction_mu", "", from(0, 10), "Coulomb coefficient at ground and cover", "R18")
      .number<&F::friction_xi>("friction_xi", "m/s^2", from(0, 1e9), "Voellmy coefficient; 0: no turbulent part", "R18")
      .words<&F::friction_acts_on>("friction_acts_on", {"column", "base", "none"}, "which particles feel it", "R18")
      .number<&F::compaction_time>("compaction_time", "s", from(0, 1e6),
                                   "in which entrained snow takes on the flow's density; 0: off", "R20")
      .words<&F::neighbour_search>("neighbour_search", {"cell_list", "kd_tree"},
                                   "how neighbours are looked for; the result is the same to the bit");

  using C = CoverSection;
  Rows<&Scene::cover>(r, "cover", "the resting snow cover, as particles")
      .number<&C::depth>("depth", "m", above(0, 1000), "normal to the ground")
      .number<&C::density>("density", "kg/m^3", above(0, 1e5), "rho_a", "Eq. (15)")
      .number<&C::from>("from", "m", from(0, 1e6),
                        "way along the ground at which it begins; on a height field along x from the domain's left")
      .number<&C::to>("to", "m", from(-1, 1e6), "way along the ground at which it ends; negative: the ground's end")
      .number<&C::areas>("areas", "m", position, "on 3D grounds: outlines of corners (x, y); none: it lies everywhere")
      .plain<&C::file>("file",
                       "in place of areas: a shapefile or another map of polygons; their `thickness` or `d0` counts "
                       "where no depth is said")
      .plain<&C::sleeping>(
          "sleeping",
          "on 3D grounds: snow is made where flow or air comes near, not all at the start; the flow is the same")
      .number<&C::relaxation_steps>("relaxation_steps", "", from(0, 1e5), "of the sampling", "Sec. 4.5");
}

void add_smoke(Registry& r) {
  using U = SuspensionSection;
  Rows<&Scene::suspension>(r, "suspension", "the air and its snow smoke, on a grid")
      .number<&U::cell_size>("cell_size", "m", above(0, 1e4), "dx", "Sec. 5")
      .number<&U::air_density>("air_density", "kg/m^3", above(0, 1e4), "rho_air", "Eq. (7)")
      .words<&U::scheme>("scheme", {"maccormack", "semi_lagrangian", "reflection"},
                         "of the air's advection; reflection: MacCormack with two projections a step, of second order",
                         "Eq. (2)")
      .number<&U::viscosity>("viscosity", "m^2/s", from(0, 1e6), "kinematic, of the air", "Eq. (2)")
      .words<&U::wall>("wall", {"slip", "no_slip"},
                       "viscous stress at closed sides of the domain: none, or as at a wall")
      .with("wall", {"no_slip"})
      .number<&U::lid>("lid", "m/s", speed, "velocity of the closed top, along itself; default 0")
      .always()
      .number<&U::diffusivity>("diffusivity", "m^2/s", from(0, 1e6), "of the smoke", "R19")
      .number<&U::settling_speed>("settling_speed", "m/s", from(0, 1000), "of the smoke; 0: off", "R19")
      .number<&U::cfl>("cfl", "", above(0, 100), "largest way of the air in a step, in cells")
      .number<&U::tolerance>("tolerance", "", between(0, 1), "relative residual of the pressure solve")
      .number<&U::max_iterations>("max_iterations", "", iterations, "of the pressure solve")
      .number<&U::wind>("wind", "m/s", speed, "velocity of the air beyond open sides, and at the start; default 0")
      .words<&U::initial_flow>(
          "initial_flow", {"wind", "vortices", "rotation", "potential"},
          "of the air at the start: the wind; a Taylor-Green vortex that fills the box; "
          "solid-body rotation about its middle; a potential flow, which a projection brings to rest")
      .with("initial_flow", {"vortices", "rotation", "potential"})
      .number<&U::initial_speed>("initial_speed", "m/s", speed,
                                 "U: largest u of the vortex, speed of the rotation half the box's breadth from its "
                                 "middle (positive: x towards z), largest component of the potential flow")
      .always()
      .plain<&U::frozen>("frozen", "the air keeps the velocity that it began with, and carries smoke and snow along")
      .plain<&U::moving_core>("moving_core", "the dense core pushes the air aside; false: the paper's rule", "R10");
  Rows<&Scene::suspension, &U::confinement>(r, "suspension.confinement", "vorticity confinement: keeps swirls alive")
      .number<&ConfinementSection::strength>("strength", "", from(0, 100), "epsilon", "Eq. (8)");
  Rows<&Scene::suspension, &U::tiles>(r, "suspension.tiles",
                                      "air only where something happens: tiles of 8 x 8 x 8 cells, in 2D 16 x 16, with "
                                      "smoke, moving air or snow")
      .number<&TilesSection::margin>("margin", "", from(1, 100), "tiles that are kept around those")
      .number<&TilesSection::still_speed>("still_speed", "m/s", from(0, 100), "slower air counts as air at rest")
      .number<&TilesSection::clear_smoke>("clear_smoke", "kg/m^3", from(0, 100),
                                          "thinner smoke counts as clear air; it is booked as outflow");

  using M = SmokeSection;
  Rows<&Scene::smoke>(r, "smoke", "snow smoke in the air: at the start, or given off; there may be several")
      .words<&M::shape>("shape", {"box", "ball", "polygon"},
                        "what it fills; polygon: in the x-z plane, in 3D over the whole breadth")
      .number<&M::density>("density", "kg/m^3", from(0, 1e4), "rho_smoke at the start", "Eq. (7)")
      .number<&M::rate>("rate", "kg/m^3/s", from(0, 1e4), "smoke that comes as long as the run lasts; rates add up")
      .with("shape", {"box"})
      .number<&M::lower>("lower", "m", position, "lower corner")
      .number<&M::upper>("upper", "m", position, "upper corner")
      .with("shape", {"ball"})
      .number<&M::center>("center", "m", position, "middle of the ball")
      .number<&M::radius>("radius", "m", extent, "of the ball")
      .with("shape", {"polygon"})
      .number<&M::points>("points", "m", position, "corners (x, z) one after the other");

  using X = CouplingSection;
  Rows<&Scene::coupling>(r, "coupling", "what dense flow and smoke exchange where they overlap")
      .number<&X::overlap_fraction>("overlap_fraction", "", from(0, 10), "beta: overlap is where n < beta n_interior",
                                    "R1")
      .number<&X::min_mass>("min_mass", "", below(0, 1), "of a particle, in masses of a released one", "R17")
      .number<&X::max_mass>("max_mass", "", from(1, 1e6),
                            "of a particle that sweeps up smoke, in masses of a released one", "R17");
  const std::vector<std::string_view> laws = {"air", "paper"};
  Rows<&Scene::coupling, &X::drag>(r, "coupling.drag", "air drag on particles, and back on the air")
      .number<&DragSection::constant>("constant", "", from(0, 1e6), "k_drag", "Eq. (10)")
      .words<&DragSection::law>("law", laws, "scaled by the displaced air's mass, or by the particle's", "R2");
  Rows<&Scene::coupling, &X::lift>(r, "coupling.lift", "lift by the air's swirls, and back on the air")
      .number<&LiftSection::constant>("constant", "", from(0, 1e6), "k_lift", "Eq. (11)")
      .words<&LiftSection::law>("law", laws, "scaled by the displaced air's mass, or by the particle's", "R3");
  Rows<&Scene::coupling, &X::generation>(r, "coupling.generation", "smoke torn off the particles")
      .number<&GenerationSection::constant>("constant", "kg m^-2 s^-1 (m/s)^-1.7", from(0, 1e3), "C_g", "Eq. (12), R5")
      .number<&GenerationSection::threshold_speed>("threshold_speed", "m/s", from(0, 1000), "below it, none", "R5");
  Rows<&Scene::coupling, &X::adhesion>(r, "coupling.adhesion", "smoke swept up by the particles")
      .number<&AdhesionSection::constant>("constant", "", from(0, 1e3), "C_a", "Eq. (13)");
}

void add_rest(Registry& r) {
  using E = EntrainmentSection;
  Rows<&Scene::entrainment>(r, "entrainment", "cover that the flow sweeps along")
      .words<&E::rule>("rule", {"clock", "bernoulli"}, "one clock a particle (any time step), or Eq. (16) as it stands",
                       "R15")
      .number<&E::rate>("rate", "kg m^-2 s^-1", from(0, 1e6), "Er", "Eq. (16)")
      .number<&E::threshold_surface>("threshold_surface", "1/s", above(0, 1e6), "gamma_0 at the cover's surface", "R13")
      .number<&E::threshold_base>("threshold_base", "1/s", above(0, 1e6), "gamma_0 at the cover's base", "R13")
      .words<&E::column>("column", {"normal", "vertical"}, "along which the load of a particle is summed",
                         "Fig. 8, R12")
      .plain<&E::spontaneous>("spontaneous", "the cover may fail where no flow touches it", "R13")
      .number<&E::friction_strain>("friction_strain", "", from(0, 1e12), "factor on gamma_f; 0: off", "Eq. (14), R14")
      .plain<&E::shared_traction>("shared_traction", "bed friction spares what brings entrained snow up to speed",
                                  "R16");
}

const Registry& registry() {
  static const Registry table = [] {
    Registry r;
    add_setting(r);
    add_snow(r);
    add_smoke(r);
    add_rest(r);
    add_output(r);
    return r;
  }();
  return table;
}

/// Where the paper's constants differ from measured snow. What the paper does not have, friction, settling, compaction
/// and a threshold speed, is off.
void apply_paper(Scene& scene) {
  scene.dense_flow->friction_mu = 0;
  scene.dense_flow->friction_xi = 0;
  scene.dense_flow->compaction_time = 0;
  scene.suspension->settling_speed = 0;
  scene.coupling->generation->constant = 0.2;
  scene.coupling->generation->threshold_speed = 0;
}

template <class Row>
const Row* find(const std::vector<Row>& rows, std::string_view path) {
  const auto row = std::find_if(rows.begin(), rows.end(), [&](const Row& r) { return r.path == path; });
  return row == rows.end() ? nullptr : &*row;
}

}  // namespace

const std::vector<Section>& sections() {
  return registry().sections;
}
const std::vector<Key>& keys() {
  return registry().keys;
}
const Section* find_section(std::string_view path) {
  return find(sections(), path);
}
const Key* find_key(std::string_view path) {
  return find(keys(), path);
}

bool applies(const Key& key, Scene& scene, std::size_t index) {
  if (scene.scene.dim == 2 && (key.path == "domain.front" || key.path == "domain.back")) return false;
  if (key.path.starts_with("output.raster")) return scene.scene.dim == 3 && scene.terrain.has_value();
  if (key.condition.name.empty()) return true;
  const Key& word = *find_key(fmt::format("{}.{}", key.section(), key.condition.name));
  const std::string& value = *std::get<std::string*>(word.field(scene, index));
  return std::find(key.condition.values.begin(), key.condition.values.end(), value) != key.condition.values.end();
}

std::string numbered(std::string_view section, std::size_t index, std::size_t count) {
  return count > 1 ? fmt::format("{}[{}]", section, index) : std::string(section);
}
std::string numbered(const Key& key, std::size_t index, std::size_t count) {
  return fmt::format("{}.{}", numbered(key.section(), index, count), key.name());
}

Scene complete_scene(std::string_view preset) {
  Scene scene;
  for (const Section& section : sections()) section.create(scene);
  scene.scene.preset = preset;
  if (preset == "paper") apply_paper(scene);
  return scene;
}

}  // namespace spindrift
