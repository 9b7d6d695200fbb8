#include <cmath>

#include "core/parallel.hpp"
#include "simulation/setup.hpp"
#include "simulation/simulation.hpp"

namespace spindrift {

/// All of the cover where something looks at all of it, else what is near to something.
template <int Dim>
void Simulation<Dim>::lay_first_cover() {
  if constexpr (Dim == 3) {
    sleeping_ = make_sleeping_cover(scene_, walls_);
    if (!sleeping_) return;
    if (!cover_sleeps(scene_)) {
      sleeping_->wake_all(*cover_, *walls_.terrain->height_field());
      return sleeping_.reset();
    }
    if (dense_) {
      std::vector<Foot<3>> feet;
      walls_.terrain->find_feet(feet, dense_->particles.position);
      wake_cover_near_snow(feet);
    }
    wake_cover_under_air();
    masses_.laid = 0;
  }
}

/// Before the step looks at the cover.   feet: of the dense flow
template <int Dim>
void Simulation<Dim>::wake_cover_near_snow(std::span<const Foot<Dim>> feet) {
  if constexpr (Dim == 3) {
    if (!sleeping_) return;
    const DenseFlowOptions& flow = dense_->options();
    const auto around = [](const Foot<3>& foot, double reach) {
      return Box<2>{foot.place - Vec<2>::Constant(reach), foot.place + Vec<2>::Constant(reach)};
    };
    // What is farther from the ground than it looks has no foot, and touches no cover.
    const auto has_foot = [&, far = ground_reach()](std::size_t i) { return std::abs(feet[i].distance) < far; };
    const double reach = SleepingCover::reach(flow.spacing, flow.support_radius);
    const bool any = parallel_reduce(
        feet.size(), false,
        [&](std::size_t begin, std::size_t end) {
          for (std::size_t i = begin; i < end; ++i)
            if (has_foot(i) && sleeping_->asleep(*cover_, around(feet[i], reach))) return true;
          return false;
        },
        [](bool a, bool b) { return a || b; });
    if (!any) return;
    std::vector<std::uint8_t> called(sleeping_->plots().size());
    const double early = sleeping_->plots().edge / 2;  // so that more plots are laid at a time
    for (std::size_t i = 0; i < feet.size(); ++i)
      if (has_foot(i)) sleeping_->call(around(feet[i], reach + early), called);
    wake_cover(called);
  }
}

/// Where tiles of the air are marked, whose cells see the cover's surface.
template <int Dim>
void Simulation<Dim>::wake_cover_under_air() {
  if constexpr (Dim == 3) {
    if (!sleeping_ || !tiles_) return;
    const Vec<2> aside = Vec<2>::Constant(GroundSurface<3>::sees_aside(*cover_, tiles_->whole().dx));
    std::vector<std::uint8_t> called(sleeping_->plots().size());
    tiles_->for_each_marked([&](const Box<3>& box) {
      sleeping_->call({box.lower.template head<2>() - aside, box.upper.template head<2>() + aside}, called);
    });
    wake_cover(called);
  }
}

/// called: of SleepingCover::wake
template <int Dim>
void Simulation<Dim>::wake_cover(const std::vector<std::uint8_t>& called) {
  if constexpr (Dim == 3) {
    const auto timed = stages_.time("cover.wake");
    const std::size_t n = sleeping_->wake(*cover_, *walls_.terrain->height_field(), called);
    masses_.laid += static_cast<double>(n) * cover_->density * std::pow(cover_->spacing, 3);
    if (n == 0 || !ground_) return;
    ground_->follow(*cover_);
    suspension_->set_ground(ground_->node_distance());
  }
}

template class Simulation<3>;
template class Simulation<2>;

}  // namespace spindrift
