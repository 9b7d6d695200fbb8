#include <fmt/format.h>

#include <algorithm>

#include "core/error.hpp"
#include "simulation/simulation.hpp"

namespace spindrift {
namespace {

/// A copy every step would cost some percent of every run; steps since a copy are taken once more instead, which by
/// determinism gives the same bits.
constexpr std::uint64_t steps_between_copies = 16;
constexpr int most_halvings = 6;
constexpr int good_steps_to_double = 32;

}  // namespace

void BackOff::count_good_step() {
  if (halvings == 0 || ++n_good < good_steps_to_double) return;
  --halvings;
  n_good = 0;
}

void BackOff::count_rejection() {
  ++n_rejected;
  ++n_rejected_in_all;
  halvings = std::min(halvings + 1, most_halvings);
  n_good = 0;
}

template <int Dim>
void Simulation<Dim>::step() {
  const auto timed = stages_.time("step");
  if (n_steps_ % steps_between_copies == 0) {
    const auto timed_copy = stages_.time("saved_state");
    save(saved_);
  }
  for (;;) {
    const TimeStep step = choose_time_step();
    try {
      return try_step(step);
    } catch (const Error& failure) {
      if (failure.code() != ExitCode::unstable) throw;
      const bool was_shortest = back_off_.halvings == most_halvings;
      go_back();
      back_off_.count_rejection();
      save(saved_);
      if (was_shortest)
        throw Error(ExitCode::unstable,
                    fmt::format("{}; {} halvings of the time step did not help", failure.what(), most_halvings));
    }
  }
}

/// To the end of the last good step.
template <int Dim>
void Simulation<Dim>::go_back() {
  const auto timed = stages_.time("replay");
  const std::uint64_t last_good = n_steps_;
  restore(saved_);
  while (n_steps_ < last_good) try_step(choose_time_step());
}

template <int Dim>
void Simulation<Dim>::save(SavedState<Dim>& state) const {
  state.time = time_;
  state.n_steps = n_steps_;
  state.back_off = back_off_;
  state.masses = masses_;
  state.report = report_;
  state.overlap = overlap_;
  if (dense_) state.dense = dense_->particles;
  if (entrainment_ || sleeping_) state.cover = cover_;
  if (suspension_) suspension_->save(state.suspension ? *state.suspension : state.suspension.emplace());
}

template <int Dim>
void Simulation<Dim>::restore(const SavedState<Dim>& state) {
  time_ = state.time;
  n_steps_ = state.n_steps;
  back_off_ = state.back_off;
  masses_ = state.masses;
  report_ = state.report;
  overlap_ = state.overlap;
  if (dense_) dense_->particles = state.dense;
  if (entrainment_ || sleeping_) cover_ = state.cover;
  if (suspension_ && !same_window<Dim>(state.suspension->grid, suspension_->grid()))
    move_window(state.suspension->grid);
  if (entrainment_ || sleeping_) {
    if (ground_) {
      ground_->follow(*cover_);
      suspension_->set_ground(ground_->node_distance());
    }
  }
  if (suspension_) suspension_->restore(*state.suspension);
  save(saved_);  // which may be of another past
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace spindrift
