#include "simulation/release.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "grid/open_fractions.hpp"
#include "simulation/ground.hpp"
#include "simulation/outline.hpp"
#include "simulation/scene_vectors.hpp"
#include "sph/sampling.hpp"

namespace spindrift {
namespace {

/// Distance of (x, z) from the rim of a polygon [m], positive inside.
double depth_inside(const Outline& corners, double x, double z) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Vec<2> start(corners[j][0], corners[j][1]), edge = Vec<2>(corners[i][0], corners[i][1]) - start;
    const Vec<2> from_start = Vec<2>(x, z) - start;
    const double length = edge.squaredNorm();
    const double along = length > 0 ? std::clamp(from_start.dot(edge) / length, 0.0, 1.0) : 0;
    nearest = std::min(nearest, (from_start - along * edge).norm());
  }
  return inside(corners, x, z) ? nearest : -nearest;
}

/// Whether the cover's extent along the ground reaches into the stretch from place `from` to `to` [m].
template <int Dim>
bool covered(const Scene& scene, const Walls<Dim>& walls, double from, double to) {
  if (!scene.cover) return false;
  const double begin = way_begins(walls);
  return to > begin + scene.cover->from && (scene.cover->to < 0 || from < begin + scene.cover->to);
}

/// Normal distance of the cover's surface from the ground at a place, 0 where there is none [m].
template <int Dim>
double cover_at(const Scene& scene, const Walls<Dim>& walls, const Vec<Dim - 1>& place) {
  if (!covered(scene, walls, place[0], place[0])) return 0;
  if constexpr (Dim == 3)
    if (!scene.cover->areas.empty() && !inside_any(scene.cover->areas, place)) return 0;
  return scene.cover->depth;
}

template <int Dim>
Slab slab_of(const Scene& scene, const ReleaseSection& release, const Walls<Dim>& walls) {
  Slab slab;
  slab.at = release.at;
  slab.length = release.length;
  slab.base = covered(scene, walls, slab.at, slab.at + slab.length) ? scene.cover->depth : 0;
  slab.thickness = release.thickness;
  slab.y = breadth_of(walls.domain);
  return slab;
}

/// The snow of an area of release: on the cover where there is some, on the ground elsewhere.
Particles<3> sampled_area(const Scene& scene, const ReleaseSection& release, const Walls<3>& walls,
                          const SnowKind<3>& kind) {
  GroundLayer layer;
  layer.extent = extent_of(release.points);
  layer.thickness = release.thickness;
  layer.spacing = scene.dense_flow->spacing();
  layer.seed = scene.scene.seed;
  if (scene.cover) layer.relaxation_steps = scene.cover->relaxation_steps;
  std::vector<double> bases{0};
  if (scene.cover) bases.push_back(scene.cover->depth);
  Particles<3> snow;
  for (const double base : bases) {
    layer.base = base;
    const Particles<3> part = sample_area(*walls.terrain->height_field(), layer, kind, [&](const Vec<2>& place) {
      return inside(release.points, place[0], place[1]) && cover_at(scene, walls, place) == base;
    });
    for (std::size_t i = 0; i < part.size(); ++i) snow.push_back_from(part, i);
  }
  return snow;
}

