#include <catch2/catch.hpp>
#include <numbers>

#include "io/camera.hpp"

using namespace spindrift;

namespace {

constexpr double degrees = std::numbers::pi / 180;

void check_near(const Vec<3>& a, const Vec<3>& b) {
  CAPTURE(a.transpose(), b.transpose());
  CHECK((a - b).norm() < 1e-12);
}

}  // namespace

TEST_CASE("north is y and east is x where gravity points along -z", "[camera]") {
  const Compass compass(Vec<3>(0, 0, -9.81));
  check_near(compass.up, {0, 0, 1});
  check_near(compass.direction(0, 0), {0, 1, 0});
  check_near(compass.direction(90 * degrees, 0), {1, 0, 0});
  check_near(compass.direction(180 * degrees, 30 * degrees), {0, -std::sqrt(0.75), 0.5});
  CHECK(compass.azimuth_of({-3, 0, 7}) == Approx(270 * degrees));
}

TEST_CASE("up is against gravity, and east leans with the ground", "[camera]") {
  // A slope of 30 degrees that falls to +x, laid along x.
  const Compass compass(9.81 * Vec<3>(0.5, 0, -std::sqrt(0.75)));
  check_near(compass.up, {-0.5, 0, std::sqrt(0.75)});
  check_near(compass.east, {std::sqrt(0.75), 0, 0.5});
  check_near(compass.north, {0, 1, 0});
  const auto gravity = GENERATE(Vec<3>(0, 0, 0), Vec<3>(2, 0, 0), Vec<3>(-1, 0, 0), Vec<3>(0, 3, 0), Vec<3>(1, -2, 3));
  const Compass any(gravity);
  check_near(any.east.cross(any.north), any.up);
  CHECK(any.east.norm() == Approx(1));
  CHECK(std::abs(any.east.dot(any.up)) < 1e-12);
  if (!gravity.isZero()) CHECK(any.up.dot(gravity) == Approx(-gravity.norm()));
}

TEST_CASE("a camera projects as by hand", "[camera]") {
  // From the south, level, 10 m away: x goes right, z goes up, y away.
  const Camera camera = camera_at({1, 2, 3}, 10, {180 * degrees, 0}, Compass(), 200, 100);
  check_near(camera.eye, {1, -8, 3});
  check_near(camera.right, {1, 0, 0});
  check_near(camera.up, {0, 0, 1});
  check_near(camera.forward, {0, 1, 0});
  CHECK(camera.focal == 300);  // one and a half of the longer side
  const Camera::Seen middle = camera.project({1, 2, 3});
  CHECK(middle.x == Approx(100));
  CHECK(middle.y == Approx(50));
  CHECK(middle.depth == Approx(10));
  // 2 m to the right and 1 m up at a depth of 20 m: 300 * 2 / 20 = 30 px and 15 px.
  const Camera::Seen seen = camera.project({3, 12, 4});
  CHECK(seen.x == Approx(130));
  CHECK(seen.y == Approx(35));
  CHECK(seen.depth == Approx(20));
  CHECK(camera.project({1, -9, 3}).depth < 0);
}

TEST_CASE("a ray leads back to what is projected", "[camera]") {
  const Outlook outlook{GENERATE(0.0, 1.0, 4.0), GENERATE(-0.3, 0.5, 1.5)};
  const Camera camera = camera_at({5, -3, 2}, 40, outlook, Compass(Vec<3>(3, 1, -9)), 640, 360);
  CHECK(camera.right.dot(camera.up) == Approx(0).margin(1e-12));
  CHECK(camera.right.cross(camera.forward).dot(camera.up) == Approx(1));
  for (const Vec<3>& x : {Vec<3>(5, -3, 2), Vec<3>(0, 0, 0), Vec<3>(9, 4, -6)}) {
    const Camera::Seen seen = camera.project(x);
    const Vec<3> back = camera.eye + seen.depth * camera.ray(seen.x, seen.y);
    CHECK((back - x).norm() < 1e-10);
  }
}

TEST_CASE("a camera around points has them all in its picture, and is as near as that allows", "[camera]") {
  const std::vector<Vec<3>> points{{0, 0, 0}, {100, 0, -50}, {100, 30, -50}, {0, 30, 0}, {50, 15, 20}};
  const double margin = 0.05;
  const Outlook outlook{GENERATE(0.0, 2.0, 5.0), GENERATE(0.1, 0.6, 1.4)};
  const auto [width, height] = GENERATE(std::pair{1600, 900}, std::pair{300, 900});
  const Camera camera = camera_around(points, margin, outlook, Compass(), width, height);
  double left = width, right = 0, top = height, bottom = 0;
  for (const Vec<3>& x : points) {
    const Camera::Seen seen = camera.project(x);
    REQUIRE(seen.depth > 0);
    left = std::min(left, seen.x), right = std::max(right, seen.x);
    top = std::min(top, seen.y), bottom = std::max(bottom, seen.y);
  }
  CHECK(left >= margin * width - 1e-6);
  CHECK(right <= (1 - margin) * width + 1e-6);
  CHECK(top >= margin * height - 1e-6);
  CHECK(bottom <= (1 - margin) * height + 1e-6);
  const bool fills_width = right - left > (1 - 2 * margin) * width - 1e-6;
  const bool fills_height = bottom - top > (1 - 2 * margin) * height - 1e-6;
  CHECK((fills_width || fills_height));
}
