/// absence steps STEPS PARTS: steps of the avalanche with its first PARTS parts, 0: of air alone; prints the state's
/// bits. absence table WARM STEPS: name, bytes, median ms and median allocations a step of every stage of the
/// avalanche, after WARM steps. All of them take turns, step by step, so that a noisy machine is noisy for all.

#include <fmt/format.h>

#include <chrono>
#include <cstdlib>
#include <deque>

#include "absence/air_alone.hpp"
#include "absence/dense_alone.hpp"
#include "absence/scenes.hpp"
#include "core/median.hpp"
#include "count_allocations.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

namespace {

Simulation<2> avalanche(std::size_t n_parts) {
  return Simulation<2>(parse_scene(absence::avalanche(n_parts), "avalanche.toml"));
}

void take_steps(int n_steps, std::size_t n_parts) {
  Simulation<2> simulation =
      n_parts > 0 ? avalanche(n_parts) : Simulation<2>(parse_scene(absence::air_alone, "air.toml"));
  for (int i = 0; i < n_steps; ++i) simulation.step();
  fmt::print("{:016x}\n", n_parts > 0 ? absence::bits_of(simulation.dense()->particles)
                                      : absence::bits_of(*simulation.suspension()));
}

struct Measured {
  Simulation<2> simulation;
  std::vector<double> milliseconds{}, allocations{};

  void step() {
    const std::uint64_t before = n_allocations;
    const auto start = std::chrono::steady_clock::now();
    simulation.step();
    milliseconds.push_back(std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count());
    allocations.push_back(static_cast<double>(n_allocations - before));
  }
};

void print_table(int warm, int n_steps) {
  std::deque<Measured> all;
  for (std::size_t n = 1; n <= std::size(absence::parts); ++n) {
    all.push_back({avalanche(n)});
    for (int i = 0; i < warm; ++i) all.back().simulation.step();
  }
  for (Measured& one : all) one.milliseconds.reserve(n_steps), one.allocations.reserve(n_steps);
  for (int i = 0; i < n_steps; ++i)
    for (Measured& one : all) one.step();
  for (std::size_t n = 0; n < all.size(); ++n) {
    std::size_t bytes = 0;
    for (const auto& part : all[n].simulation.memory()) bytes += part.second;
    fmt::print("{}\t{}\t{:.4f}\t{:.0f}\n", absence::parts[n].name, bytes, median(all[n].milliseconds),
               median(all[n].allocations));
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  const ThreadLimit one(1);
  const int first = std::atoi(argv[2]), second = std::atoi(argv[3]);
  std::string_view(argv[1]) == "table" ? print_table(first, second)
                                       : take_steps(first, static_cast<std::size_t>(second));
}