/// Whether x lies inside the release, `margin` [m] or more from the sides of its box or slab.
template <int Dim>
bool contains(const Scene& scene, const ReleaseSection& release, const Walls<Dim>& walls, const Vec<Dim>& x,
              double margin) {
  if (release.shape == "slab") {
    const Slab slab = slab_of(scene, release, walls);
    const Foot<Dim> foot = walls.terrain->foot(x);
    return foot.place[0] > slab.at + margin && foot.place[0] < slab.at + slab.length - margin &&
           foot.distance > slab.base + margin && foot.distance < slab.base + slab.thickness - margin;
  }
  if constexpr (Dim == 3)
    if (release.shape == "area") {
      // Areas have their places from the same tile, so that no margin keeps those of two apart.
      const double reach = release.thickness + (scene.cover ? scene.cover->depth : 0);
      const Box<2> extent = extent_of(release.points);
      const Vec<2> around = Vec<2>::Constant(reach);
      if (!Box<2>{extent.lower - around, extent.upper + around}.contains(x.template head<2>())) return false;
      const Foot<3> foot = walls.terrain->foot(x, reach);
      const double base = cover_at(scene, walls, foot.place);
      return foot.distance > base && foot.distance < base + release.thickness &&
             inside(release.points, foot.place[0], foot.place[1]);
    }
  const Box<Dim> box = box_around<Dim>(release, walls);
  const Vec<Dim> rim = Vec<Dim>::Constant(margin);
  if (!Box<Dim>{box.lower + rim, box.upper - rim}.contains(x)) return false;
  if (release.shape == "polygon") return inside(release.points, x[0], x[up_axis<Dim>]);
  return release.shape != "ball" || (x - (box.lower + box.upper) / 2).norm() <= release.radius;
}

template <int Dim>
bool in_cover(const Scene& scene, const Walls<Dim>& walls, const Vec<Dim>& x, double margin) {
  if (!scene.cover) return false;
  const Foot<Dim> foot = walls.terrain->foot(x);
  const double depth = cover_at(scene, walls, foot.place);
  return depth > 0 && foot.distance < depth + margin;
}

/// All particles that a release may have: to be looked at one by one.
template <int Dim>
Particles<Dim> sampled(const Scene& scene, const ReleaseSection& release, const Walls<Dim>& walls,
                       const SnowKind<Dim>& kind) {
  if (release.shape == "slab") return sample_slab<Dim>(*walls.terrain, slab_of(scene, release, walls), kind);
  if constexpr (Dim == 3)
    if (release.shape == "area") return sampled_area(scene, release, walls, kind);
  return sample_box<Dim>(box_around<Dim>(release, walls), kind);
}

template <int Dim>
void set_in_motion(Particles<Dim>& snow, const ReleaseSection& release) {
  if (snow.empty() || (release.shear == 0 && release.rotation == 0)) return;
  Vec<Dim> middle = Vec<Dim>::Zero();
  double lowest = snow.position[0][up_axis<Dim>];
  for (const Vec<Dim>& x : snow.position) {
    middle += x / static_cast<double>(snow.size());
    lowest = std::min(lowest, x[up_axis<Dim>]);
  }
  for (std::size_t i = 0; i < snow.size(); ++i) {
    const Vec<Dim> arm = snow.position[i] - middle;
    snow.velocity[i][0] += release.shear * (snow.position[i][up_axis<Dim>] - lowest);
    snow.velocity[i][0] -= release.rotation * arm[up_axis<Dim>];
    snow.velocity[i][up_axis<Dim>] += release.rotation * arm[0];
  }
}

/// Share of a cell that a box fills.
template <int Dim>
double filled_share(const Box<Dim>& box, const MacGrid<Dim>& grid, const Index<Dim>& cell) {
  const Vec<Dim> lower = grid.node(cell);
  const Box<Dim> inside = common<Dim>({lower, lower + Vec<Dim>::Constant(grid.dx)}, box);
  return inside.size().cwiseMax(0).prod() / grid.cell_volume();
}

/// Share of a cell that a shape of smoke fills, the surface of balls and polygons taken as plane within the cell.
template <int Dim>
double filled_share(const SmokeSection& shape, const MacGrid<Dim>& grid, const Index<Dim>& cell) {
  if (shape.shape == "box") return filled_share<Dim>(box_of<Dim>(shape.lower, shape.upper), grid, cell);
  const auto depth_at = [&](const Vec<Dim>& x) {
    if (shape.shape == "polygon") return depth_inside(shape.points, x[0], x[up_axis<Dim>]);
    return shape.radius - (x - vector_or<Dim>(shape.center)).norm();
  };
  std::array<double, std::size_t{1} << Dim> depth;
  for (std::size_t corner = 0; corner < depth.size(); ++corner) {
    Index<Dim> node = cell;
    for (int axis = 0; axis < Dim; ++axis) node[axis] += static_cast<int>((corner >> axis) & 1);
    depth[corner] = depth_at(grid.node(node));
  }
  return open_fraction<Dim>(depth);
}

