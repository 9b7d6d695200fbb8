#pragma once
/// From where a picture of a 3D scene is taken: directions over the ground, and a camera in perspective.

#include <span>

#include "core/vec.hpp"

namespace spindrift {

/// Up is against gravity, which need not be an axis. An azimuth is an angle on the level from north over east, as a
/// compass has it; with gravity along -z, north is y and east is x.
struct Compass {
  Vec<3> east = Vec<3>::UnitX(), north = Vec<3>::UnitY(), up = Vec<3>::UnitZ();

  Compass() = default;
  /// gravity: [m s^-2]; without any, z is up.
  explicit Compass(const Vec<3>& gravity);

  /// Unit vector.   azimuth, elevation: [rad]
  Vec<3> direction(double azimuth, double elevation) const;

  /// [rad], 0 to 2 pi; of a vector that is not upright.
  double azimuth_of(const Vec<3>& v) const;
};

/// Perspective of a pinhole. A pixel's middle is at half numbers; y points down in the picture.
struct Camera {
  Vec<3> eye = Vec<3>::Zero();                                                      ///< [m]
  Vec<3> right = Vec<3>::UnitX(), up = Vec<3>::UnitZ(), forward = Vec<3>::UnitY();  ///< unit, orthogonal
  double focal = 1;                                                                 ///< focal length [px]
  int width = 2, height = 2;                                                        ///< [px]

  struct Seen {
    double x, y;   ///< in the picture [px]
    double depth;  ///< along `forward` [m]; x and y mean something where it is positive
  };
  /// x = width / 2 + focal (right . d) / depth,  y = height / 2 - focal (up . d) / depth,  depth = forward . d,
  /// d = position - eye.
  Seen project(const Vec<3>& position) const;

  /// What is seen at (x, y) [px] lies at eye + depth ray(x, y).
  Vec<3> ray(double x, double y) const;
};

/// Which way a camera looks.
struct Outlook {
  double azimuth = 0;    ///< of the camera as seen from what it looks at [rad]
  double elevation = 0;  ///< [rad]
};

/// A camera `distance` [m] from `target`.
Camera camera_at(const Vec<3>& target, double distance, const Outlook& outlook, const Compass& compass, int width,
                 int height);

/// The camera nearest to all of `points`, at least one, that has them in its picture with a rim of `margin` of the
/// picture's width and height on each side. Where they do not fill it, they stand in its middle.
Camera camera_around(std::span<const Vec<3>> points, double margin, const Outlook& outlook, const Compass& compass,
                     int width, int height);

}  // namespace spindrift
