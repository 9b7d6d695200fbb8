#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "verification/stability.hpp"
#include "verification/trial_looks.hpp"

namespace spindrift {
namespace {

using Settings = std::vector<std::string>;

/// `key` with a place, of which a slice has no y.
template <int Dim>
std::string at(std::string_view key, double x, double y, double z) {
  return Dim == 2 ? fmt::format("{}=[{}, {}]", key, x, z) : fmt::format("{}=[{}, {}, {}]", key, x, y, z);
}

template <int Dim>
Trial trial(const char* set, const char* name, const char* scene, Settings settings) {
  return {set, fmt::format("{}{}", name, Dim == 2 ? "" : ", in 3D"),
          fmt::format("verification/extreme_{}{}.toml", scene, Dim == 2 ? "" : "_3d"), std::move(settings)};
}

template <int Dim>
Trial refusal(const char* set, const char* name, const char* scene, Settings settings) {
  Trial one = trial<Dim>(set, name, scene, std::move(settings));
  one.refused = true;
  return one;
}

/// A box of snow from wall to wall on level ground.
template <int Dim>
Settings at_rest(Settings ground) {
  ground.insert(ground.end(), {at<Dim>("release.lower", 0, 0, 0.5), at<Dim>("release.upper", 4, 1, 1.3),
                               "dense_flow.friction_acts_on=column", "smoke.density=1e-6"});
  return ground;
}

template <int Dim>
std::vector<Trial> ground() {
  Trial on_cover =
      with_look(trial<Dim>("F1", "flat ground with a cover, snow at rest on it", "slope",
                           {"terrain.shape=polyline", "terrain.points=[[0, 2], [12, 2]]", "domain.left=closed",
                            "domain.right=closed", "release.at=0", "release.length=12",
                            at<Dim>("release.velocity", 0, 0, 0), "smoke.density=1e-6"}),
                quiet_on_cover);
  on_cover.remark =
      "as the snow settles some cover is entrained. What falls into the pits that it leaves is shot about there with 1 "
      "to 4 m/s, and takes more: 5 particles in 10 s in 2D, 120 (of 1,433) in 3 s in 3D.";
  return {
      with_look(trial<Dim>("F1", "flat ground, snow at rest", "box",
                           at_rest<Dim>({"terrain.shape=polyline", "terrain.points=[[-1, 0.5], [5, 0.5]]"})),
                quiet),
      on_cover,
      trial<Dim>("F1", "slope of 89 degrees", "slope", {"terrain.angle=89 deg"}),
      trial<Dim>(
          "F1", "cliff of 90 degrees", "slope",
          {"terrain.shape=cliff", "terrain.cliff_at=2", "terrain.cliff_height=3", "terrain.transition_radius=0"}),
      refusal<Dim>("F1", "overhang", "slope",
                   {"terrain.shape=polyline", "terrain.points=[[0, 7], [5, 5], [4, 4], [20, 0]]"}),
      refusal<Dim>("F1", "slope whose foot is beyond the domain", "slope", {"terrain.angle=1e-6 deg"}),
  };
}

/// Ground of heights over a plane has one height a place: there is no overhang to refuse.
std::vector<Trial> height_fields() {
  const auto on_heights = [](const char* name, Settings settings) {
    settings.insert(settings.begin(), {"release.shape=area", "release.points=[[1, 0], [3, 0], [3, 0.9], [1, 0.9]]",
                                       "terrain.cell_size=0.25"});
    return trial<3>("F1", name, "slope", std::move(settings));
  };
  return {
      with_look(trial<3>("F1", "level heights, snow at rest", "box",
                         at_rest<3>({"terrain.shape=plane", "terrain.angle=0", "terrain.start=[0, 0.5]"})),
                quiet),
      on_heights("heights with a cliff of 89.9 degrees", {"terrain.shape=cliff_band", "terrain.cliff_at=2",
                                                          "terrain.cliff_height=3", "terrain.cliff_angle=89.9 deg"}),
      on_heights("heights that fall by 89 degrees, and across by 60",
                 {"terrain.shape=plane", "terrain.angle=89 deg", "terrain.side_angle=60 deg", "terrain.start=[6, 5]"}),
  };
}

template <int Dim>
std::vector<Trial> grids() {
  return {
      trial<Dim>("F7", "empty: no snow, no smoke", "slope", {"release.thickness=1e-6", "smoke.density=1e-9"}),
      trial<Dim>("F7", "one cell", "box", {"suspension.cell_size=4", at<Dim>("domain.upper", 4, 4, 4)}),
      trial<Dim>("F7", "one row of cells", "box",
                 {"suspension.cell_size=1", at<Dim>("domain.upper", 4, 1, 1), at<Dim>("release.upper", 1, 1, 0.8),
                  at<Dim>("smoke.center", 2.5, 0.5, 0.5), "smoke.radius=0.4"}),
      trial<Dim>(
          "F7", "one column of cells", "box",
          {"suspension.cell_size=0.25", at<Dim>("domain.upper", 0.25, 0.25, 3),
           at<Dim>("release.upper", 0.25, 0.25, 1.5), at<Dim>("smoke.center", 0.125, 0.125, 2), "smoke.radius=0.1"}),
      trial<Dim>("F7", "all air inside an obstacle", "box",
                 {at<Dim>("obstacle.lower", -1, -1, -1), at<Dim>("obstacle.upper", 5, 5, 5)}),
      trial<Dim>("F7", "terrain over the whole box", "slope",
                 {"terrain.shape=polyline", "terrain.points=[[-5, 20], [30, 19]]", "release.at=1", "cover.to=1"}),
      trial<Dim>("F7", "overlap cut by the domain's edge", "slope",
                 {at<Dim>("domain.upper", 3, 0.9, 9), at<Dim>("smoke.center", 2, 0.45, 7)}),
  };
}

/// The walls stand between two planes of nodes.
template <int Dim>
std::vector<Trial> thin_walls() {
  const Settings wall{at<Dim>("obstacle.lower", 2.1, -1, -1), at<Dim>("obstacle.upper", 2.11, 5, 5),
                      "coupling.generation.constant=0"};
  Trial shot = trial<Dim>("F13", "snow of 200 m/s onto a wall thinner than its way in a step", "particles", wall);
  shot.settings.insert(shot.settings.end(),
                       {at<Dim>("release[1].center", 0.8, 0.5, 2), at<Dim>("release[0].velocity", 200, 0, 0),
                        at<Dim>("release[1].velocity", 200, 0, 0), "dense_flow.cfl=1", "domain.right=closed"});
  Trial box = trial<Dim>("F13", "smoke behind a wall thinner than cells and particles, snow before it", "box", wall);
  box.settings.insert(box.settings.end(), {at<Dim>("smoke.center", 2.7, 0.5, 2), "smoke.radius=0.5"});
  box.steps = 300;
  return {with_look(shot, held_by_the_wall), with_look(box, held_by_the_wall)};
}

}  // namespace

std::vector<Trial> shape_trials() {
  std::vector<Trial> all;
  for (auto* group : {ground<2>, ground<3>, height_fields, grids<2>, grids<3>, thin_walls<2>, thin_walls<3>})
    for (Trial& one : group()) all.push_back(std::move(one));
  return all;
}

}  // namespace spindrift