/// Calls act(cell, volume [m^Dim]) for every cell's air within a shape of smoke.
template <int Dim, class F>
void for_each_filled(const SmokeSection& shape, const Suspension<Dim>& suspension, F&& act) {
  const MacGrid<Dim>& grid = suspension.grid();
  for_each_index<Dim>(grid.cells, [&](const Index<Dim>& cell) {
    const double share = filled_share<Dim>(shape, grid, cell);
    if (share > 0) act(cell, share * suspension.ground().volume()[cell]);
  });
}

}  // namespace

template <int Dim>
ReleasedSnow<Dim> released_snow(const Scene& scene, const Walls<Dim>& walls) {
  ReleasedSnow<Dim> snow;
  const double d = scene.dense_flow->spacing(), margin = 0.25 * d;
  const Walls<Dim> beside_ground{{}, walls.obstacles, walls.domain, walls.sides};
  for (std::size_t r = 0; r < scene.release.size(); ++r) {
    const ReleaseSection& release = scene.release[r];
    SnowKind<Dim> kind;
    kind.spacing = d;
    kind.density = release.density > 0 ? release.density : scene.dense_flow->density;
    kind.velocity = vector_or<Dim>(release.velocity);
    const bool is_area = release.shape == "area", on_ground = is_area || release.shape == "slab";
    const Particles<Dim> all = sampled(scene, release, walls, kind);
    Particles<Dim> kept;
    ReleaseCount& count = snow.releases.emplace_back();
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vec<Dim>& x = all.position[i];
      if (!on_ground && !contains(scene, release, walls, x, 0)) continue;
      // An area's snow begins where ground and cover end.
      bool buried = !is_area && in_cover(scene, walls, x, margin);
      (is_area ? beside_ground : walls).for_each_near(x, margin, [&](double, const Vec<Dim>&) { buried = true; });
      const bool doubled = std::any_of(scene.release.begin(), scene.release.begin() + static_cast<std::ptrdiff_t>(r),
                                       [&](const auto& earlier) { return contains(scene, earlier, walls, x, margin); });
      if (buried || doubled) {
        ++(buried ? count.buried : count.doubled);
        continue;
      }
      ++count.placed;
      if (walls.outside(x)) ++count.outside;
      kept.push_back_from(all, i);
    }
    set_in_motion(kept, release);
    for (std::size_t i = 0; i < kept.size(); ++i) {
      snow.particles.push_back_from(kept, i);
      snow.particles.id.back() = snow.particles.size() - 1;
    }
  }
  return snow;
}

template <int Dim>
Field<Dim> initial_smoke(const Scene& scene, const Suspension<Dim>& suspension) {
  Field<Dim> smoke(suspension.grid().cells);
  for (const SmokeSection& shape : scene.smoke)
    if (shape.density > 0)
      for_each_filled<Dim>(shape, suspension,
                           [&](const Index<Dim>& cell, double volume) { smoke[cell] = shape.density * volume; });
  return smoke;
}

template <int Dim>
Field<Dim> smoke_rate(const Scene& scene, const Suspension<Dim>& suspension) {
  Field<Dim> rate(suspension.grid().cells);
  for (const SmokeSection& shape : scene.smoke)
    if (shape.rate > 0)
      for_each_filled<Dim>(shape, suspension,
                           [&](const Index<Dim>& cell, double volume) { rate[cell] += shape.rate * volume; });
  return rate;
}

template ReleasedSnow<2> released_snow<2>(const Scene&, const Walls<2>&);
template ReleasedSnow<3> released_snow<3>(const Scene&, const Walls<3>&);
template Field<2> initial_smoke<2>(const Scene&, const Suspension<2>&);
template Field<3> initial_smoke<3>(const Scene&, const Suspension<3>&);
template Field<2> smoke_rate<2>(const Scene&, const Suspension<2>&);
template Field<3> smoke_rate<3>(const Scene&, const Suspension<3>&);

}  // namespace spindrift
