#include "sph/sampling.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "sph/kd_tree.hpp"
#include "sph/sleeping_cover.hpp"
#include "sph/tile.hpp"

namespace spindrift {
namespace {

constexpr double least_pair = 0.7;  // of d: closer pairs are thinned

/// Which particles stay if each goes that has an earlier one that stays among its close ones.
std::vector<std::uint8_t> thinned(const std::vector<std::vector<std::uint32_t>>& close) {
  std::vector<std::uint8_t> kept(close.size(), 1);
  for (std::size_t i = 0; i < close.size(); ++i)
    kept[i] = std::none_of(close[i].begin(), close[i].end(), [&](std::uint32_t j) { return j < i && kept[j] != 0; });
  return kept;
}

/// Whether cover may rest at `place`: on ground that is not too steep, and there nearer than to any other ground.
template <int Dim>
bool may_rest(const Terrain<Dim>& terrain, const Vec<Dim>& place, double d) {
  if (terrain.profile()->tangent(place[0])[0] < least_cos_slope) return false;
  const double distance = place[Dim - 1];
  const Foot<Dim> foot = terrain.foot(terrain.position(place.template head<Dim - 1>(), distance));
  if (std::abs(foot.distance - distance) <= 1e-6 * d) return true;
  return std::abs(cos_slope<Dim>(foot.normal)) < least_cos_slope && foot.distance >= d / 2;
}

void check(bool good, const char* what) {
  if (!good) throw Error(ExitCode::bad_input, std::string("sampling: ") + what);
}

template <int Dim>
void check_kind(const SnowKind<Dim>& kind) {
  check(std::isfinite(kind.spacing) && kind.spacing > 0, "the particle spacing must be positive");
  check(std::isfinite(kind.density) && kind.density > 0, "the density must be positive");
}

template <int Dim>
void lay_on_profile(Cover<Dim>& cover, const Terrain<Dim>& terrain, const CoverLayer& layer, const SnowKind<Dim>& kind,
                    std::span<const Box<Dim>> obstacles) {
  const double d = kind.spacing;
  constexpr double period = tile_period<Dim>;
  Vec<Dim> size = Vec<Dim>::Constant(period * d);
  size[Dim - 1] = layer.depth;
  const Tile<Dim> tile = relaxed_tile<Dim>(TileKind::layer, size, d, layer.seed, layer.relaxation_steps);
  const auto last_tile = [&](double length) { return static_cast<int>(std::ceil(length / (period * d))); };
  const int first = static_cast<int>(std::floor(layer.from / (period * d)));
  const int n_across = Dim == 2 ? 1 : last_tile(layer.y.to - layer.y.from);

  std::vector<Vec<Dim>> places;
  for (int along = first; along < last_tile(layer.to); ++along)
    for (int across = 0; across < n_across; ++across)
      for (Vec<Dim> place : tile.places) {
        place[0] += along * period * d;
        if (place[0] < layer.from || place[0] >= layer.to) continue;
        if constexpr (Dim == 3) {
          place[1] += layer.y.from + across * period * d;
          if (place[1] > layer.y.to) continue;
        }
        places.push_back(place);
      }
  std::vector<std::uint8_t> kept(places.size());
  parallel_for(places.size(), [&](std::size_t i) { kept[i] = may_rest(terrain, places[i], d); });

  std::vector<Vec<Dim>> positions;
  std::size_t n = 0;
  for (std::size_t i = 0; i < places.size(); ++i) {
    if (kept[i] == 0) continue;
    const Vec<Dim> x = terrain.position(places[i].template head<Dim - 1>(), places[i][Dim - 1]);
    if (any_within<Dim>(obstacles, x, d / 2)) continue;
    places[n++] = places[i];
    positions.push_back(x);
  }
  std::vector<std::vector<std::uint32_t>> close(n);
  for_each_neighbourhood<Dim>(positions, n, least_pair * d, [&](std::size_t i, const Found& found) {
    for (const auto& [j, squared] : found) close[i].push_back(j);
  });
  kept = thinned(close);

  for (std::size_t i = 0; i < n; ++i) {
    if (kept[i] == 0) continue;
    append(cover.particles, positions[i], kind, kind.first_id + cover.particles.size());
    Foot<Dim> foot = terrain.foot(positions[i]);
    foot.distance = places[i][Dim - 1];
    foot.place = places[i].template head<Dim - 1>();
    cover.foot.push_back(foot);
  }
}

}  // namespace

template <int Dim>
void append(Particles<Dim>& particles, const Vec<Dim>& x, const SnowKind<Dim>& kind, std::uint64_t id) {
  const double volume = std::pow(kind.spacing, Dim);
  particles.id.push_back(id);
  particles.position.push_back(x);
  particles.velocity.push_back(kind.velocity);
  particles.mass.push_back(kind.density * volume);
  particles.volume.push_back(volume);
  particles.pressure.push_back(0);
  particles.entrained_at.push_back(-1);
}

template <int Dim>
Cover<Dim> bare_cover(const CoverLayer& layer, const SnowKind<Dim>& kind) {
  check_kind(kind);
  check(std::isfinite(layer.from) && std::isfinite(layer.to) && std::isfinite(layer.depth) &&
            std::isfinite(layer.y.from) && std::isfinite(layer.y.to),
        "the cover's extent and depth must be finite");
  const double d = kind.spacing;
  Cover<Dim> cover;
  cover.spacing = d;
  cover.support_radius = layer.support_radius;
  cover.density = kind.density;
  cover.thickness = std::max(layer.depth, 0.0);
  // Less d: a bin that the ground's end cuts may hold no particle.
  cover.ground_lower[0] = layer.ground_from + d;
  cover.ground_upper[0] = layer.ground_to - d;
  if constexpr (Dim == 3) cover.ground_lower[1] = layer.y.from + d, cover.ground_upper[1] = layer.y.to - d;
  index_cover(cover);
  return cover;
}

template <int Dim>
Cover<Dim> sample_cover(const Terrain<Dim>& terrain, const CoverLayer& layer, const SnowKind<Dim>& kind,
                        std::span<const Box<Dim>> obstacles) {
  Cover<Dim> cover = bare_cover(layer, kind);
  if constexpr (Dim == 3) {
    if (const HeightField* field = terrain.height_field()) {
      SleepingCover(layer, kind, obstacles).wake_all(cover, *field);
      return cover;
    }
  }
  const bool empty = !(layer.depth > 0) || !(layer.to > layer.from) || (Dim == 3 && !(layer.y.to > layer.y.from));
  if (empty) return cover;
  lay_on_profile(cover, terrain, layer, kind, obstacles);
  cover.hazard.assign(cover.particles.size(), 0);
  index_cover(cover);
  return cover;
}

template <int Dim>
Particles<Dim> sample_slab(const Terrain<Dim>& terrain, const Slab& slab, const SnowKind<Dim>& kind) {
  check_kind(kind);
  Vec<Dim> from, size;
  from[0] = slab.at, size[0] = slab.length;
  if constexpr (Dim == 3) from[1] = slab.y.from, size[1] = slab.y.to - slab.y.from;
  from[Dim - 1] = slab.base, size[Dim - 1] = slab.thickness;
  check(from.allFinite(), "the slab's place must be finite");
  Particles<Dim> lattice = sample_box<Dim>({from, from + size}, kind);
  for (Vec<Dim>& x : lattice.position) x = terrain.position(Vec<Dim - 1>(x.template head<Dim - 1>()), x[Dim - 1]);
  return lattice;
}

Particles<3> sample_area(const HeightField& ground, const GroundLayer& layer, const SnowKind<3>& kind,
                         const std::function<bool(const Vec<2>&)>& accepts) {
  check_kind(kind);
  Particles<3> snow;
  for (const FilledPlace& place : fill_ground(ground, layer, accepts))
    append(snow, place.position, kind, kind.first_id + snow.size());
  return snow;
}

template <int Dim>
Particles<Dim> sample_box(const Box<Dim>& box, const SnowKind<Dim>& kind) {
  check_kind(kind);
  check(box.lower.allFinite() && box.upper.allFinite(), "the corners of the release must be finite");
  Index<Dim> shape;
  for (int axis = 0; axis < Dim; ++axis) {
    const double n = std::round(box.size()[axis] / kind.spacing);
    check(n < 1e9, "more than 1e9 particles along an axis");
    shape[axis] = static_cast<int>(std::max(n, 0.0));
  }
  Particles<Dim> particles;
  for_each_index<Dim>(shape, [&](const Index<Dim>& i) {
    Vec<Dim> x = box.lower;
    for (int axis = 0; axis < Dim; ++axis) x[axis] += (i[axis] + 0.5) * kind.spacing;
    append(particles, x, kind, kind.first_id + particles.size());
  });
  return particles;
}

template <int Dim>
NearestNeighbours nearest_neighbours(std::span<const Vec<Dim>> positions) {
  NearestNeighbours result;
  if (positions.size() < 2) return result;
  const Points<Dim> points{positions};
  const Tree<Dim> tree(Dim, points, nanoflann::KDTreeSingleIndexAdaptorParams(tree_leaf));
  std::vector<double> distance(positions.size());
  parallel_for(positions.size(), [&](std::size_t i) {
    std::array<std::uint32_t, 2> number{};
    std::array<double, 2> squared{};
    tree.knnSearch(positions[i].data(), 2, number.data(), squared.data());
    distance[i] = std::sqrt(squared[1]);
  });
  result.mean = parallel_sum(distance.size(), 0.0, [&](std::size_t i) { return distance[i]; }) /
                static_cast<double>(distance.size());
  result.least = *std::min_element(distance.begin(), distance.end());
  return result;
}

#define INSTANTIATE(Dim)                                                                              \
  template void append<Dim>(Particles<Dim>&, const Vec<Dim>&, const SnowKind<Dim>&, std::uint64_t);   \
  template Cover<Dim> bare_cover<Dim>(const CoverLayer&, const SnowKind<Dim>&);                       \
  template Cover<Dim> sample_cover<Dim>(const Terrain<Dim>&, const CoverLayer&, const SnowKind<Dim>&, \
                                        std::span<const Box<Dim>>);                                   \
  template Particles<Dim> sample_slab<Dim>(const Terrain<Dim>&, const Slab&, const SnowKind<Dim>&);   \
  template Particles<Dim> sample_box<Dim>(const Box<Dim>&, const SnowKind<Dim>&);                     \
  template NearestNeighbours nearest_neighbours<Dim>(std::span<const Vec<Dim>>);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
