#pragma once
/// Does the program survive what it is not made for? Trials far from the usual, each with a verdict.

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "simulation/simulation.hpp"

namespace spindrift {

/// What is wrong at the end of a trial; empty: nothing.
template <int Dim>
using Look = std::function<std::string(const Simulation<Dim>& end)>;

/// One trial: a scene with settings, run for some steps, twice.
struct Trial {
  std::string set;                    ///< "F1" ... "F19" of the extremes, "map" of the map
  std::string name;                   ///< what is extreme
  std::string scene;                  ///< file under configs/
  std::vector<std::string> settings;  ///< "key=value"
  bool refused = false;               ///< the scene must be refused, with a reason
  bool beyond = false;                ///< outside the documented range: the run may also end as unstable, with a reason
  int steps = 100;
  std::tuple<Look<2>, Look<3>> look = {};                       ///< may be empty
  std::string remark = {};                                      ///< why it does not go as it should; empty: it has to
  std::vector<std::pair<std::string, double>> parameters = {};  ///< of a point of the map
};

enum class Verdict { passed, refused, stopped, failed };  ///< stopped: exit code 3, the last good state kept

std::string_view name_of(Verdict verdict);

struct TrialResult {
  Trial trial;
  Verdict verdict = Verdict::passed;
  std::string reason;  ///< of a failure, or what the refusal said
  std::uint64_t steps = 0, rejected = 0;
  double seconds = 0;           ///< of the slowest step
  double shortest_step = 0;     ///< dt [s]
  double mass_error = 0;        ///< relative, largest
  double energy_growth = 0;     ///< of the most there was over that of the start, relative
  double fastest = 0;           ///< snow or air [m s^-1]
  int pressure_iterations = 0;  ///< most of a step
  bool good() const;
};

/// Runs it twice, the second time on one thread. It passes where every state was finite, masses and volumes positive,
/// the mass ledger closed to 1e-10, mechanical energy did not grow by more than 5 %, the air's pressure converged,
/// no step took longer than 2 s, `look` found nothing and both runs ended in the same bits.
TrialResult run_trial(const Trial& trial);

/// The extreme set: empty, huge, stiff, degenerate and malformed scenes.
std::vector<Trial> extreme_trials();

/// Of these the ones of ground, grid and obstacles, which are the same in 2D and 3D.
std::vector<Trial> shape_trials();

/// n points of a seeded Latin hypercube over CFL numbers, drag constant, mass ratio, r_s of the smoke, slope angle and
/// viscosities. Beyond the documented range are snow lighter than the air with its smoke, and the reflection scheme
/// above a CFL number of 10.
std::vector<Trial> map_trials(int n);

/// Writes folder/stability.{md,html,csv,png}.   Throws Error(io_failed).
/// note: is told why there is no picture, if so.
void write_stability(const std::filesystem::path& folder, const std::vector<TrialResult>& results,
                     const std::function<void(const std::string&)>& note);

}  // namespace spindrift
