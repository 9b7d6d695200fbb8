#pragma once
/// The simulation: all layers of a scene, and the step that moves them on (paper Fig. 3).

#include <functional>
#include <optional>
#include <vector>

#include "core/stages.hpp"
#include "coupling/core_cells.hpp"
#include "coupling/ground_surface.hpp"
#include "coupling/overlap.hpp"
#include "simulation/ledger.hpp"
#include "simulation/saved_state.hpp"
#include "simulation/setup.hpp"
#include "simulation/smoke_source.hpp"

namespace spindrift {

template <int Dim>
class Simulation {
 public:
  /// Builds the layers that the scene names, at rest or as released.
  /// Throws Error(bad_input): numbers that fit no scene.   Pre: the scene passed the reader's checks, scene.dim == Dim.
  explicit Simulation(const Scene& scene);

  /// One step of the paper's flowchart. A trial that fails - a value that is not finite, a mass that is not positive, a
  /// runaway speed - is taken back, and the step tried again with half the time step, down to 1/64. That stays in
  /// force, and is doubled again after every 32 steps. Throws Error(unstable) naming field, id or cell, place, step and
  /// dt, where the shortest trial failed as well, or the limit of dt is under 0.1 us. The simulation then stands at the
  /// end of the last good step.
  void step();

  double time() const { return time_; }
  std::uint64_t n_steps() const { return n_steps_; }
  const BackOff& back_off() const { return back_off_; }
  bool done() const { return time_ >= scene_.scene.end_time; }

  /// Around the solver's own origin (local_origin.hpp), as all places here.
  const Scene& scene() const { return scene_; }
  const Walls<Dim>& walls() const { return walls_; }
  const Vec<Dim>& gravity() const { return gravity_; }
  const std::optional<DenseFlow<Dim>>& dense() const { return dense_; }
  const std::optional<Cover<Dim>>& cover() const { return cover_; }
  /// Cover that was taken in the last step; null where none can be.
  const Particles<Dim>* taken() const { return entrainment_ ? &entrainment_->taken() : nullptr; }
  const std::optional<Suspension<Dim>>& suspension() const { return suspension_; }
  /// 1 for particles of the overlap region in the last step, one a particle; empty where the
  /// scene lacks dense flow or suspension. It needs no coupling: the core of the air is the snow outside overlap.
  const std::vector<std::uint8_t>& overlap() const { return overlap_; }

  const StepReport<Dim>& report() const { return report_; }
  const MassLedger& masses() const { return masses_; }
  const Stages& stages() const { return stages_; }
  Stages& stages() { return stages_; }
  std::size_t n_dense_initial() const { return n_dense_initial_; }
  double dense_mass() const;  ///< [kg]
  double cover_mass() const;  ///< of what is laid [kg]
  double smoke_mass() const;  ///< [kg]
  /// (dense + cover + smoke + outflow + deposit) / (initial + laid + injected) - 1.
  double mass_error() const;
  /// Bytes of state and scratch, by part, of the parts that the scene has: "terrain", "dense_flow", "cover",
  /// "suspension", "smoke_source", "core", "coupling", "entrainment", "saved_state".
  std::vector<std::pair<std::string, std::size_t>> memory() const;

  /// All that steers the steps to come, copied into buffers that are reused, and back: the same bits follow.
  void save(SavedState<Dim>& state) const;
  void restore(const SavedState<Dim>& state);

 private:
  struct TimeStep {
    double dt;  ///< [s]
    std::string_view limiter;
  };

  template <int>
  friend struct FaultInjection;  // of the tests

  void try_step(const TimeStep& step);
  void go_back();
  TimeStep choose_time_step() const;
  double ground_reach() const;
  void lay_first_cover();
  void wake_cover_near_snow(std::span<const Foot<Dim>> feet);
  void wake_cover_under_air();
  void wake_cover(const std::vector<std::uint8_t>& called);
  void follow_cloud();
  void mark_tiles();
  typename Suspension<Dim>::Forgotten move_window(const MacGrid<Dim>& window);
  void predict_velocities();
  void exchange_layers();
  void inject_smoke();
  void advance_dense_flow();
  void advance_suspension();
  void entrain_cover();
  void remove_what_left();
  void check_state() const;
  CoverView<Dim> cover_view() const;

  Scene scene_;
  Vec<Dim> gravity_;
  Walls<Dim> walls_;

  std::optional<DenseFlow<Dim>> dense_;
  std::optional<BedFriction> bed_friction_;
  Columns<Dim> columns_;
  std::vector<double> normal_impulse_;

  std::optional<Cover<Dim>> cover_;
  std::optional<SleepingCover> sleeping_;  ///< on a height field, while not all of it is laid
  std::optional<GroundSurface<Dim>> ground_;

  std::optional<ActiveTiles<Dim>> tiles_;
  std::optional<Suspension<Dim>> suspension_;
  std::optional<SmokeSource<Dim>> smoke_source_;
  std::optional<CouplingOptions> coupling_;
  std::vector<std::uint8_t> overlap_;
  OverlapRegion<Dim> region_;
  Exchange<Dim> exchange_;
  CoreCells<Dim> core_;
  double n_interior_ = 0;   ///< number density inside the dense flow
  double first_speed_ = 0;  ///< largest of snow and air at the start [m s^-1]

  std::optional<Entrainment<Dim>> entrainment_;

  double time_ = 0, dt_ = 0;
  std::uint64_t n_steps_ = 0;
  std::size_t n_dense_initial_ = 0;
  StepReport<Dim> report_;
  MassLedger masses_;
  BackOff back_off_;
  SavedState<Dim> saved_;                         ///< of the last good step, or up to some steps before it
  std::function<void(Simulation&)> spoil_trial_;  ///< puts a fault in; empty but in tests
  Stages stages_;
};

}  // namespace spindrift
