#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "core/error.hpp"
#include "terrain/profiles.hpp"
#include "terrain/walls.hpp"

using namespace spindrift;

namespace {

template <int Dim>
Vec<Dim> at(double x, double z) {
  Vec<Dim> p = Vec<Dim>::Constant(0.7);
  p[0] = x;
  p[Dim - 1] = z;
  return p;
}

const double nan_ = std::numeric_limits<double>::quiet_NaN();

}  // namespace

TEMPLATE_TEST_CASE_SIG("Foot on an inclined line", "[terrain]", ((int Dim), Dim), 2, 3) {
  const Terrain<Dim> line({{0, 0}, {4, -3}});  // 3-4-5 triangle
  const Foot<Dim> foot = line.foot(at<Dim>(0.6 + 4, 0.8 - 3));
  CHECK(foot.distance == Approx(1));
  CHECK((foot.normal -
         [] {
           Vec<Dim> n = Vec<Dim>::Zero();
           n[0] = 0.6;
           n[Dim - 1] = 0.8;
           return n;
         }())
            .norm() < 1e-12);
  CHECK(foot.place[0] == Approx(5));
  CHECK(line.foot(at<Dim>(-0.6, -0.8)).distance == Approx(-1));
  CHECK(line.foot(at<Dim>(40.6, -29.2)).distance == Approx(1));  // the last piece goes on for ever
  CHECK(line.profile()->height(8) == Approx(-6));
  CHECK((line.position(foot.place, 1) - at<Dim>(4.6, -2.2)).norm() < 1e-12);
}

TEMPLATE_TEST_CASE_SIG("Foot against brute force over a bumpy profile", "[terrain]", ((int Dim), Dim), 2, 3) {
  SlopeProfile slope;
  slope.bump_height = 2;
  const auto vertices = slope_profile(slope, 150, 0.5);
  const Terrain<Dim> terrain(vertices);
  for (int i = 0; i < 400; ++i) {
    const double x = -5 + 0.4 * i, z = terrain.profile()->height(x) + 6 * std::sin(1.7 * i);
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t k = 0; k + 1 < vertices.size(); ++k) {
      const Vec<2> a = vertices[k], edge = vertices[k + 1] - a;
      double t = (Vec<2>(x, z) - a).dot(edge) / edge.squaredNorm();
      if (k > 0) t = std::max(t, 0.0);
      if (k + 2 < vertices.size()) t = std::min(t, 1.0);
      nearest = std::min(nearest, (a + t * edge - Vec<2>(x, z)).norm());
    }
    const Foot<Dim> foot = terrain.foot(at<Dim>(x, z));
    CHECK(std::abs(foot.distance) == Approx(nearest).margin(1e-12));
    CHECK((foot.distance >= 0) == (z >= terrain.profile()->height(x)));
    CHECK(foot.normal.norm() == Approx(1));
    const Foot<Dim> near = terrain.foot(at<Dim>(x, z), 1.5);
    CHECK(near.distance == (nearest < 1.5 ? foot.distance : std::copysign(1.5, foot.distance)));
    CHECK((terrain.position(foot.place, 0) - at<Dim>(x, z)).norm() == Approx(std::abs(foot.distance)).margin(1e-9));
  }
}

TEST_CASE("A cliff's face has a level normal and keeps its edges", "[terrain]") {
  const Terrain<2> cliff({{0, 10}, {5, 10}, {5, 0}, {20, 0}});
  const Foot<2> face = cliff.foot({6, 5});
  CHECK(face.distance == Approx(1));
  CHECK((face.normal - Vec<2>(1, 0)).norm() < 1e-12);
  CHECK(cliff.foot({4, 5}).distance == Approx(-1));
  const Foot<2> edge = cliff.foot({5.3, 10.4});
  CHECK(edge.distance == Approx(0.5));
  CHECK((edge.normal - Vec<2>(0.6, 0.8)).norm() < 1e-12);
  CHECK(cliff.profile()->height(5) == 10);
  CHECK(cliff.profile()->height(5.001) == 0);
}

TEMPLATE_TEST_CASE_SIG("F1: normals around a cliff are unit vectors, on its edges too", "[terrain]", ((int Dim), Dim),
                       2, 3) {
  const Terrain<Dim> cliff({{0, 10}, {5, 10}, {5, 0}, {20, 0}});
  for (const double x : {0.0, 4.9, 5.0 - 1e-12, 5.0, 5.0 + 1e-12, 5.1, 20.0})
    for (const double z : {-1.0, 0.0, 1e-12, 5.0, 10.0 - 1e-12, 10.0, 10.0 + 1e-12, 12.0}) {
      CAPTURE(x, z);
      const Foot<Dim> foot = cliff.foot(at<Dim>(x, z));
      CHECK(std::isfinite(foot.distance));
      CHECK(foot.normal.norm() == Approx(1));
      CHECK(foot.normal[0] >= -1e-9);
      CHECK(foot.normal[Dim - 1] >= -1e-9);
    }
}

