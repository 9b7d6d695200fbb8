// What a scene does not name takes no pass, no allocation and no byte.

#include <catch2/catch.hpp>

#include "core/parallel.hpp"
#include "count_allocations.hpp"
#include "simulation/frame.hpp"
#include "simulation/simulation.hpp"
#include "small_scene.hpp"

using namespace spindrift;
using namespace spindrift::testing;

namespace {

std::size_t held(const Simulation<2>& simulation, const std::string& part) {
  for (const auto& [name, bytes] : simulation.memory())
    if (name == part) return bytes;
  return 0;
}

Simulation<2> some_steps(const std::string& text) {
  Simulation<2> simulation(scene_of(text));
  for (int i = 0; i < 10; ++i) simulation.step();
  return simulation;
}

struct Part {
  std::vector<std::string> sections;  ///< to leave out
  std::vector<std::string> stages;    ///< that then must not run
  std::vector<std::string> memory;    ///< that then must not be held
};

const std::vector<Part> parts{
    {{"suspension", "suspension.confinement", "coupling.drag", "coupling.lift", "coupling.generation",
      "coupling.adhesion", "smoke"},
     {"suspension", "overlap", "exchange", "smoke_source"},
     {"suspension", "core", "coupling", "smoke_source"}},
    {{"coupling.drag", "coupling.lift", "coupling.generation", "coupling.adhesion"}, {"exchange"}, {"coupling"}},
    {{"suspension.confinement"}, {"suspension.confinement"}, {}},
    {{"entrainment"}, {"entrainment"}, {"entrainment"}},
    {{"cover", "entrainment"}, {"entrainment"}, {"cover", "entrainment"}},
    {{"smoke"}, {"smoke_source"}, {"smoke_source"}},
};

}  // namespace

TEST_CASE("Absent parts take no pass and no byte", "[absence]") {
  const std::string with_source =
      std::string(small_avalanche) + "[smoke]\ndensity = 0\nrate = 5\nlower = [2, 9]\nupper = [6, 12]\n";
  const Simulation<2> whole = some_steps(with_source);
  for (const Part& part : parts) {
    const Simulation<2> simulation = some_steps(without(with_source, part.sections));
    for (const std::string& stage : part.stages) {
      CAPTURE(stage);
      CHECK(whole.stages().passes(stage) > 0);
      CHECK(simulation.stages().passes(stage) == 0);
    }
    for (const std::string& name : part.memory) {
      CAPTURE(name);
      CHECK(held(whole, name) > 0);
      CHECK(held(simulation, name) == 0);
    }
  }
  CHECK(whole.stages().passes("dense_flow.viscosity") == 0);
  CHECK(whole.stages().passes("suspension.viscosity") == 0);
  CHECK(whole.stages().passes("suspension.diffusion") == 0);
}

TEST_CASE("Physics of strength zero and absent physics end in the same bits", "[absence]") {
  const auto digest_of = [](const std::string& text, const std::vector<std::string>& settings) {
    Simulation<2> simulation(scene_of(text, settings));
    for (int i = 0; i < 20; ++i) simulation.step();
    return state_digest(simulation);
  };
  CHECK(digest_of(without(small_avalanche, {"suspension.confinement"}), {}) ==
        digest_of(std::string(small_avalanche), {"suspension.confinement.strength=0"}));
  CHECK(digest_of(without(small_avalanche, {"entrainment"}), {}) ==
        digest_of(std::string(small_avalanche), {"entrainment.rate=0"}));
}

TEST_CASE("A copy of the state holds what can change, and reuses its buffers", "[absence]") {
  const auto copy_of = [](const std::vector<std::string>& left_out) {
    const Simulation<2> simulation = some_steps(without(small_avalanche, left_out));
    SavedState<2> state;
    simulation.save(state);
    const std::uint64_t before = n_allocations;
    simulation.save(state);
    CHECK(n_allocations == before);
    return state;
  };
  const SavedState<2> whole = copy_of({}), snow = copy_of(parts[0].sections), at_rest = copy_of({"entrainment"});
  CHECK(whole.suspension->bytes() > 0);
  CHECK(whole.cover->bytes() > 0);
  CHECK(!snow.suspension);
  CHECK(!at_rest.cover);
  CHECK(held(some_steps(std::string(small_avalanche)), "saved_state") >
        held(some_steps(without(small_avalanche, parts[0].sections)), "saved_state") + whole.suspension->bytes() / 2);
}

TEST_CASE("A warm step allocates nothing", "[absence]") {
  const ThreadLimit one(1);
  const std::string text = GENERATE(without(small_avalanche, parts[0].sections),
                                    without(small_avalanche, {"entrainment", "cover"}), std::string(small_avalanche));
  Simulation<2> simulation(scene_of(text));
  // Growth is allowed while the flow spreads; a step that finds its arrays large enough must not allocate.
  std::uint64_t fewest = ~std::uint64_t{0};
  for (int i = 0; i < 120; ++i) {
    const std::uint64_t before = n_allocations;
    simulation.step();
    fewest = std::min(fewest, n_allocations - before);
  }
  CHECK(fewest == 0);
}
