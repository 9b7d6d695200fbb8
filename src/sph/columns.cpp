#include "sph/columns.hpp"

#include <algorithm>

#include "core/error.hpp"
#include "core/parallel.hpp"

namespace spindrift {
namespace {

template <int Dim>
std::size_t hash(const GroundBin<Dim>& bin) {
  std::uint64_t h = 0;
  for (const int b : bin) h = (h ^ static_cast<std::uint32_t>(b)) * 0x9e3779b97f4a7c15u;
  return static_cast<std::size_t>(h >> 20);
}

/// The place in the table of `bin`, or the free one where it would go.
template <int Dim>
std::size_t probe(const Columns<Dim>& columns, const GroundBin<Dim>& bin) {
  const std::size_t mask = columns.table.size() - 1;
  std::size_t place = hash<Dim>(bin) & mask;
  while (columns.table[place] != 0 && columns.columns[columns.table[place] - 1].bin != bin) place = (place + 1) & mask;
  return place;
}

template <int Dim>
void grow_table(Columns<Dim>& columns) {
  columns.table.assign(std::max<std::size_t>(64, 4 * columns.table.size()), 0);
  for (std::uint32_t c = 0; c < columns.columns.size(); ++c)
    columns.table[probe(columns, columns.columns[c].bin)] = c + 1;
}

template <int Dim>
std::uint32_t column_at(Columns<Dim>& columns, const GroundBin<Dim>& bin) {
  if (2 * columns.columns.size() >= columns.table.size()) grow_table(columns);
  std::uint32_t& entry = columns.table[probe(columns, bin)];
  if (entry == 0) {
    columns.columns.push_back({.bin = bin});
    entry = static_cast<std::uint32_t>(columns.columns.size());
  }
  return entry - 1;
}

/// Counting sort of the particles by column, without order within a column.
template <int Dim>
void sort_by_column(Columns<Dim>& columns) {
  for (const std::uint32_t c : columns.column) ++columns.columns[c].end;
  std::uint32_t n = 0;
  for (Column<Dim>& c : columns.columns) {
    c.first = n;
    n += c.end;
    c.end = c.first;
  }
  columns.heights.resize(columns.column.size());
  columns.members.resize(columns.column.size());
  for (std::uint32_t i = 0; i < columns.column.size(); ++i)
    columns.heights[columns.columns[columns.column[i]].end++] = {columns.foot[i].distance, i};
}

template <int Dim>
void sort_by_height(const Column<Dim>& c, Columns<Dim>& columns, const Particles<Dim>& dense) {
  using Height = typename Columns<Dim>::Height;
  Height* const sorted = columns.heights.data();
  std::sort(sorted + c.first, sorted + c.end, [&dense](const Height& a, const Height& b) {
    return a.distance != b.distance ? a.distance < b.distance : dense.id[a.particle] < dense.id[b.particle];
  });
  for (std::uint32_t k = c.first; k < c.end; ++k) columns.members[k] = sorted[k].particle;
}

template <int Dim>
void measure(Column<Dim>& c, const Columns<Dim>& columns, const Particles<Dim>& dense, double spacing, double gap) {
  c.end_standing = c.first;
  double top = c.bed, volume = 0, mass = 0;
  Vec<Dim> momentum = Vec<Dim>::Zero();
  for (const std::uint32_t i : columns.over_bin(c)) {
    const double distance = columns.foot[i].distance;
    if (!(distance - spacing / 2 - top <= gap)) break;
    top = std::max(top, distance + spacing / 2);
    volume += dense.volume[i];
    mass += dense.mass[i];
    momentum += dense.mass[i] * dense.velocity[i];
    ++c.end_standing;
  }
  if (c.end_standing == c.first) return;
  c.thickness = std::max(volume / c.area, spacing / 8);
  c.mass_per_area = mass / c.area;
  if (mass > 0) c.velocity = momentum / mass;
}

}  // namespace

template <int Dim>
const Column<Dim>* Columns<Dim>::find(const GroundBin<Dim>& bin) const {
  if (table.empty()) return nullptr;
  const std::uint32_t entry = table[probe(*this, bin)];
  return entry == 0 ? nullptr : &columns[entry - 1];
}

template <int Dim>
void build_columns(Columns<Dim>& columns, const Terrain<Dim>& terrain, std::span<const Foot<Dim>> feet,
                   const Particles<Dim>& dense, const Cover<Dim>* cover, double spacing, double support_radius) {
  SPINDRIFT_CHECK(feet.size() == dense.size());
  SPINDRIFT_CHECK(spacing > 0 && (cover == nullptr || cover->particles.empty() || cover->spacing == spacing));
  const std::size_t n = dense.size();
  columns.bin_size = 2 * spacing;
  columns.columns.clear();
  std::fill(columns.table.begin(), columns.table.end(), 0);
  columns.column.resize(n);
  columns.foot = feet;
  for (std::size_t i = 0; i < n; ++i)
    columns.column[i] = column_at(columns, ground_bin<Dim>(columns.foot[i].place, columns.bin_size));
  sort_by_column(columns);

  parallel_for(
      columns.columns.size(),
      [&](std::size_t k) {
        Column<Dim>& c = columns.columns[k];
        sort_by_height(c, columns, dense);
        c.area = ground_bin_area<Dim>(columns.bin_size) *
                 terrain.area_ratio(ground_bin_centre<Dim>(c.bin, columns.bin_size));
        if (cover != nullptr) c.bed = cover->surface(c.bin);
        measure(c, columns, dense, spacing, support_radius);
      },
      64);
}

#define INSTANTIATE(Dim)                                                                           \
  template struct Columns<Dim>;                                                                    \
  template void build_columns<Dim>(Columns<Dim>&, const Terrain<Dim>&, std::span<const Foot<Dim>>, \
                                   const Particles<Dim>&, const Cover<Dim>*, double, double);
INSTANTIATE(2)
INSTANTIATE(3)
#undef INSTANTIATE

}  // namespace spindrift
