#include "simulation/scene_warnings.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "simulation/pylons.hpp"
#include "simulation/registry.hpp"
#include "simulation/release.hpp"
#include "simulation/scene_vectors.hpp"
#include "simulation/setup.hpp"
#include "simulation/units.hpp"

namespace spindrift {
namespace {

class Warner {
 public:
  Warner(const Scene& scene, const Origins& origins) : scene_(scene), origins_(origins) {}

  std::vector<std::string> run() {
    keys_without_effect();
    sections();
    sizes();
    densities();
    obstacles();
    air();
    scene_.scene.dim == 3 ? places<3>() : places<2>();
    return std::move(lines_);
  }

 private:
  void add(std::string_view path, std::string_view why) {
    std::string_view around = path;
    auto origin = origins_.find(around);
    while (origin == origins_.end() && around.find('.') != std::string_view::npos) {
      around = around.substr(0, around.rfind('.'));
      origin = origins_.find(around);
    }
    const std::string place = origin == origins_.end() ? "" : origin->second + ": ";
    lines_.push_back(fmt::format("{}warning: {}: {}", place, path, why));
  }

  void keys_without_effect() {
    Scene scene = scene_;
    for (const Key& key : keys()) {
      const std::size_t count = find_section(key.section())->count(scene);
      for (std::size_t i = 0; i < count; ++i) {
        const std::string path = numbered(key, i, count);
        if (applies(key, scene, i) || !origins_.contains(path)) continue;
        if (key.condition.name.empty()) {  // front and back have been refused
          add(path, "has no effect, maps are made in 3D with a terrain");
          continue;
        }
        const std::string word = fmt::format("{}.{}", numbered(key.section(), i, count), key.condition.name);
        add(path,
            fmt::format("has no effect, it belongs to {} = \"{}\"", word, fmt::join(key.condition.values, "\" or \"")));
      }
    }
  }

  void sections() {
    const auto& s = scene_;
    if (s.cover && !s.entrainment) add("cover", "nothing takes it up: there is no section [entrainment]");
    if (s.dense_flow && s.release.empty() && !(s.entrainment && s.entrainment->spontaneous))
      add("dense_flow", "no snow will move: there is no section [release]");
    if (s.coupling && !s.coupling->drag && !s.coupling->lift && !s.coupling->generation && !s.coupling->adhesion)
      add("coupling", "nothing is exchanged: it has none of drag, lift, generation and adhesion");
    if (s.coupling && s.coupling->adhesion && !s.coupling->generation && s.smoke.empty())
      add("coupling.adhesion", "there will be no smoke to adhere: neither [coupling.generation] nor [smoke]");
    for (std::size_t i = 0; i < s.smoke.size(); ++i)
      if (s.smoke[i].density == 0 && s.smoke[i].rate == 0)
        add(numbered("smoke", i, s.smoke.size()), "brings no smoke: its density and its rate are 0");
    if (!s.dense_flow && !s.suspension) add("domain", "nothing to compute: neither [dense_flow] nor [suspension]");
  }

  void sizes() {
    if (!scene_.dense_flow) return;
    const double d = scene_.dense_flow->spacing();
    if (scene_.cover && scene_.cover->depth < d)
      add("cover.depth", fmt::format("a cover of {} m is thinner than one particle of {} m",
                                     number_text(scene_.cover->depth), number_text(d)));
    if (!scene_.suspension) return;
    const double dx = scene_.suspension->cell_size;
    if (dx > 20 * d)
      add("suspension.cell_size", fmt::format("cells of {} m are {:.0f} times as large as the particles' spacing of {} "
                                              "m: the air hardly sees the flow",
                                              number_text(dx), dx / d, number_text(d)));
    if (dx < 0.8 * d)
      add("suspension.cell_size",
          fmt::format("cells of {} m are finer than the particles, {} m apart: the air would see every single one, at "
                      "{:.0f} times the cost of cells of that size",
                      number_text(dx), number_text(d), std::pow(d / dx, scene_.scene.dim + 1)));
  }

  void densities() {
    for (std::size_t i = 0; i < scene_.release.size(); ++i) {
      const double own = scene_.release[i].density;
      const double density = scene_.dense_flow->density, time = scene_.dense_flow->compaction_time;
      if (own > 0 && own != density && time > 0)
        add(numbered("release", i, scene_.release.size()) + ".density",
            fmt::format("snow takes on dense_flow.density = {} kg/m^3 within the {} s of dense_flow.compaction_time; "
                        "0 s there lets it keep its own",
                        number_text(density), number_text(time)));
    }
    if (!scene_.suspension || !scene_.dense_flow) return;
    double gas = scene_.suspension->air_density;
    for (const SmokeSection& smoke : scene_.smoke) gas = std::max(gas, scene_.suspension->air_density + smoke.density);
    for (std::size_t i = 0; i < scene_.release.size(); ++i) {
      const double own = scene_.release[i].density, density = own > 0 ? own : scene_.dense_flow->density;
      if (density < gas)
        add(own > 0 ? numbered("release", i, scene_.release.size()) + ".density" : "dense_flow.density",
            fmt::format("snow lighter than the air with its smoke, {} kg/m^3: the air throws it about, and the run may "
                        "end as unstable",
                        number_text(gas)));
    }
  }

