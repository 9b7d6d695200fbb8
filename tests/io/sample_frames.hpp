#pragma once

#include <numeric>

#include "io/vtkhdf.hpp"

namespace spindrift {

/// Some particles in 2D with an array of each type.
struct SampleCloud {
  std::vector<double> positions;
  std::vector<float> velocity;
  std::vector<double> mass;
  std::vector<std::uint8_t> layer;
  std::vector<std::int64_t> id;

  explicit SampleCloud(std::size_t n) {
    for (std::size_t i = 0; i < n; ++i) {
      const double s = static_cast<double>(i);
      positions.insert(positions.end(), {s, 100 - 2 * s});
      velocity.insert(velocity.end(), {static_cast<float>(s / 2), static_cast<float>(-s)});
      mass.push_back(1 / (1 + s));
      layer.push_back(i % 2);
      id.push_back(static_cast<std::int64_t>(i) - (std::int64_t{1} << 62));
    }
  }
  PointCloud view() const {
    return {{"x", 2, std::span(positions)},
            {{"velocity", 2, std::span(velocity)},
             {"mass", 1, std::span(mass)},
             {"layer", 1, std::span(layer)},
             {"id", 1, std::span(id)}},
            {{"time", 1.0 / 3}, {"scene", "[scene]\nname = \"Zürs\"\n"}, {"seed", std::int64_t{-7}}}};
  }
};

/// A lattice of nx x ny x nz points, density = number of the point, velocity of `components`.
struct SampleImage {
  Lattice lattice;
  int components;
  std::vector<float> density;
  std::vector<double> velocity;

  SampleImage(std::int64_t nx, std::int64_t ny, std::int64_t nz)
      : lattice{{nx, ny, nz}, {5, ny == 1 ? 77.0 : 6.0, 7}, {0.5, 0.25, 2}}, components(ny == 1 ? 2 : 3) {
    density.resize(lattice.n_points());
    std::iota(density.begin(), density.end(), 0.0f);
    velocity.resize(lattice.n_points() * static_cast<std::size_t>(components));
    std::iota(velocity.begin(), velocity.end(), 0.5);
  }
  LatticeImage view() const {
    return {
        lattice, {{"density", 1, std::span(density)}, {"velocity", components, std::span(velocity)}}, {{"time", 2.5}}};
  }
};

}  // namespace spindrift
