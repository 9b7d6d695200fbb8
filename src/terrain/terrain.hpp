#pragma once
/// The ground: a profile in the x-z plane, in 3D extruded along y, or in 3D a height field.

#include <limits>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "terrain/foot.hpp"
#include "terrain/height_field.hpp"
#include "terrain/profile.hpp"

namespace spindrift {

/// Places are arc lengths along the profile, in 3D also y; on a height field they are (x, y) [m].
template <int Dim>
class Terrain {
 public:
  explicit Terrain(Profile profile) : shape_(std::move(profile)) {}
  /// vertices: of a profile.  Throws as Profile does.
  explicit Terrain(std::vector<Vec<2>> vertices) : shape_(Profile(std::move(vertices))) {}
  explicit Terrain(HeightField field) requires(Dim == 3) : shape_(std::move(field)) {}

  /// The nearest point of the surface; where it is farther than `reach` [m] only the distance's sign is right, and it
  /// is `reach` or more. On a height field, where it is `certain` [m] or farther off, another one may be nearer, but
  /// none is nearer than that (HeightField::foot()).
  Foot<Dim> foot(const Vec<Dim>& x, double reach = std::numeric_limits<double>::infinity(),
                 double certain = std::numeric_limits<double>::infinity()) const;

  /// The foot of every position into `feet`. A position that is not finite counts as infinitely far above the ground.
  void find_feet(std::vector<Foot<Dim>>& feet, std::span<const Vec<Dim>> positions,
                 double reach = std::numeric_limits<double>::infinity(),
                 double certain = std::numeric_limits<double>::infinity()) const;

  /// The position at `place` and normal distance `distance` from the surface: the inverse of foot() where the surface
  /// is smooth.
  Vec<Dim> position(const Vec<Dim - 1>& place, double distance) const;

  /// Height z of the surface over or under x [m]; at a cliff's face the upper edge's.
  double height(const Vec<Dim>& x) const;

  /// Whether x is certainly `reach` [m] or more above the ground, where that is cheap to tell: on a height field.
  bool clears(const Vec<Dim>& x, double reach) const;

  /// Area of ground over area of places: 1 on a profile, 1 / n_z on a height field.
  double area_ratio(const Vec<Dim - 1>& place) const;

  /// Null where the ground is of the other kind; in 2D it is a profile.
  const Profile* profile() const { return std::get_if<Profile>(&shape_); }
  const HeightField* height_field() const {
    if constexpr (Dim == 2) {
      return nullptr;
    } else {
      return std::get_if<HeightField>(&shape_);
    }
  }
  std::size_t bytes() const;

 private:
  std::conditional_t<Dim == 2, std::variant<Profile>, std::variant<Profile, HeightField>> shape_;
};

}  // namespace spindrift