  void obstacles() {
    const double of_snow = scene_.dense_flow ? 2 * scene_.dense_flow->spacing() : 0;
    const double least = std::max(of_snow, scene_.suspension ? 2 * scene_.suspension->cell_size : 0);
    for (std::size_t i = 0; i < scene_.obstacle.size(); ++i) {
      const ObstacleSection& obstacle = scene_.obstacle[i];
      if (obstacle.shape != "box") continue;
      double thickness = obstacle.upper[0] - obstacle.lower[0];
      for (std::size_t k = 1; k < obstacle.lower.size(); ++k)
        thickness = std::min(thickness, obstacle.upper[k] - obstacle.lower[k]);
      if (thickness < least)
        add(numbered("obstacle", i, scene_.obstacle.size()),
            fmt::format("thinner than two particles or cells ({} m): snow feels what lies behind it, and the air whole "
                        "faces of cells",
                        number_text(least)));
    }
  }

  void air() {
    const DomainSection& domain = scene_.domain;
    if (domain.gravity.back() > 0) add("domain.gravity", "points upwards");
    if (!scene_.suspension) return;
    const SuspensionSection& air = *scene_.suspension;
    if (air.wall == "no_slip" && air.viscosity == 0)
      add("suspension.wall", "has no effect on air without viscosity: suspension.viscosity is 0");
    if (air.scheme == "reflection" && air.cfl > 10)
      add("suspension.cfl", "the reflection scheme can gain energy in steps of more than ten cells");
    if (air.frozen) {
      constexpr std::string_view none = "has no effect on air that is frozen: suspension.frozen is true";
      if (air.viscosity > 0) add("suspension.viscosity", none);
      if (air.confinement) add("suspension.confinement", none);
      if (!is_zero(air.lid)) add("suspension.lid", none);
    }
    if (air.initial_flow != "wind" && air.initial_speed == 0)
      add("suspension.initial_flow", "is air at rest: suspension.initial_speed is 0");
  }

  template <int Dim>
  void places() {
    const Walls<Dim> walls = make_walls<Dim>(scene_);
    if (walls.terrain) ground(walls);
    if (scene_.suspension) wind(walls);
    pylons(walls);
    if (!scene_.dense_flow) return;
    const std::vector<ReleaseCount> counts = released_snow<Dim>(scene_, walls).releases;
    for (std::size_t i = 0; i < counts.size(); ++i) {
      const ReleaseCount& count = counts[i];
      const std::string name = numbered("release", i, counts.size());
      const std::size_t all = count.placed + count.buried + count.doubled;
      const auto left_out = [&](std::size_t n, std::string_view where) {
        if (n > 0) add(name, fmt::format("{} of its {} particles are left out: they lie {}", n, all, where));
      };
      left_out(count.buried, "in the ground, the cover, an obstacle or a wall");
      left_out(count.doubled, "in an earlier release");
      if (count.outside > 0)
        add(name,
            fmt::format("{} of its {} particles lie outside the domain and will be gone at once", count.outside, all));
      if (all == 0) add(name, "too small for a single particle: no snow is released");
    }
  }

  template <int Dim>
  void wind(const Walls<Dim>& walls) {
    const Vec<Dim> wind = vector_or<Dim>(scene_.suspension->wind);
    for (int axis = 0; axis < Dim; ++axis)
      if (wind[axis] != 0 && !scene_.suspension->frozen &&
          walls.sides[static_cast<std::size_t>(axis)][wind[axis] > 0 ? 0 : 1] == Side::closed)
        add("suspension.wind", "comes through a closed side of the domain: it will die down");
  }

  template <int Dim>
  void pylons(const Walls<Dim>& walls) {
    for (std::size_t i = 0; i < scene_.pylon.size(); ++i)
      if (pylon_place<Dim>(scene_.pylon[i], walls)[up_axis<Dim>] > walls.domain.upper[up_axis<Dim>])
        add(numbered("pylon", i, scene_.pylon.size()),
            "stands out of the domain's top: it feels the wind beyond it alone");
  }

  template <int Dim>
  void ground(const Walls<Dim>& walls) {
    constexpr int n = 200;
    int below = 0, above = 0, unknown = 0, all = 0;
    Index<Dim> samples;
    samples.fill(walls.terrain->height_field() ? n + 1 : 1);
    samples[0] = n + 1;
    samples[up_axis<Dim>] = 1;
    for_each_index<Dim>(samples, [&](const Index<Dim>& i) {
      Vec<Dim> x = walls.domain.lower;
      for (int axis = 0; axis < up_axis<Dim>; ++axis) x[axis] += walls.domain.size()[axis] * i[axis] / n;
      ++all;
      if constexpr (Dim == 3)
        if (!walls.known.at(x.template head<2>())) return void(++unknown);
      const double z = walls.terrain->height(x);
      below += z < walls.domain.lower[up_axis<Dim>];
      above += z > walls.domain.upper[up_axis<Dim>];
    });
    const std::string_view whole = walls.terrain->height_field() ? "area" : "length";
    if (unknown > 0)
      add("terrain", fmt::format("has no heights under {} % of the domain: snow that comes there leaves",
                                 std::max(1, 100 * unknown / all)));
    if (below > 0)
      add("terrain", fmt::format("lies below the domain over {} % of its {}: snow leaves there",
                                 std::max(1, 100 * below / all), whole));
    if (above > 0)
      add("terrain", fmt::format("fills the whole height of the domain over {} % of its {}",
                                 std::max(1, 100 * above / all), whole));
  }

  const Scene& scene_;
  const Origins& origins_;
  std::vector<std::string> lines_;
};

}  // namespace

std::vector<std::string> scene_warnings(const Scene& scene, const Origins& origins) {
  return Warner(scene, origins).run();
}

}  // namespace spindrift
