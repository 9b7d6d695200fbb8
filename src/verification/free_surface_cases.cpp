#include <array>
#include <cmath>
#include <memory>

#include "verification/case_groups.hpp"
#include "verification/curve.hpp"

namespace spindrift {
namespace {

/// x up to which the bottom slab of `height` is at least half full of snow, in columns of `width` [m].
double bulk_front(const Simulation<2>& simulation, double width, double height) {
  const Particles<2>& p = simulation.dense()->particles;
  std::vector<double> filled(static_cast<std::size_t>(simulation.walls().domain.size()[0] / width) + 1);
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.position[i][1] < height) filled[static_cast<std::size_t>(p.position[i][0] / width)] += p.volume[i];
  double front = 0;
  for (std::size_t c = 0; c < filled.size(); ++c)
    if (filled[c] >= 0.5 * width * height) front = width * static_cast<double>(c + 1);
  return front;
}

double height_at_left_wall(const Simulation<2>& simulation, double width) {
  const Particles<2>& p = simulation.dense()->particles;
  double volume = 0;
  for (std::size_t i = 0; i < p.size(); ++i)
    if (p.position[i][0] < width) volume += p.volume[i];
  return volume / width;
}

Comparison<2> compare_martin_moyce(const Simulation<2>& start) {
  // Z = x / a over T = t sqrt(2 g / a), and H = height at the wall / 2 a over t sqrt(g / a); a = 1 m.
  static const Curve measured_front{{0.41, 1.11}, {0.84, 1.22}, {1.19, 1.44}, {1.43, 1.67}, {1.63, 1.89},
                                    {1.83, 2.11}, {1.98, 2.33}, {2.20, 2.56}, {2.32, 2.78}, {2.51, 3.00},
                                    {2.65, 3.22}, {2.83, 3.44}, {2.98, 3.67}, {3.11, 3.89}, {3.33, 4.11}};
  static const Curve measured_height{{0.56, 0.94}, {0.93, 0.83}, {1.46, 0.67}, {2.00, 0.50}, {2.45, 0.39}};
  struct Seen {
    Curve front, height;
  };
  const auto seen = std::make_shared<Seen>();
  const double g = 9.81, d = start.dense()->options().spacing();
  return {[seen, g, d](const Simulation<2>& now) {
            seen->front.push_back({now.time() * std::sqrt(2 * g), bulk_front(now, 2 * d, 0.2)});
            seen->height.push_back({now.time() * std::sqrt(g), height_at_left_wall(now, 4 * d) / 2});
          },
          [seen](const Simulation<2>&) {
            ErrorNorms front;
            for (const auto& [T, Z] : measured_front) front.add(interpolated(seen->front, T) / Z, 1);
            double height = 0;
            for (const auto& [T, H] : measured_height)
              height = std::max(height, std::abs(interpolated(seen->height, T) - H));
            const double slope = (interpolated(seen->front, 3.33) - interpolated(seen->front, 1.43)) / (3.33 - 1.43);
            return Outcome{front.l2(),
                           front.max(),
                           {{"height at the wall, largest error in first heights", height, 0.05},
                            {"speed of the front, relative error", std::abs(slope / 1.319 - 1), 0.1}}};
          }};
}

}  // namespace

std::vector<Case> free_surface_cases() {
  Case dam_break;
  dam_break.name = "dam_break";
  dam_break.title = "A column of water, twice as high as wide, falls apart";
  dam_break.reference = "measured front Z = x / a over T = t sqrt(2 g / a) and height at the wall";
  dam_break.source = "Martin and Moyce 1952, n^2 = 2";
  dam_break.quantity = "front, relative, at 15 times";
  dam_break.scene = "dam_break.toml";
  const Series refined{"resolution",
                       "dfsph",
                       {"scene.end_time=0.8 s"},
                       {{"a/d = 20", {"dense_flow.support_radius=0.1"}, 0.05, 0.1},
                        {"a/d = 40", {"dense_flow.support_radius=0.05"}, 0.025, 0.1},
                        {"a/d = 80", {"dense_flow.support_radius=0.025"}, 0.0125, 0.1}}};
  dam_break.series = {
      refined, with_settings(refined, "solver", "wcsph", {"dense_flow.solver=wcsph"}),
      over_values(refined, 1, "tolerance", "dense_flow.divergence_tolerance", {"10", "1", "0.1", "0.01"}),
      over_values(refined, 1, "time step", "dense_flow.cfl", {"0.8", "0.4", "0.2", "0.1"})};
  dam_break.quick = true;
  dam_break.remark =
      "The front is where the bottom slab, a tenth of the first height, is half full: the thin tip itself runs ahead "
      "of "
      "what was measured.";
  dam_break.compare = Compare<2>(compare_martin_moyce);
  return {dam_break};
}

}  // namespace spindrift
