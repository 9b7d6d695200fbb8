#include <catch2/catch.hpp>
#include <limits>

#include "core/parallel.hpp"
#include "io/smoke_volume.hpp"

using namespace spindrift;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
const Light overhead{Vec<3>::UnitZ(), Vec<3>::UnitZ()};

/// Cells of half a metre; the first one's centre is at (10, 20, 30).
struct Cells {
  Index<3> shape;
  std::vector<float> density;
  std::vector<std::uint8_t> solid;

  explicit Cells(const Index<3>& size) : shape(size), density(count<3>(size), 0.0f) {}
  float& at(int i, int j, int k) { return density[flat<3>({i, j, k}, shape)]; }
  SmokeLattice lattice() const { return {density, shape, {10, 20, 30}, 0.5, solid}; }
  void fill(const Index<3>& lower, const Index<3>& upper, float value) {
    for (int k = lower[2]; k < upper[2]; ++k)
      for (int j = lower[1]; j < upper[1]; ++j)
        for (int i = lower[0]; i < upper[0]; ++i) at(i, j, k) = value;
  }
};

}  // namespace

TEST_CASE("a uniform slab dims what is behind it by exp(-extinction thickness)", "[smoke]") {
  // 8 cells of 0.5 m along x, far wider than the rays are long across.
  Cells cells({30, 40, 40});
  const float density = GENERATE(0.02f, 0.2f, 0.8f);
  const double opaque = GENERATE(0.5, 1.0, 4.0);
  cells.fill({10, 0, 0}, {18, 40, 40}, density);
  const SmokeVolume smoke(cells.lattice(), opaque, overhead);
  const double exact = std::exp(-4.0 * density / opaque);
  const double jitter = GENERATE(0.0, 0.37, 0.99);
  SmokeVolume::Seen seen;
  const Vec<3> eye(-20, 30, 40);
  smoke.pass(seen, eye, Vec<3>::UnitX(), 0, infinity, jitter);
  CHECK(seen.clear == Approx(exact).margin(0.005));

  // At 60 degrees the way is twice as long; the length of the direction does not matter.
  SmokeVolume::Seen slanting;
  const Vec<3> direction(1.5, 1.5 * std::sqrt(3), 0);
  const Vec<3> middle(16.75, 30, 40);
  smoke.pass(slanting, middle - 20 * direction, direction, 0, infinity, jitter);
  CHECK(slanting.clear == Approx(exact * exact).margin(0.005));

  // In pieces, front to back, the same comes out; behind the slab nothing is added.
  SmokeVolume::Seen in_two;
  smoke.pass(in_two, eye, Vec<3>::UnitX(), 0, 36.6, jitter);
  smoke.pass(in_two, eye, Vec<3>::UnitX(), 36.6, infinity, jitter);
  CHECK(in_two.clear == Approx(seen.clear).margin(0.003));
  SmokeVolume::Seen before;
  smoke.pass(before, eye, Vec<3>::UnitX(), 0, 33, jitter);
  CHECK(before.clear == 1);
}

TEST_CASE("sunlight is dimmed by exp(-integral of the extinction) on its way, in the smoke and behind it", "[smoke]") {
  Cells cells({60, 60, 20});
  cells.fill({0, 0, 6}, {60, 60, 12}, 0.5f);  // a layer 3 m thick, from z = 32.75 to 35.75
  const double slant = GENERATE(0.0, 30.0, 60.0) * std::acos(-1) / 180;
  const double turn = GENERATE(0.0, 1.0, 4.0);
  const Light light{{std::sin(slant) * std::cos(turn), std::sin(slant) * std::sin(turn), std::cos(slant)},
                    Vec<3>::UnitZ()};
  const SmokeVolume smoke(cells.lattice(), 1, light);
  const auto exact = [&](double above) { return std::exp(-0.5 * above / std::cos(slant)); };
  const Vec<3> middle(24.75, 34.75, 34.25);
  CHECK(smoke.sunlight(middle) == Approx(exact(1.5)).margin(0.02));
  CHECK(smoke.sunlight(middle - Vec<3>(0, 0, 0.75)) == Approx(exact(2.25)).margin(0.02));
  CHECK(smoke.sunlight(middle - Vec<3>(0, 0, 3.25)) == Approx(exact(3)).margin(0.01));
  CHECK(smoke.sunlight(middle + Vec<3>(0, 0, 3)) == 1);
  // Far under the layer, outside all cells, where the way to the sun leads through the middle of it.
  CHECK(smoke.sunlight(middle - 20 * light.sun) == Approx(exact(3)).margin(0.01));
  // And where it leads past it.
  CHECK(smoke.sunlight(middle + Vec<3>(500, 0, -10)) == 1);
}

