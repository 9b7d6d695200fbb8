#include <algorithm>

#include "simulation/release.hpp"
#include "simulation/simulation.hpp"

namespace spindrift {

/// Tiles where something happens or will within the steps to the next look.
template <int Dim>
void Simulation<Dim>::mark_tiles() {
  tiles_->clear();
  if (dense_)
    for (const Vec<Dim>& x : dense_->particles.position) tiles_->add(x);
  for (const SmokeSection& smoke : scene_.smoke)
    if (!suspension_ || smoke.rate > 0) tiles_->add(box_around<Dim>(smoke, walls_));
  if (suspension_) tiles_->add(*suspension_);
  tiles_->add_margin();
}

/// Lets the computed part of the air's grid go along with what moves.
template <int Dim>
void Simulation<Dim>::follow_cloud() {
  // Nothing crosses half a tile, and so leaves the margin, between two looks.
  const auto steps_between_looks =
      static_cast<std::uint64_t>(tile_edge<Dim> / 2 / std::max(1.0, scene_.suspension->cfl));
  if (n_steps_ % std::max<std::uint64_t>(steps_between_looks, 1) != 0) return;
  const auto timed = stages_.time("suspension.tiles");
  mark_tiles();
  wake_cover_under_air();
  const MacGrid<Dim> window = tiles_->window(suspension_->grid());
  const auto book = [&](const typename Suspension<Dim>::Forgotten& forgotten) {
    report_.forgotten += forgotten.momentum;
    masses_.smoke_outflow += forgotten.smoke;
  };
  if (!same_window<Dim>(window, suspension_->grid())) book(move_window(window));
  book(suspension_->set_still(tiles_->still(window)));
}

template <int Dim>
typename Suspension<Dim>::Forgotten Simulation<Dim>::move_window(const MacGrid<Dim>& window) {
  if (ground_) ground_->move_window(walls_, window, cover_ ? &*cover_ : nullptr);
  const auto forgotten =
      suspension_->move_window(window, tiles_->sides(window), ground_ ? ground_->node_distance() : Field<Dim>());
  if (smoke_source_) smoke_source_.emplace(smoke_rate<Dim>(scene_, *suspension_));
  return forgotten;
}

template class Simulation<2>;
template class Simulation<3>;

}  // namespace spindrift
