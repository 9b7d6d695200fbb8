// A step that fails leaves no trace: it is taken back, and tried again with half the time step.
#include <catch2/catch.hpp>
#include <limits>

#include "core/error.hpp"
#include "core/parallel.hpp"
#include "core/random.hpp"
#include "io/digest.hpp"
#include "simulation/frame.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

namespace spindrift {

/// Puts faults where no scene would.
template <int Dim>
struct FaultInjection {
  Simulation<Dim>& simulation;

  /// how: changes the result of each trial before it is judged, or throws
  void spoil(std::function<void()> how) {
    simulation.spoil_trial_ =
        how ? [how = std::move(how)](Simulation<Dim>&) { how(); } : std::function<void(Simulation<Dim>&)>{};
  }
  /// In a trial with the whole time step.
  bool in_whole_step(std::uint64_t step) const {
    return simulation.n_steps_ == step && simulation.back_off_.halvings == 0;
  }
  Particles<Dim>& particles() const { return simulation.dense_->particles; }
  Suspension<Dim>& air() const { return *simulation.suspension_; }
};

}  // namespace spindrift

using namespace spindrift;
using namespace spindrift::testing;

namespace {

constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();

template <int Dim>
constexpr std::string_view avalanche() {
  return Dim == 2 ? small_avalanche : small_avalanche_3d;
}

const std::vector<std::string> air_sections{"suspension",    "suspension.confinement", "coupling.drag",
                                            "coupling.lift", "coupling.generation",    "coupling.adhesion"};

/// Where a simulation stands and what it tells of its last step, to the bit.
template <int Dim>
std::string all_of(const Simulation<Dim>& s) {
  const StepReport<Dim>& r = s.report();
  const MassLedger& m = s.masses();
  Digest digest;
  for (const double x : {s.time(), r.dt, m.generated, m.adhered, m.entrained, m.injected, m.outflow(), s.cover_mass(),
                         s.smoke_mass(), r.suspension.pressure.residual, r.dense.density.error})
    digest.add(x);
  for (const Vec<Dim>& v : {r.exchange_on_grid, r.bed_friction, r.core_reaction, r.ground_on_air, r.smoke_source,
                            r.suspension.core, r.suspension.advection, r.suspension.smoke, r.suspension.projection})
    digest.add(v.sum());
  digest.add(static_cast<std::uint64_t>(r.n_rejected)).add(static_cast<std::uint64_t>(r.n_core_cells));
  for (const std::uint8_t overlap : s.overlap()) digest.add(overlap);
  if (s.suspension()) {
    digest.add(s.suspension()->ground().volume().values());
    for (const CellKind kind : s.suspension()->kind().values()) digest.add(static_cast<std::uint8_t>(kind));
  }
  return std::string(r.limiter) + " " + state_digest(s) + " " + digest.hex();
}

template <int Dim>
std::vector<std::string> steps(Simulation<Dim>& simulation, int n) {
  std::vector<std::string> states;
  for (int i = 0; i < n; ++i) {
    simulation.step();
    states.push_back(all_of(simulation));
  }
  return states;
}

[[noreturn]] void fail() {
  throw Error(ExitCode::unstable, "unstable: by order");
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("Steps taken again from a copy have the same bits", "[rejection]", ((int Dim), Dim), 2, 3) {
  const std::string all(avalanche<Dim>());
  const std::string obstacle = Dim == 2 ? "[[obstacle]]\nlower = [5, 0]\nupper = [5.5, 7.5]\n"
                                        : "[[obstacle]]\nlower = [3, 0.2, 0]\nupper = [3.4, 0.8, 3.5]\n";
  struct Case {
    std::string text;
    std::vector<std::string> settings;
  };
  const std::string fast = "entrainment.rate=2000";
  const auto [text, settings] = GENERATE_COPY(
      Case{all, {fast}}, Case{all, {fast, "suspension.scheme=reflection", "suspension.viscosity=0.01"}},
      Case{all, {fast, "suspension.tiles.still_speed=1"}},
      Case{all, {"dense_flow.solver=wcsph", "dense_flow.sound_speed=40"}},
      Case{all, {fast, "entrainment.rule=bernoulli", "suspension.diffusivity=0.1", "suspension.settling_speed=0.5"}},
      Case{all, {fast, "coupling.min_mass=0.99", "coupling.generation.constant=1"}},
      Case{all + obstacle, {fast, "dense_flow.viscosity=10"}}, Case{without(all, air_sections), {fast}},
      Case{without(all, {"cover", "entrainment"}), {}});
  Simulation<Dim> simulation(scene_of(text, settings));
  const bool dissolves = settings.size() == 3 && settings[1].starts_with("coupling.min_mass");
  std::size_t n_vanished = 0;
  for (int i = 0; i < 30 || (dissolves && simulation.masses().n_vanished == n_vanished); ++i) {
    n_vanished = simulation.masses().n_vanished;
    simulation.step();
    REQUIRE(i < 500);
  }
  SavedState<Dim> saved;
  simulation.save(saved);
  const std::string before = all_of(simulation);
  const std::size_t n_entrained = simulation.masses().n_entrained;
  const std::vector<std::string> first = steps(simulation, 20);
  if (!settings.empty() && settings[0] == fast) CHECK(simulation.masses().n_entrained > n_entrained);
  simulation.restore(saved);
  CHECK(all_of(simulation) == before);
  const std::vector<std::string> again = steps(simulation, 20);
  for (std::size_t i = 0; i < first.size(); ++i) {
    CAPTURE(text, i);
    REQUIRE(first[i] == again[i]);
  }
}

TEMPLATE_TEST_CASE_SIG("A fault in any field, place and step is caught in its step, and leaves no trace", "[rejection]",
                       ((int Dim), Dim), 2, 3) {
  const auto scheme = GENERATE(as<std::string>{}, "scheme=maccormack", "scheme=reflection", "tiles.still_speed=1");
  Simulation<Dim> simulation(scene_of(avalanche<Dim>(), {"suspension." + scheme}));
  FaultInjection<Dim> inside{simulation};
  SavedState<Dim> start;
  std::uint64_t n_numbers = 0;
  const auto below = [&](std::size_t n) {
    return static_cast<std::size_t>(static_cast<double>(n) * uniform(7, RandomStream::bernoulli, n_numbers++));
  };
  const auto put_in = [&](std::size_t field) {
    Particles<Dim>& p = inside.particles();
    const double wrong = std::array{not_a_number, inf, -inf}[below(3)];
    const std::size_t i = below(p.size()), axis = below(Dim);
    if (field == 0) p.position[i][static_cast<int>(axis)] = wrong;
    if (field == 1) p.velocity[i][static_cast<int>(axis)] = wrong;
    if (field == 2) p.velocity[i] *= 100 * 5 / p.velocity[i].norm();
    if (field == 3) p.mass[i] = std::array{-p.mass[i], 0.0, wrong}[below(3)];
    if (field == 4) p.volume[i] = std::array{-p.volume[i], 0.0, wrong}[below(3)];
    if (field == 5) p.pressure[i] = wrong;
    if (field == 6) {
      FaceField<Dim> u = inside.air().velocity();
      const double speed = std::array{1e4, wrong}[below(2)];
      std::size_t face = below(u[axis].size());
      while (inside.air().still().any() && !inside.air().active_faces()[axis][face]) face = below(u[axis].size());
      u[axis][face] = speed;
      inside.air().set_velocity(u);
    }
    if (field == 7) {
      Field<Dim> smoke = inside.air().smoke_mass();
      smoke[below(smoke.size())] = std::array{-1.0, wrong}[below(2)];
      inside.air().set_smoke_mass(smoke);
    }
  };

  for (const std::uint64_t start_at : {3, 22, 41}) {
    while (simulation.n_steps() < start_at) simulation.step();
    simulation.save(start);
    for (const std::uint64_t n_replayed : {0, 1, 5}) {
      const std::uint64_t at = start_at + n_replayed;
      const auto step_after = [&](const std::function<void()>& disturb) {
        simulation.restore(start);
        inside.spoil({});
        while (simulation.n_steps() < at) simulation.step();
        disturb();
        simulation.step();
        CHECK(simulation.n_steps() == at + 1);
        CHECK(simulation.report().n_rejected == 1);
        return all_of(simulation);
      };
      // A fault at the end of a trial, until the step is halved.
      const auto step_with = [&](const std::function<void()>& fault) {
        return step_after([&] {
          inside.spoil([&] {
            if (inside.in_whole_step(at)) fault();
          });
        });
      };
      const std::string expected = step_with(fail);
      for (std::size_t field = 0; field < 8; ++field)
        for (int n = 0; n < (Dim == 2 ? 3 : 1); ++n) {
          CAPTURE(field, n, at, scheme);
          REQUIRE(step_with([&] { put_in(field); }) == expected);
        }
      // One that is there before the step, and goes through all of it.
      if (n_replayed == 0) continue;
      Particles<Dim>& p = inside.particles();
      CHECK(step_after([&] { p.velocity[below(p.size())][0] = not_a_number; }) == expected);
      CHECK(step_after([&] { p.mass[below(p.size())] = not_a_number; }) == expected);
      CHECK(step_after([&] { p.pressure[below(p.size())] = not_a_number; }) == expected);
      CHECK(step_after([&] {
              Field<Dim> smoke = inside.air().smoke_mass();
              for (double& mass : smoke.values())
                if (mass > 0) mass = not_a_number;
              inside.air().set_smoke_mass(smoke);
            }) == expected);
    }
    inside.spoil({});
    simulation.restore(start);
  }
}

TEST_CASE("A step that fails at every length ends the run where the last good step ended", "[rejection]") {
  const std::uint64_t at = GENERATE(0, 16, 21, 40);
  Simulation<2> simulation(scene_of(small_avalanche));
  while (simulation.n_steps() < at) simulation.step();
  const std::string before = all_of(simulation);
  FaultInjection<2> inside{simulation};
  std::vector<double> tried;
  inside.spoil([&] {
    if (simulation.n_steps() != at) return;
    tried.push_back(simulation.report().dt);
    inside.particles().velocity[7][1] = not_a_number;
  });
  for (const std::size_t n_trials : {7, 1}) {  // what is cut back stays cut back
    tried.clear();
    try {
      simulation.step();
      FAIL("not caught");
    } catch (const Error& error) {
      CHECK(error.code() == ExitCode::unstable);
      CHECK_THAT(error.what(), Catch::Contains("velocity is not finite in step " + std::to_string(at + 1) + " ") &&
                                   Catch::Contains("6 halvings"));
    }
    CHECK(all_of(simulation) == before);
    REQUIRE(tried.size() == n_trials);
    for (std::size_t i = 1; i < n_trials; ++i) CHECK(tried[i] == tried[i - 1] / 2);
  }
  CHECK(simulation.back_off().n_rejected_in_all == 8);
  inside.spoil({});
  simulation.step();
  CHECK(simulation.report().dt == tried.back());
}

TEST_CASE("After a rejection the step is halved for 32 steps; another one adds to it", "[rejection]") {
  Simulation<2> simulation(
      scene_of("schema_version = 1\n[scene]\nend_time = 9\n[domain]\nlower=[0, 0]\nupper=[3, 3]\n[suspension]\n"));
  FaultInjection<2> inside{simulation};
  int n_faults = 0;
  inside.spoil([&] {
    const std::uint64_t n = simulation.n_steps();
    if ((n == 5 && n_faults < 1) || (n == 20 && n_faults < 2)) ++n_faults, fail();
  });
  std::vector<double> expected(5, 0.01);
  expected.insert(expected.end(), 15, 0.005);
  expected.insert(expected.end(), 32, 0.0025);
  expected.insert(expected.end(), 32, 0.005);
  expected.insert(expected.end(), 3, 0.01);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    CAPTURE(i);
    simulation.step();
    REQUIRE(simulation.report().dt == expected[i]);
    CHECK(simulation.report().limiter == (expected[i] < 0.01 ? "rejection" : "longest step"));
    CHECK(simulation.report().n_rejected == (i == 5 || i == 20 ? 1 : 0));
  }
  CHECK(n_faults == 2);
  CHECK(simulation.stages().passes("replay") == 2);
}

TEST_CASE("A rejection after entrainment gives the same bits with any number of threads", "[rejection]") {
  std::vector<std::string> ends;
  for (const int threads : {1, 2}) {
    const ThreadLimit limit(threads);
    Simulation<2> simulation(scene_of(small_avalanche, {"entrainment.rate=1000"}));
    FaultInjection<2> inside{simulation};
    std::size_t n_entrained = 0;
    inside.spoil([&] {
      if (simulation.n_steps() == 32) n_entrained = simulation.masses().n_entrained;
      if (inside.in_whole_step(45)) {
        CHECK(simulation.masses().n_entrained > n_entrained);  // the replay starts at step 32
        fail();
      }
    });
    while (simulation.n_steps() < 100) simulation.step();
    CHECK(simulation.back_off().n_rejected_in_all == 1);
    CHECK(std::abs(simulation.mass_error()) < 1e-12);
    ends.push_back(all_of(simulation));
  }
  CHECK(ends[0] == ends[1]);
}