TEST_CASE("Profiles that make no ground are refused", "[terrain]") {
  CHECK_THROWS_AS(Terrain<2>({{0, 0}}), Error);
  CHECK_THROWS_AS(Terrain<2>({{0, 0}, {0, 1}}), Error);
  CHECK_THROWS_AS(Terrain<2>({{0, 0}, {-1, 1}}), Error);
  CHECK_THROWS_AS(Terrain<2>({{0, 0}, {1, nan_}}), Error);
  CHECK_THROWS_AS(Terrain<2>({{0, 0}, {0, 0}, {1, 0}}), Error);
}

TEST_CASE("A slope keeps its drop, its angles and its arc", "[terrain]") {
  SlopeProfile slope;
  slope.start = {3, 60};
  slope.angle = 40 * std::numbers::pi / 180;
  slope.runout_angle = 5 * std::numbers::pi / 180;
  slope.drop = 45;
  const Terrain<2> terrain(slope_profile(slope, 200, 0.25));
  CHECK(terrain.profile()->tangent(1)[1] / terrain.profile()->tangent(1)[0] == Approx(-std::tan(slope.angle)));
  CHECK(terrain.profile()->tangent(terrain.profile()->length())[1] == Approx(-std::sin(slope.runout_angle)));
  const double foot_x = 3 + 45 / std::tan(slope.angle);
  CHECK(terrain.profile()->height(190) == Approx(60 - 45 - (190 - foot_x) * std::tan(slope.runout_angle)));
  double steepest_change = 0;
  for (double s = 0.5; s < terrain.profile()->length(); s += 0.25)
    steepest_change =
        std::max(steepest_change, (terrain.profile()->tangent(s) - terrain.profile()->tangent(s - 0.25)).norm());
  CHECK(steepest_change < 0.25 / slope.transition_radius * 2.1);
}

TEMPLATE_TEST_CASE_SIG("Walls are the ground and the closed sides", "[terrain]", ((int Dim), Dim), 2, 3) {
  Walls<Dim> walls;
  walls.domain = {Vec<Dim>::Zero(), Vec<Dim>::Constant(2)};
  walls.sides[0] = {Side::closed, Side::open};
  int n = 0;
  walls.for_each_near(Vec<Dim>(Vec<Dim>::Constant(0.1)), 0.2, [&](double distance, const Vec<Dim>& normal) {
    ++n;
    CHECK(distance == Approx(0.1));
    CHECK(normal == Vec<Dim>(Vec<Dim>::Unit(0)));
  });
  CHECK(n == 1);
  CHECK(walls.outside(Vec<Dim>(Vec<Dim>::Constant(2.1))));
  CHECK_FALSE(walls.outside(Vec<Dim>(-0.1 * Vec<Dim>::Unit(0) + Vec<Dim>::Constant(0.0))));
}

TEMPLATE_TEST_CASE_SIG("The distance to a box, outside, inside and off its corner", "[terrain]", ((int Dim), Dim), 2,
                       3) {
  const Box<Dim> box{Vec<Dim>::Constant(1), Vec<Dim>::Constant(3)};
  const Vec<Dim> middle = Vec<Dim>::Constant(2);
  const auto beside = surface_of<Dim>(box, middle + 1.5 * Vec<Dim>::Unit(0));
  CHECK(beside.distance == Approx(0.5));
  CHECK(beside.normal == Vec<Dim>(Vec<Dim>::Unit(0)));
  const auto within = surface_of<Dim>(box, middle - 0.75 * Vec<Dim>::Unit(Dim - 1));
  CHECK(within.distance == Approx(-0.25));
  CHECK(within.normal == Vec<Dim>(-Vec<Dim>::Unit(Dim - 1)));
  const auto corner = surface_of<Dim>(box, Vec<Dim>(Vec<Dim>::Constant(3.1)));
  CHECK(corner.distance == Approx(0.1 * std::sqrt(Dim)));
  CHECK((corner.normal - Vec<Dim>::Constant(1 / std::sqrt(Dim))).norm() < 1e-12);
  Walls<Dim> walls;
  walls.domain = {Vec<Dim>::Constant(-10), Vec<Dim>::Constant(10)};
  walls.obstacles = {box};
  int n = 0;
  walls.for_each_near(Vec<Dim>(Vec<Dim>::Constant(3.1)), 0.5, [&](double distance, const Vec<Dim>&) {
    ++n;
    CHECK(distance == corner.distance);
  });
  CHECK(n == 1);
}
