#pragma once
/// Smoke in a picture of three dimensions: how it dims what is behind it, and how it is lit.

#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "core/vec.hpp"

namespace spindrift {

/// Smoke density on the centres of cubic cells, x fastest. Values that are negative or not finite count as none.
struct SmokeLattice {
  std::span<const float> density;       ///< [kg m^-3], one a cell
  Index<3> shape{};                     ///< cells
  Vec<3> origin = Vec<3>::Zero();       ///< centre of the first cell [m]
  double spacing = 1;                   ///< [m]
  std::span<const std::uint8_t> solid;  ///< 1: the cell lies in the ground; empty: none does
};

/// Where light comes from.
struct Light {
  Vec<3> sun = Vec<3>(-0.5, -0.5, 0.70710678).normalized();  ///< unit, towards it
  Vec<3> up = Vec<3>::UnitZ();                               ///< unit, to the middle of the sky
};

/// Share of the light that comes through smoke straight or after more turns, where `straight` comes through straight:
/// what is turned once more by smoke as bright as snow is not lost. It is dimmed by a quarter of the extinction.
inline float with_turned(float straight) {
  constexpr float turned = 0.45f;
  return (1 - turned) * straight + turned * std::sqrt(std::sqrt(straight));
}

class SmokeVolume {
 public:
  /// What a ray has met so far.
  struct Seen {
    float sun = 0, sky = 0;  ///< light of either kind that the smoke turned towards the eye, of 1 each
    float clear = 1;         ///< share of what is behind that is seen through it
  };

  SmokeVolume() = default;

  /// Takes what it needs of the lattice: the block of cells that have smoke, averaged over 2^3, 3^3, ... cells where it
  /// has over `most_cells`. The ground's cells take the mean of their neighbours in the air, so that smoke reaches the
  /// ground; two layers of them. Then each cell takes half of itself and a quarter of both neighbours along each axis,
  /// or the staircase of the cells along a slope would show: as much smoke, spread by a cell.
  /// opaque: density that hides 63 % of what is behind one metre of it [kg m^-3]; extinction = density / opaque [1/m]
  SmokeVolume(const SmokeLattice& lattice, double opaque, const Light& light, std::size_t most_cells = 6'000'000);

  bool empty() const { return extinction_.empty(); }

  /// Between the cells' centres by the eight around, 0 outside [1/m].
  float extinction(const Vec<3>& x) const;

  /// Share of the light that comes through the smoke to x: of the sun, exp(-integral of the extinction along the way),
  /// anywhere; of the sky, the mean over some directions, that outside nears 1 over some cells.
  float sunlight(const Vec<3>& x) const;
  float skylight(const Vec<3>& x) const;

  /// Goes along eye + t direction through the smoke, front to back from t = `from` to `to`, and adds to what is seen,
  /// over the length of the way:
  ///   clear' = -extinction clear,  sun' = extinction clear with_turned(sunlight(x)),  sky likewise.
  /// jitter: where in each step of a third of a cell the sample is taken, 0 to 1
  void pass(Seen& seen, const Vec<3>& eye, const Vec<3>& direction, double from, double to, double jitter) const;

 private:
  using Values = std::vector<float>;
  static constexpr int block = 4;  ///< cells along the edge of a block that is skipped where it is clear
  struct Corner;

  std::size_t at(int i, int j, int k) const {
    return (static_cast<std::size_t>(k) * static_cast<std::size_t>(shape_[1]) + static_cast<std::size_t>(j)) *
               static_cast<std::size_t>(shape_[0]) +
           static_cast<std::size_t>(i);
  }
  void take(const SmokeLattice& lattice, double opaque, std::size_t most_cells);
  Values depth_towards(const Vec<3>& light) const;
  void extend_into_ground(std::vector<std::uint8_t>& unknown);
  void spread();
  void mark_blocks();
  float between(const Values& values, const Corner& corner) const;
  bool range(const Vec<3>& eye, const Vec<3>& direction, double& from, double& to) const;

  Index<3> shape_{};                ///< with a rim of cells without smoke
  Vec<3> origin_ = Vec<3>::Zero();  ///< centre of the first cell [m]
  double spacing_ = 1;              ///< [m]
  Light light_;
  Values extinction_;  ///< [1/m]
  Values sunlight_, skylight_;
  Index<3> blocks_{};                ///< of block^3 cells
  std::vector<std::uint8_t> smoky_;  ///< a block: whether anything in it or just beside it has smoke
};

}  // namespace spindrift