TEST_CASE("light turned towards the eye is what the smoke takes from behind, times the light that reaches it",
          "[smoke]") {
  // So thin that no light is lost on the way: as much is turned as is hidden.
  Cells cells({20, 20, 20});
  cells.fill({4, 4, 4}, {16, 16, 16}, 1e-3f);
  const SmokeVolume smoke(cells.lattice(), 1, overhead);
  SmokeVolume::Seen seen;
  smoke.pass(seen, {0, 25, 35}, Vec<3>::UnitX(), 0, infinity, 0.5);
  CHECK(seen.clear < 0.995f);
  CHECK(seen.sun == Approx(1 - seen.clear).epsilon(0.01));
  CHECK(seen.sky == Approx(1 - seen.clear).epsilon(0.01));
  // Thick smoke: its lower side gets less of the sun than its upper one.
  cells.fill({4, 4, 4}, {16, 16, 16}, 2);
  const SmokeVolume thick(cells.lattice(), 1, overhead);
  SmokeVolume::Seen upper, lower;
  thick.pass(upper, {0, 25, 37.3}, Vec<3>::UnitX(), 0, infinity, 0.5);
  thick.pass(lower, {0, 25, 33}, Vec<3>::UnitX(), 0, infinity, 0.5);
  CHECK(upper.clear < 0.01f);
  CHECK(lower.clear < 0.01f);
  CHECK(upper.sun > 1.5f * lower.sun);
  CHECK(with_turned(1) == 1);
  CHECK(with_turned(0) == 0);
}

TEST_CASE("smoke between cells is between them, and none where there is none", "[smoke]") {
  Cells cells({9, 9, 9});
  cells.at(4, 4, 4) = 1;
  const SmokeVolume smoke(cells.lattice(), 2, overhead);
  const Vec<3> centre(12, 22, 32);
  // A quarter, a half and a quarter along each axis.
  CHECK(smoke.extinction(centre) == Approx(0.5 / 8));
  CHECK(smoke.extinction(centre + Vec<3>(0.5, 0, 0)) == Approx(0.5 / 16));
  CHECK(smoke.extinction(centre + Vec<3>(0.25, 0, 0)) == Approx(0.75 * 0.5 / 8));
  CHECK(smoke.extinction(centre + Vec<3>(0, -0.5, 0.5)) == Approx(0.5 / 32));
  CHECK(smoke.extinction(centre + Vec<3>(0, 0, 1)) == 0);
  CHECK(smoke.extinction(centre + Vec<3>(99, 0, 0)) == 0);
}

TEST_CASE("smoke reaches into the ground's cells as it lies above them", "[smoke]") {
  Cells cells({20, 20, 20});
  cells.solid.assign(cells.density.size(), 0);
  cells.fill({0, 0, 8}, {20, 20, 16}, 0.5f);
  for (std::size_t c = 0; c < cells.solid.size(); ++c) cells.solid[c] = c < 8 * 400;
  const SmokeVolume smoke(cells.lattice(), 1, overhead);
  CHECK(smoke.extinction({15, 25, 34}) == Approx(0.5));     // the lowest cell of air
  CHECK(smoke.extinction({15, 25, 33.75}) == Approx(0.5));  // the ground's surface
  CHECK(smoke.extinction({15, 25, 32}) == 0);
  cells.solid.clear();
  CHECK(SmokeVolume(cells.lattice(), 1, overhead).extinction({15, 25, 33.75}) < 0.4f);
}

TEST_CASE("what is no density is no smoke, and no smoke is nothing at all", "[smoke]") {
  Cells cells({6, 6, 6});
  cells.at(1, 2, 3) =
      GENERATE(0.0f, -5.0f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity());
  const SmokeVolume smoke(cells.lattice(), 1, overhead);
  CHECK(smoke.empty());
  SmokeVolume::Seen seen;
  smoke.pass(seen, {0, 21, 31}, Vec<3>::UnitX(), 0, infinity, 0.5);
  CHECK(seen.clear == 1);
  CHECK(seen.sun == 0);
  CHECK(smoke.sunlight({11, 21, 31}) == 1);
  CHECK(smoke.skylight({11, 21, 31}) == 1);
}

TEST_CASE("large fields are averaged, and hide as much", "[smoke]") {
  Cells cells({33, 47, 41});
  cells.fill({10, 0, 0}, {18, 47, 41}, 0.3f);
  const SmokeVolume fine(cells.lattice(), 1, overhead), coarse(cells.lattice(), 1, overhead, 9000);
  SmokeVolume::Seen through_fine, through_coarse;
  fine.pass(through_fine, {0, 31, 40}, Vec<3>::UnitX(), 0, infinity, 0.5);
  coarse.pass(through_coarse, {0, 31, 40}, Vec<3>::UnitX(), 0, infinity, 0.5);
  CHECK(through_fine.clear == Approx(std::exp(-1.2)).margin(0.005));
  CHECK(through_coarse.clear == Approx(through_fine.clear).margin(0.02));
  CHECK(coarse.sunlight({16.75, 31, 40}) == Approx(fine.sunlight({16.75, 31, 40})).margin(0.05));
}
