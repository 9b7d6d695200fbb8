#include <fmt/format.h>

#include <cmath>
#include <map>
#include <memory>
#include <numbers>

#include "simulation/scene_writer.hpp"
#include "verification/case_groups.hpp"

namespace spindrift {
namespace {

template <int Dim>
double particle_radius(const Simulation<Dim>& simulation) {
  return simulation.dense()->options().spacing / 2;
}

/// k of Eq. (10) per mass of snow: the law "air" counts the air that the snow displaces alone.
double drag_constant(const Simulation<2>& simulation) {
  const Scene& scene = simulation.scene();
  const DragSection& drag = *scene.coupling->drag;
  return drag.constant * (drag.law == "paper" ? 1 : scene.suspension->air_density / scene.dense_flow->density);
}

std::vector<Vec<2>> velocities_by_id(const Simulation<2>& simulation) {
  const Particles<2>& p = simulation.dense()->particles;
  std::vector<Vec<2>> v(p.size());
  for (std::size_t i = 0; i < p.size(); ++i) v[p.id[i]] = p.velocity[i];
  return v;
}

/// Every particle counts by its own speed, slow as it may be.
Comparison<2> compare_drag_one_way(const Simulation<2>& start) {
  return {{},
          [rate = drag_constant(start) / particle_radius(start),
           first = velocities_by_id(start)](const Simulation<2>& end) {
            const std::vector<Vec<2>> last = velocities_by_id(end);
            ErrorNorms w;
            for (std::size_t i = 0; i < first.size(); ++i) {
              const Vec<2> along = first[i].normalized(), across(-along[1], along[0]);
              const double reference = first[i].norm() / (1 + rate * first[i].norm() * end.time());
              w.add(last[i].dot(along) / reference, 1);
              w.add(last[i].dot(across) / reference, 0);
            }
            return Outcome{w.l2(), w.max(), {}};
          }};
}

Comparison<2> compare_drag_two_way(const Simulation<2>& start) {
  const double rate = drag_constant(start) / particle_radius(start), v0 = start.dense()->particles.velocity[0][0];
  return {{}, [rate, v0](const Simulation<2>& end) {
            // One particle a cell.
            const Suspension<2>& air = *end.suspension();
            const double phi = end.dense()->particles.mass[0] / (air.options().air_density * air.grid().cell_volume());
            const double w = v0 / (1 + (1 + phi) * rate * v0 * end.time());
            const double common = phi * v0 / (1 + phi);
            ErrorNorms velocity;
            for (const Vec<2>& v : end.dense()->particles.velocity) {
              velocity.add(v[0], common + w / (1 + phi));
              velocity.add(v[1], 0);
            }
            for (const double u : air.velocity()[0].values()) velocity.add(u, common - phi * w / (1 + phi));
            const StepReport<2>& last = end.report();
            const Vec<2> lost = last.exchange_on_particles + last.exchange_on_grid + last.exchange_on_fixed_faces;
            const double all = end.dense_mass() * v0;
            return Outcome{
                velocity.l2(),
                velocity.max(),
                {{"momentum lost in the last exchange over that of the snow at first", lost.norm() / all, 1e-13}}};
          }};
}

Comparison<2> compare_terminal_velocity(const Simulation<2>& start) {
  const double g = start.gravity().norm();
  const double terminal = std::sqrt(g * particle_radius(start) / drag_constant(start));
  const auto speed = std::make_shared<ErrorNorms>();
  return {[=](const Simulation<2>& now) {
            speed->add(-now.dense()->particles.velocity[0][1], terminal * std::tanh(g * now.time() / terminal));
          },
          [=](const Simulation<2>& end) {
            const double settled = std::abs(-end.dense()->particles.velocity[0][1] / terminal - 1);
            return Outcome{speed->l2(), speed->max(), {{"terminal speed, relative error", settled, 1e-12}}};
          }};
}

/// The turn of each step's slip, and its length against the scheme's, |w| / sqrt(1 + theta^2).
Comparison<2> compare_lift_circle(const Simulation<2>& start) {
  struct Seen {
    Vec<2> x, v;
    double turned = 0, from_scheme = 0;
  };
  const auto seen = std::make_shared<Seen>();
  seen->x = start.dense()->particles.position[0];
  seen->v = start.dense()->particles.velocity[0];
  const SuspensionSection& air = *start.scene().suspension;
  const double omega = 4 * air.initial_speed / start.walls().domain.size()[0];
  const double rate = start.scene().coupling->lift->constant * omega;
  return {[seen, rate](const Simulation<2>& now) {
            const Particles<2>& p = now.dense()->particles;
            const Suspension<2>& still = *now.suspension();
            const Vec<2> u = velocity_at<2>(still.grid(), still.velocity(), seen->x);
            const Vec<2> before = seen->v - u, after = p.velocity[0] - u;
            seen->turned += std::atan2(before[0] * after[1] - before[1] * after[0], before.dot(after));
            const double theta = rate * now.report().dt;
            const double by_scheme = before.norm() / std::sqrt(1 + theta * theta);
            seen->from_scheme = std::max(seen->from_scheme, std::abs(after.norm() / by_scheme - 1));
            seen->x = p.position[0];
            seen->v = p.velocity[0];
          },
          [seen, rate](const Simulation<2>& end) {
            ErrorNorms turn;
            turn.add(std::abs(seen->turned), rate * end.time());
            return Outcome{
                turn.l2(), turn.max(), {{"slip after a step over the scheme's, less 1", seen->from_scheme, 1e-12}}};
          }};
}

/// Density of the smoke where the air that came in since the start has not got to.
Comparison<3> compare_exchange_equilibrium(const Simulation<3>& start) {
  const CouplingSection& coupling = *start.scene().coupling;
  const double r = particle_radius(start), per_volume = 1 / std::pow(2 * r, 3);
  const double speed = start.scene().suspension->wind[0];
  const double surface = 4 * std::numbers::pi * r * r, section = std::numbers::pi * r * r;
  const double rate = coupling.adhesion->constant * per_volume * section * speed;
  const double equilibrium =
      coupling.generation->constant * surface * std::pow(speed, 1.7) / (coupling.adhesion->constant * section * speed);
  const auto density = std::make_shared<ErrorNorms>();
  return {[=](const Simulation<3>& now) {
            const Suspension<3>& air = *now.suspension();
            const double clean = 2 * speed * now.scene().scene.end_time;
            for (std::size_t cell = 0; cell < air.smoke_mass().size(); ++cell)
              if (air.grid().cell_centre(unflat<3>(cell, air.grid().cells))[0] > clean)
                density->add(air.smoke_density(cell), equilibrium * -std::expm1(-rate * now.time()));
          },
          [=](const Simulation<3>& end) {
            const double mass_error = std::abs(end.mass_error());
            return Outcome{density->l2(), density->max(), {{"mass error", mass_error, 1e-12}}};
          }};
}

struct CoupledState {
  std::vector<Vec<2>> slip;  ///< by id [m/s]
  double speed;              ///< of the snow, root of the sum of squares [m/s]
  Vec<2> momentum;           ///< of the snow [kg m/s]
  double smoke;              ///< [kg]
};

CoupledState coupled_state(const Simulation<2>& simulation) {
  const Suspension<2>& air = *simulation.suspension();
  const Particles<2>& p = simulation.dense()->particles;
  CoupledState state{std::vector<Vec<2>>(p.size()), 0, Vec<2>::Zero(), simulation.smoke_mass()};
  for (std::size_t i = 0; i < p.size(); ++i) {
    state.slip[p.id[i]] = p.velocity[i] - velocity_at<2>(air.grid(), air.velocity(), p.position[i]);
    state.momentum += p.mass[i] * p.velocity[i];
    state.speed = std::hypot(state.speed, p.velocity[i].norm());
  }
  return state;
}

/// The same scene in steps of 2^-14 s, run once for all levels of a series.
const CoupledState& finest(Scene scene) {
  static std::map<std::string, CoupledState> known;
  scene.scene.max_step = std::ldexp(1.0, -14);
  const std::string key = canonical_scene(scene);
  if (!known.contains(key)) {
    Simulation<2> simulation(scene);
    while (!simulation.done()) simulation.step();
    known[key] = coupled_state(simulation);
  }
  return known[key];
}

/// Slip over the snow's speed, smoke and momentum count alike.
Comparison<2> compare_coupled_step(const Simulation<2>& start) {
  return {{}, [&reference = finest(start.scene())](const Simulation<2>& end) {
            const CoupledState state = coupled_state(end);
            double difference = 0;
            for (std::size_t i = 0; i < state.slip.size(); ++i)
              difference = std::hypot(difference, (state.slip[i] - reference.slip[i]).norm());
            ErrorNorms all;
            all.add(1 + difference / reference.speed, 1);
            all.add(state.smoke / reference.smoke, 1);
            all.add(1 + (state.momentum - reference.momentum).norm() / reference.momentum.norm(), 1);
            const double cut = end.scene().scene.max_step * static_cast<double>(end.n_steps()) - end.time();
            return Outcome{all.l2(), all.max(), {{"time that shorter steps took [s]", cut, 0}}};
          }};
}

/// Levels of one longest step each, 2^-n s.
std::vector<Level> time_steps(const std::vector<int>& n, double gate) {
  std::vector<Level> levels;
  for (const int exponent : n) {
    const double dt = std::ldexp(1.0, -exponent);
    levels.push_back({fmt::format("2^-{} s", exponent), {fmt::format("scene.max_step={}", dt)}, dt, gate});
  }
  return levels;
}

Case drag_one_way() {
  Case one_way;
  one_way.name = "drag_one_way";
  one_way.title = "Drag slows three lumps of snow in air that stands still";
  one_way.reference = "w = w0 / (1 + k w0 t / r), by the scheme exact at any time step";
  one_way.source = "Eq. (10), integrated";
  one_way.quantity = "slip of each lump over its reference, at the end";
  one_way.scene = "verification/drag_one_way.toml";
  const Series steps{"time step", "paper", {}, time_steps({4, 8, 12, 16}, 1e-12)};
  one_way.series = {steps, with_settings(steps, "law", "air", {"coupling.drag.law=air"}),
                    over_values(steps, 0, "stiffness", "coupling.drag.constant", {"1", "100", "1e4", "1e6"})};
  one_way.remark =
      "What is left is the round-off of the slip that a step takes away: 1e-16 (1 + k w dt / r) of what stays.";
  one_way.compare = Compare<2>(compare_drag_one_way);
  return one_way;
}

Case drag_two_way() {
  Case two_way;
  two_way.name = "drag_two_way";
  two_way.title = "Drag between snow and air that move as one body each";
  two_way.reference = "w = w0 / (1 + (1 + phi) k w0 t / r), momentum constant, exact in one step of any length";
  two_way.source = "two bodies under Eq. (10), integrated";
  two_way.quantity = "velocity of all particles and faces after one step";
  two_way.scene = "verification/drag_two_way.toml";
  Series steps{"time step", "one step", {}, time_steps({0, 4, 8, 12}, 1e-12)};
  for (Level& level : steps.levels) level.settings.push_back(fmt::format("scene.end_time={}", level.size));
  two_way.series = {
      steps, over_values(steps, 0, "loading", "dense_flow.density", {"0.4", "4", "40", "400", "4000"}),
      over_values(steps, 0, "stiffness", "coupling.drag.constant", {"1", "100", "1e4", "1e6"}),
      over_values(steps, 0, "steps in a second", "scene.max_step", {"1", "0.5", "0.25", "0.125", "0.0625"})};
  two_way.quick = true;
  two_way.remark =
      "Over several steps the reference ends at the open sides: resting air that comes in slows the body of air, by "
      "u dt / dx of its first cell a step.";
  two_way.compare = Compare<2>(compare_drag_two_way);
  return two_way;
}

Case terminal_velocity() {
  Case fall;
  fall.name = "terminal_velocity";
  fall.title = "A lump of snow falls through air that stands still";
  fall.reference = "v = v_t tanh(g t / v_t), v_t^2 = g r / k; the scheme's fixed point is v_t at any time step";
  fall.source = "Eq. (10) and gravity, integrated";
  fall.quantity = "speed at all steps of 2 s";
  fall.scene = "verification/terminal_velocity.toml";
  Series steps{"time step", "paper", {}, time_steps({4, 5, 6, 7, 8}, 0)};
  for (Level& level : steps.levels) level.gate = 0.6 * level.size;
  // 0.81 m_air / m_snow = 1 / 250
  fall.series = {steps, with_settings(steps, "law", "air", {"coupling.drag.law=air", "coupling.drag.constant=202.5"}),
                 over_values(steps, 3, "stiffness", "coupling.drag.constant", {"0.81", "81", "8100", "810000"})};
  fall.least_order = 0.9;
  fall.quick = true;
  fall.remark = "Of the stiffness curve, k = 8100 has dt = 10 v_t / g and 810000 dt = 100 v_t / g.";
  fall.compare = Compare<2>(compare_terminal_velocity);
  return fall;
}

Case lift_circle() {
  Case circle;
  circle.name = "lift_circle";
  circle.title = "Lift bends the way of a lump of snow into a circle";
  circle.reference = "turn k omega t; by the scheme |w| / sqrt(1 + theta^2) a step, theta = k omega dt";
  circle.source = "Eq. (11), integrated";
  circle.quantity = "turn of the slip after one round";
  circle.scene = "verification/lift_circle.toml";
  Series steps{"time step", "paper", {}, time_steps({4, 5, 6, 7, 8}, 0)};
  for (Level& level : steps.levels) level.gate = 15 * level.size * level.size;
  circle.series = {steps};
  circle.least_order = 1.9;
  circle.remark =
      "The turn is of second order, a third of theta^2. The speed is not: backward Euler damps it by theta k omega "
      "t / 2, so that the circle is a spiral, to 30 % a round at theta = 0.1.";
  circle.compare = Compare<2>(compare_lift_circle);
  return circle;
}

Case exchange_equilibrium() {
  Case exchange;
  exchange.name = "exchange_equilibrium";
  exchange.title = "Smoke torn off snow in a wind, and swept up by it, reach their equilibrium";
  exchange.reference =
      "d = d_eq (1 - exp(-lambda t)), d_eq = (C_g / C_a) (S_sur / S_sec) w^0.7, lambda = C_a n S_sec w";
  exchange.source = "Eqs. (12) and (13) at constant slip, integrated";
  exchange.quantity = "smoke density at all steps, behind the air that came in";
  exchange.scene = "verification/exchange_equilibrium.toml";
  const Series steps{"time step", "trace of smoke", {}, time_steps({2, 4, 6, 8}, 1e-10)};
  exchange.series = {steps, with_settings(steps, "smoke", "C_g = 0.2", {"coupling.generation.constant=0.2"})};
  exchange.quick = true;
  exchange.remark =
      "With the paper's C_g = 0.2 the equilibrium is 20 kg/m^3 at 10 m/s. A step is exact there too, as the first "
      "one shows; from then on what sticks drags the snow along, the slip falls by a sixth in 0.25 s, and 6 % less "
      "smoke is held.";
  exchange.compare = Compare<3>(compare_exchange_equilibrium);
  return exchange;
}

Case coupled_step() {
  Case step;
  step.name = "coupled_step";
  step.title = "Drag, lift, generation, adhesion and gravity in moving air, in steps of any length";
  step.reference = "the same scene in steps of 2^-14 s";
  step.source = "self-convergence";
  step.quantity = "slip over the speed of the snow, smoke, and momentum of the snow, alike";
  step.scene = "verification/coupled_step.toml";
  Series soft{"time step", "k = 0.1", {}, time_steps({5, 6, 7, 8, 9, 10}, 0)};
  for (Level& level : soft.levels) level.gate = 1.3 * level.size;
  step.series = {soft, with_settings(soft, "stiffness", "k = 10", {"coupling.drag.constant=10"}),
                 with_settings(soft, "stiffness", "k = 1e4", {"coupling.drag.constant=1e4"})};
  step.least_order = 0.9;
  step.n_gated = step.series.size();
  step.quick = true;
  step.remark =
      "At first dt is about 0.2, 20 and 2e4 times r / ((1 + phi) k w), k = 0.1, 10 and 1e4; an explicit step would be "
      "unstable beyond 2.";
  step.compare = Compare<2>(compare_coupled_step);
  return step;
}

}  // namespace

std::vector<Case> coupling_cases() {
  return {drag_one_way(), drag_two_way(), terminal_velocity(), lift_circle(), exchange_equilibrium(), coupled_step()};
}

}  // namespace spindrift
