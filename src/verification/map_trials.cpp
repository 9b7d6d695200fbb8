#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <numeric>

#include "core/random.hpp"
#include "verification/stability.hpp"

namespace spindrift {
namespace {

constexpr std::uint64_t seed = 1;
constexpr double air_density = 1.2;  // [kg m^-3], the default

/// One axis of the hypercube.
struct Axis {
  const char* name;
  double from, to;
  bool logarithmic = true;

  double at(double share) const { return logarithmic ? from * std::pow(to / from, share) : from + share * (to - from); }
};

constexpr std::array axes{Axis{"dense CFL", 0.02, 1},
                          Axis{"air CFL", 0.1, 100},
                          Axis{"k_drag", 1e-2, 1e6},
                          Axis{"snow / gas density", 0.1, 1e5},
                          Axis{"air / smoke density, 1 / r_s - 1", 1e-4, 1e4},
                          Axis{"slope [deg]", 1, 89, false},
                          Axis{"air viscosity [m2/s]", 1e-6, 1e4},
                          Axis{"snow viscosity [Pa s]", 1e-3, 1e6}};

/// The numbers 0 to n - 1 in an order of chance.
std::vector<std::size_t> shuffled(std::size_t n, std::uint64_t stream) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::vector<double> key(n);
  for (std::size_t i = 0; i < n; ++i)
    key[i] = uniform(seed, RandomStream::stability_map, i, static_cast<std::uint32_t>(stream));
  std::ranges::sort(order, {}, [&](std::size_t i) { return key[i]; });
  return order;
}

}  // namespace

std::vector<Trial> map_trials(int n) {
  const auto count = static_cast<std::size_t>(n);
  std::vector<Trial> trials(count);
  std::array<std::vector<std::size_t>, axes.size()> order;
  for (std::size_t a = 0; a < axes.size(); ++a) order[a] = shuffled(count, a);
  for (std::size_t i = 0; i < count; ++i) {
    std::array<double, axes.size()> value{};
    for (std::size_t a = 0; a < axes.size(); ++a) {
      const double inside = uniform(seed, RandomStream::stability_map, i, static_cast<std::uint32_t>(axes.size() + a));
      value[a] = axes[a].at((static_cast<double>(order[a][i]) + inside) / static_cast<double>(n));
      trials[i].parameters.emplace_back(axes[a].name, value[a]);
    }
    const double smoke = std::min(1e4, air_density / value[4]);
    const double snow = std::min(1e5, value[3] * (air_density + smoke));
    const auto& [dense_cfl, air_cfl, k_drag, mass_ratio, lightness, angle, air_viscosity, snow_viscosity] = value;
    trials[i].beyond = mass_ratio < 1;
    trials[i].set = "map";
    trials[i].name = fmt::format("point {}", i + 1);
    trials[i].scene = "verification/extreme_slope.toml";
    trials[i].settings = {"scene.max_step=10",
                          fmt::format("dense_flow.cfl={}", dense_cfl),
                          fmt::format("suspension.cfl={}", air_cfl),
                          fmt::format("coupling.drag.constant={}", k_drag),
                          fmt::format("coupling.drag.law={}", i % 2 == 0 ? "air" : "paper"),
                          fmt::format("dense_flow.density={}", snow),
                          fmt::format("smoke.density={}", smoke),
                          fmt::format("terrain.angle={} deg", angle),
                          fmt::format("terrain.drop={}", std::min(6.0, 10 * std::tan(angle * std::numbers::pi / 180))),
                          fmt::format("suspension.viscosity={}", air_viscosity),
                          fmt::format("dense_flow.viscosity={}", snow_viscosity)};
  }
  return trials;
}

}  // namespace spindrift
