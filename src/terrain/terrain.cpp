#include "terrain/terrain.hpp"

#include "core/parallel.hpp"

namespace spindrift {
namespace {

Vec<2> in_profile(const Vec<2>& x) {
  return x;
}
Vec<2> in_profile(const Vec<3>& x) {
  return {x[0], x[2]};
}

template <int Dim>
Vec<Dim> lifted(const Vec<2>& v, double y) {
  if constexpr (Dim == 2) {
    return v;
  } else {
    return {v[0], y, v[1]};
  }
}

}  // namespace

template <int Dim>
Foot<Dim> Terrain<Dim>::foot(const Vec<Dim>& x, double reach, double certain) const {
  if constexpr (Dim == 2) {
    return profile()->foot(x, reach);
  } else {
    if (const HeightField* field = height_field()) return field->foot(x, reach, certain);
    const Foot<2> at = profile()->foot(in_profile(x), reach);
    return {at.distance, lifted<Dim>(at.normal, 0), {at.place[0], x[1]}};
  }
}

template <int Dim>
void Terrain<Dim>::find_feet(std::vector<Foot<Dim>>& feet, std::span<const Vec<Dim>> positions, double reach,
                             double certain) const {
  feet.resize(positions.size());
  parallel_for(positions.size(), [&](std::size_t i) {
    feet[i] = positions[i].allFinite() ? foot(positions[i], reach, certain) : nowhere<Dim>;
  });
}

template <int Dim>
Vec<Dim> Terrain<Dim>::position(const Vec<Dim - 1>& place, double distance) const {
  if constexpr (Dim == 3)
    if (const HeightField* field = height_field()) return field->position(place, distance);
  return lifted<Dim>(profile()->position(place[0], distance), place[Dim - 2]);
}

template <int Dim>
double Terrain<Dim>::height(const Vec<Dim>& x) const {
  if constexpr (Dim == 3)
    if (const HeightField* field = height_field()) return field->height(x.template head<2>());
  return profile()->height(x[0]);
}

template <int Dim>
bool Terrain<Dim>::clears(const Vec<Dim>& x, double reach) const {
  if constexpr (Dim == 3)
    if (const HeightField* field = height_field()) return field->clears(x, reach);
  return false;
}

template <int Dim>
double Terrain<Dim>::area_ratio(const Vec<Dim - 1>& place) const {
  if constexpr (Dim == 3)
    if (const HeightField* field = height_field()) return 1 / cos_slope<3>(field->normal(place));
  return 1;
}

template <int Dim>
std::size_t Terrain<Dim>::bytes() const {
  return height_field() ? height_field()->bytes() : profile()->bytes();
}

template class Terrain<2>;
template class Terrain<3>;

}  // namespace spindrift
