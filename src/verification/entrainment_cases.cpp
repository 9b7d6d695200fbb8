#include <fmt/format.h>

#include <cmath>

#include "verification/case_groups.hpp"

namespace spindrift {
namespace {

/// The stretch of ground that the slab covers from the start to the end [m along the ground].
constexpr double stretch_from = 16, stretch_to = 216;

double cover_on_stretch(const Simulation<2>& simulation) {
  const Cover<2>& cover = *simulation.cover();
  double mass = 0;
  for (std::size_t slot = 0; slot < cover.particles.size(); ++slot)
    if (cover.foot[slot].place[0] >= stretch_from && cover.foot[slot].place[0] < stretch_to)
      mass += cover.particles.mass[slot];
  return mass;
}

/// Mass that has gone. The clock takes a Poisson number of particles at the flux Er; by Eq. (16) as it stands each
/// particle of the cover goes at the rate Er S / m, and their number is binomial.
Comparison<2> compare_entrainment_flux(const Simulation<2>& start) {
  return {{}, [before = cover_on_stretch(start)](const Simulation<2>& end) {
            const EntrainmentSection& rule = *end.scene().entrainment;
            const double d = end.cover()->spacing, particle = end.cover()->density * d * d;
            const double all_go = rule.rate * (stretch_to - stretch_from) * end.time();
            const double stays = std::exp(-rule.rate * d / particle * end.time());
            const bool clock = rule.rule == "clock";
            const double reference = clock ? all_go : before * (1 - stays);
            const double spread = std::sqrt(reference * particle * (clock ? 1 : stays));
            ErrorNorms mass;
            mass.add(before - cover_on_stretch(end), reference);
            return Outcome{mass.l2(),
                           mass.max(),
                           {{"distance from the law in standard deviations", mass.l2() * reference / spread, 4}}};
          }};
}

}  // namespace

std::vector<Case> entrainment_cases() {
  Case flux;
  flux.name = "entrainment_flux";
  flux.title = "A slab takes up the snow below it at the rate Er, whatever the time step";
  flux.reference = "Er A t; rule bernoulli: all of the cover fails, M0 (1 - exp(-Er S t / m))";
  flux.source = "Eq. (16) per area, departure R15";
  flux.quantity = "mass taken from 200 m of ground";
  flux.scene = "verification/entrainment_flux.toml";
  Series steps{"time step", "clock", {}, {}};
  for (const double ms : {10.0, 3.0, 1.0, 0.3, 0.1})
    steps.levels.push_back(
        {fmt::format("{} ms", ms), {fmt::format("scene.max_step={} ms", ms)}, 0, 4 / std::sqrt(2000)});
  Series literal = with_settings(steps, "rule", "bernoulli", {"entrainment.rule=bernoulli"});
  literal.levels.resize(3);
  flux.series = {steps, literal, over_values(steps, 1, "spacing", "dense_flow.support_radius", {"0.4", "0.2", "0.1"}),
                 over_values(steps, 1, "seed", "scene.seed", {"1", "2", "3", "4", "5"})};
  flux.quick = true;
  flux.remark =
      "The gate is four standard deviations, 2.2 % each with 2000 particles. The particles' clocks are the same at "
      "all time steps, so that the levels differ by what a long step misses: a bin of ground may run out of "
      "candidates before its end, at most Er A dt / 2 m, 10 % at 10 ms. By rule bernoulli the probability of a step "
      "is Er S dt / m: too much is taken in long steps.";
  flux.compare = Compare<2>(compare_entrainment_flux);
  return {flux};
}

}  // namespace spindrift
