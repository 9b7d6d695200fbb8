/// Milliseconds a step by stage, of scenes of configs/ in the middle of their motion.

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <map>

#include "core/parallel.hpp"
#include "io/system.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/simulation.hpp"

using namespace spindrift;

namespace {

struct Benchmark {
  const char* scene;
  double start;  ///< simulated time at which counting begins [s]
  int n_steps;   ///< counted
};

constexpr Benchmark benchmarks[] = {{"paper/fig09a_bumpy.toml", 3.0, 200}, {"dam_break_3d.toml", 0.1, 40}};

std::map<std::string, double> seconds_by_stage(const Stages& stages) {
  std::map<std::string, double> seconds;
  for (const Stages::Stage& stage : stages.all()) seconds[stage.name] = stage.seconds;
  return seconds;
}

template <int Dim>
void measure(const Benchmark& benchmark, const Scene& scene, int threads) {
  const ThreadLimit limit(threads);
  Simulation<Dim> simulation(scene);
  while (simulation.time() < benchmark.start) simulation.step();
  const auto before = seconds_by_stage(simulation.stages());
  int divergence = 0, density = 0, pressure = 0;
  std::size_t particles = 0;
  for (int i = 0; i < benchmark.n_steps; ++i) {
    simulation.step();
    divergence += simulation.report().dense.divergence.iterations;
    density += simulation.report().dense.density.iterations;
    pressure += simulation.report().suspension.pressure.iterations;
    particles += simulation.dense()->particles.size();
  }
  const double n = benchmark.n_steps;
  fmt::print("\n{}, {} thread{}, from t = {:.2f} s, {} steps, mean dt {:.2f} ms\n", benchmark.scene, threads,
             threads == 1 ? "" : "s", benchmark.start, benchmark.n_steps,
             1000 * (simulation.time() - benchmark.start) / n);
  double step = 0;
  for (const auto& [name, seconds] : seconds_by_stage(simulation.stages())) {
    const double ms = 1000 * (seconds - (before.contains(name) ? before.at(name) : 0)) / n;
    if (name == "step") {
      step = ms;
    } else {
      fmt::print("  {:<34}{:>9.3f} ms\n", name, ms);
    }
  }
  const double mean_particles = static_cast<double>(particles) / n;
  fmt::print("  {:<34}{:>9.3f} ms, {:.0f} ns a dense particle ({:.0f} of them)\n", "step", step,
             1e6 * step / mean_particles, mean_particles);
  fmt::print("  iterations a step: divergence {:.1f}, density {:.1f}, air pressure {:.1f}\n", divergence / n,
             density / n, pressure / n);
  fmt::print("  peak memory {:.1f} MB\n", static_cast<double>(peak_memory_bytes()) / 1e6);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Milliseconds a step by stage, of scenes in the middle of their motion");
  std::vector<int> threads{1, n_threads()};
  app.add_option("threads", threads, "numbers of threads to measure with")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
  CLI11_PARSE(app, argc, argv);
  for (const Benchmark& benchmark : benchmarks) {
    const Scene scene = read_scene(std::string(SPINDRIFT_SOURCE_DIR "/configs/") + benchmark.scene);
    for (const int n : threads)
      scene.scene.dim == 3 ? measure<3>(benchmark, scene, n) : measure<2>(benchmark, scene, n);
  }
}
