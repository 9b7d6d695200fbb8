#include "entrainment/entrainment.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>
#include <utility>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"

namespace spindrift {
namespace {

constexpr double contact_radius = 1.5;                       // of d
constexpr double exposure_radius = 1.5;                      // of d
constexpr double exposure_cosine = std::numbers::sqrt2 / 2;  // of 45 degrees
constexpr double least_cos_slope = 0.1;

/// Marks a slot that leaves the cover in this step.
constexpr double passed = std::numeric_limits<double>::infinity();

/// Area of a particle's disc, Eq. (16) [m^(Dim-1)].
template <int Dim>
double disc(double d) {
  return Dim == 2 ? d : std::numbers::pi / 4 * d * d;
}

/// The dense flow and the cover over a ground bin and the bins that touch it.
template <int Dim>
struct Surroundings {
  static constexpr std::size_t n_bins = Dim == 2 ? 3 : 9;
  std::array<const Column<Dim>*, n_bins> dense{};
  std::array<std::span<const std::uint32_t>, n_bins> cover{};
  double lowest = std::numeric_limits<double>::infinity();  ///< normal distance of the lowest dense particle [m]

  Surroundings(const GroundBin<Dim>& bin, const Cover<Dim>& all_cover, const Columns<Dim>& columns) {
    std::size_t n = 0;
    for_each_bin_around<Dim>(bin, [&](const GroundBin<Dim>& near) {
      if (const Column<Dim>* column = columns.find(near)) {
        dense[n] = column;
        lowest = std::min(lowest, columns.foot[columns.over_bin(*column).front()].distance);
      }
      cover[n++] = all_cover.slots_in(near);
    });
  }
};

/// Whether dense snow faster than `least_speed` is near the slot: a column, or what flies over one. (Particles of a
/// column at rest still jitter, by what gravity gives in a step.) Normal distance is 1-Lipschitz, so the search up each
/// column ends where it exceeds the slot's by the radius.
template <int Dim>
bool in_contact(const Cover<Dim>& cover, std::uint32_t slot, const Surroundings<Dim>& around,
                const Particles<Dim>& dense, const Columns<Dim>& columns, double least_speed) {
  const double radius = contact_radius * cover.spacing;
  const double highest = cover.foot[slot].distance + radius;
  const auto moves = [&](const Vec<Dim>& velocity) { return velocity.squaredNorm() > least_speed * least_speed; };
  for (const Column<Dim>* column : around.dense) {
    if (column == nullptr) continue;
    const bool column_moves = moves(column->velocity);
    for (std::uint32_t k = column_moves ? column->first : column->end_standing; k < column->end; ++k) {
      const std::uint32_t i = columns.members[k];
      if (columns.foot[i].distance > highest) break;
      if ((k < column->end_standing || moves(dense.velocity[i])) &&
          (dense.position[i] - cover.particles.position[slot]).squaredNorm() < radius * radius)
        return true;
    }
  }
  return false;
}

/// Whether no live cover lies above the slot, within 45 degrees of its normal.
template <int Dim>
bool exposed(const Cover<Dim>& cover, std::uint32_t slot, const Surroundings<Dim>& around) {
  const double radius = exposure_radius * cover.spacing;
  const Foot<Dim>& foot = cover.foot[slot];
  for (const auto& slots : around.cover)
    for (const std::uint32_t other : slots) {
      if (cover.foot[other].distance <= foot.distance) break;
      if (!cover.alive(other)) continue;
      const Vec<Dim> to_other = cover.particles.position[other] - cover.particles.position[slot];
      const double r = to_other.norm();
      if (r < radius && to_other.dot(foot.normal) > exposure_cosine * r) return false;
    }
  return true;
}

}  // namespace

template <int Dim>
struct Entrainment<Dim>::View {
  const Cover<Dim>& cover;
  const Particles<Dim>& dense;
  const Columns<Dim>& columns;
  const Vec<Dim>& gravity;
  double dt;
  double viscosity;  ///< eta [Pa s]
};

template <int Dim>
void Entrainment<Dim>::find_patches(const Cover<Dim>& cover, const Columns<Dim>& columns) {
  patches_.clear();
  std::uint32_t n = 0;
  const auto add = [&](const GroundBin<Dim>& bin, double area) {
    const auto n_slots = static_cast<std::uint32_t>(cover.slots_in(bin).size());
    if (n_slots == 0) return;
    patches_.push_back({bin, area, n, n});
    n += n_slots;
  };
  if (options_.spontaneous) {
    for_each_index<Dim - 1>(cover.shape, [&](GroundBin<Dim> bin) {
      for (int k = 0; k < Dim - 1; ++k) bin[k] += cover.lower[k];
      add(bin, cover.ground_area(bin));
    });
  } else {
    for (const Column<Dim>& column : columns.columns)
      if (column.thickness > 0) add(column.bin, column.area);
  }
  candidates_.resize(n);
}

template <int Dim>
void Entrainment<Dim>::find_candidates(Patch& patch, const View& view) {
  const Cover<Dim>& cover = view.cover;
  const Column<Dim>* column = view.columns.find(patch.bin);
  const Surroundings<Dim> around(patch.bin, cover, view.columns);
  double mass_above = column == nullptr ? 0 : column->mass_per_area * patch.area;
  const double traction = column == nullptr ? 0 : column->friction.norm() / (patch.area * view.dt);
  bool top = true;
  for (const std::uint32_t slot : cover.slots_in(patch.bin)) {
    if (!cover.alive(slot)) continue;
    const bool in_reach = cover.foot[slot].distance + contact_radius * cover.spacing >= around.lowest;
    if (!in_reach && !options_.spontaneous) break;
    const bool bare = std::exchange(top, false);
    const Vec<Dim>& normal = cover.foot[slot].normal;
    const double g_normal = -view.gravity.dot(normal), g = view.gravity.norm();
    double overburden = mass_above / patch.area;
    if (options_.column == OverburdenColumn::vertical) overburden /= std::max(g_normal / g, least_cos_slope);
    mass_above += cover.particles.mass[slot];

    const double g_tangential = (view.gravity + g_normal * normal).norm();
    const double rate = strain_rate(overburden, g_tangential, view.viscosity, traction, options_.friction_factor);
    if (!(rate > failure_strain_rate(options_.threshold, cover.initial_depth(slot), cover.thickness))) continue;
    if (!options_.spontaneous && !in_contact(cover, slot, around, view.dense, view.columns, options_.least_speed))
      continue;
    if (options_.rule == EntrainmentRule::clock && !bare && !exposed(cover, slot, around)) continue;
    candidates_[patch.end++] = slot;
  }
}

template <int Dim>
void Entrainment<Dim>::run_clocks(const Patch& patch, Cover<Dim>& cover, const EntrainmentStep& step) const {
  const std::span<const std::uint32_t> slots{candidates_.data() + patch.first, patch.end - patch.first};
  double mass = 0;
  for (const std::uint32_t slot : slots) mass += cover.particles.mass[slot];
  double time = step.dt;
  for (std::size_t n_left = slots.size(); n_left > 0; --n_left) {
    std::uint32_t next = 0;
    double least = passed;
    for (const std::uint32_t slot : slots) {
      if (cover.hazard[slot] == passed) continue;
      const double to_go =
          exponential(step.seed, RandomStream::entrainment_clock, cover.particles.id[slot]) - cover.hazard[slot];
      if (to_go < least) least = to_go, next = slot;
    }
    const double rate = options_.rate * patch.area / mass;
    const bool goes = least <= rate * time;
    const double advance = goes ? std::max(least, 0.0) : rate * time;
    for (const std::uint32_t slot : slots) cover.hazard[slot] += advance;
    if (!goes) return;
    cover.hazard[next] = passed;
    mass -= cover.particles.mass[next];
    time -= advance / rate;
  }
}

template <int Dim>
double Entrainment<Dim>::flux(const Patch& patch, const Cover<Dim>& cover) const {
  if (options_.rule == EntrainmentRule::clock) return options_.rate;
  return options_.rate * disc<Dim>(cover.spacing) * (patch.end - patch.first) / patch.area;
}

template <int Dim>
void Entrainment<Dim>::draw(const Patch& patch, Cover<Dim>& cover, const EntrainmentStep& step) const {
  const double d = cover.spacing;
  const double probability = options_.rate * disc<Dim>(d) * step.dt / (cover.density * std::pow(d, Dim));
  for (std::uint32_t k = patch.first; k < patch.end; ++k) {
    const std::uint32_t slot = candidates_[k];
    const double u = uniform(step.seed, RandomStream::bernoulli, cover.particles.id[slot], step.number);
    if (u < probability) cover.hazard[slot] = passed;
  }
}

template <int Dim>
const Particles<Dim>& Entrainment<Dim>::take(Cover<Dim>& cover, const Particles<Dim>& dense,
                                             const Columns<Dim>& columns, const Vec<Dim>& gravity,
                                             const EntrainmentStep& step) {
  SPINDRIFT_CHECK(step.dt > 0);
  SPINDRIFT_CHECK(columns.foot.size() == dense.size());
  find_patches(cover, columns);
  const View view{cover, dense, columns, gravity, step.dt, cover_viscosity(cover.density)};
  parallel_for(
      patches_.size(), [&](std::size_t p) { find_candidates(patches_[p], view); }, 32);
  const bool clock = options_.rule == EntrainmentRule::clock;
  parallel_for(
      patches_.size(),
      [&](std::size_t p) { clock ? run_clocks(patches_[p], cover, step) : draw(patches_[p], cover, step); }, 256);

  taken_.clear();
  bins_taken_.clear();
  fluxes_.clear();
  for (const Patch& patch : patches_) {
    if (patch.end == patch.first) continue;
    fluxes_.push_back({patch.bin, flux(patch, cover)});
    const std::size_t before = taken_.size();
    for (std::uint32_t k = patch.first; k < patch.end; ++k)
      if (cover.hazard[candidates_[k]] == passed) taken_.push_back(candidates_[k]);
    if (taken_.size() > before) bins_taken_.push_back(patch.bin);
  }
  std::sort(taken_.begin(), taken_.end(),
            [&](std::uint32_t i, std::uint32_t j) { return cover.particles.id[i] < cover.particles.id[j]; });

  entrained_.resize(0);
  mass_taken_ = 0;
  for (const std::uint32_t slot : taken_) {
    mass_taken_ += cover.particles.mass[slot];
    entrained_.push_back_from(cover.particles, slot);
    entrained_.entrained_at.back() = step.time;
    remove_from_cover(cover, slot);
  }
  if (!compact_cover(cover)) settle_surface<Dim>(cover, bins_taken_);
  return entrained_;
}

template class Entrainment<2>;
template class Entrainment<3>;

}  // namespace spindrift
