#pragma once
/// What people read off an avalanche: where its front is and how fast, how high its cloud stands. Sampled at fixed
/// simulated times, so that the numbers do not depend on the output.

#include <deque>
#include <optional>

#include "simulation/avalanche_path.hpp"
#include "simulation/simulation.hpp"

namespace spindrift {

/// A cloud is where smoke is denser than this [kg m^-3].
inline constexpr double cloud_density = 0.1;

/// How far the dense flow came from where it was let go.
struct RunOut {
  double distance = 0;  ///< on the level, from the highest snow of the release; 99 % of the mass lie nearer [m]
  double drop = 0;      ///< from there down to the snow at that distance [m]
  double angle = 0;     ///< of the energy line between the two, against the level [rad]
};

template <int Dim>
struct Instruments {
  static constexpr double sample_interval = 0.1;  ///< [s]
  static constexpr double speed_window = 0.5;     ///< over which the front's speed is taken [s]

  /// 99th mass percentile of the dense flow's way [m]: along the ground's profile; on a height field along the scene's
  /// [path], or straight from the middle of the snow as it was first seen; without ground x.
  double front = 0;
  double front_speed = 0;       ///< over the last window [m s^-1]
  double front_speed_max = 0;   ///< [m s^-1]
  double cloud_height = 0;      ///< largest distance of the cloud from the ground [m]
  double cloud_height_max = 0;  ///< [m]
  double head_depth = 0;        ///< mean depth of the dense flow within 20 m of the front [m]; on a height field of the
                                ///< ground that it lies on
  double head_cloud = 0;        ///< largest cloud height within 20 m of the front [m]

  /// Reads the simulation where the next sample is due.
  void follow(const Simulation<Dim>& simulation);

  /// Of the snow as it stands; zeros where there never was any, or none is left.
  RunOut run_out(const Simulation<Dim>& simulation) const;

 private:
  struct Sample {
    double time, front;
  };
  double way(const Walls<Dim>& walls, const Vec<Dim>& x) const;
  void prepare(const Simulation<Dim>& simulation);

  std::optional<AvalanchePath> path_;
  std::optional<Vec<Dim>> middle_;  ///< of the snow as it was first seen on a height field
  std::optional<Vec<Dim>> top_;     ///< highest snow as it was first seen
  std::deque<Sample> samples_;
  double next_ = 0;
};

}  // namespace spindrift
