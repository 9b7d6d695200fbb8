// Cover that becomes particles plot by plot.

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "core/random.hpp"
#include "sph/sleeping_cover.hpp"

using namespace spindrift;

namespace {

constexpr double d = 0.25, size = 30;  // plots of 6 m

HeightField hills() {
  HeightGrid grid{{-2, -2}, 1, {36, 36}, {}};
  for_each_index<2>(grid.points, [&](const Index<2>& i) {
    grid.z.push_back(-0.5 * i[0] + 0.8 * std::sin(0.5 * i[0]) * std::cos(0.4 * i[1]));
  });
  return HeightField(grid);
}

CoverLayer layer() {
  return {.to = size, .y = {0, size}, .depth = 0.5, .accepts = [](const Vec<2>& place) { return place[1] > 4; }};
}

struct Snow {
  HeightField ground = hills();
  SnowKind<3> kind{.spacing = d, .density = 100};
  SleepingCover sleeping{layer(), kind};
  Cover<3> bare() const { return bare_cover<3>(layer(), kind); }
  Cover<3> whole() const {
    Cover<3> cover = bare();
    sleeping.wake_all(cover, ground);
    return cover;
  }
  std::size_t wake(Cover<3>& cover, const Box<2>& box) const {
    std::vector<std::uint8_t> called(sleeping.plots().size());
    sleeping.call(box, called);
    return sleeping.wake(cover, ground, called);
  }
};

}  // namespace

TEST_CASE("Cover is the same to the bit whenever its plots are laid", "[cover][height_field]") {
  const Snow snow;
  const Cover<3> whole = snow.whole();
  REQUIRE(whole.particles.size() > 20000);

  Cover<3> bit_by_bit = snow.bare();
  CHECK(bit_by_bit.particles.empty());
  CHECK(bit_by_bit.surface({10, 40}) == 0);
  std::size_t laid = 0;
  for (std::uint64_t n = 0; n < 200; ++n) {
    const Vec<2> at(size * uniform(1, RandomStream::bernoulli, n, 0), size * uniform(1, RandomStream::bernoulli, n, 1));
    laid += snow.wake(bit_by_bit, {at, at});
  }
  laid += snow.wake(bit_by_bit, {{-10, -10}, {size + 10, size + 10}});
  CHECK(laid == whole.particles.size());
  CHECK_FALSE(snow.sleeping.asleep(bit_by_bit, {{0, 0}, {size, size}}));
  CHECK(snow.sleeping.wake_all(bit_by_bit, snow.ground) == 0);

  CHECK(bit_by_bit.particles.id == whole.particles.id);
  CHECK(bit_by_bit.particles.position == whole.particles.position);
  CHECK(bit_by_bit.members == whole.members);
  CHECK(bit_by_bit.first == whole.first);
  CHECK(bit_by_bit.surface_normal == whole.surface_normal);
  std::set<std::uint64_t> ids(whole.particles.id.begin(), whole.particles.id.end());
  CHECK(ids.size() == whole.particles.size());
}

TEST_CASE("What is called over a box is all of the cover whose ground lies in it, and little more",
          "[cover][height_field]") {
  const Snow snow;
  const Cover<3> whole = snow.whole();
  const double edge = snow.sleeping.plots().edge;
  for (std::uint64_t n = 0; n < 40; ++n) {
    const auto random = [&](std::uint64_t k) { return uniform(2, RandomStream::bernoulli, n, k); };
    const Vec<2> at(40 * random(0) - 5, 40 * random(1) - 5);
    const Box<2> box{at, at + 5 * Vec<2>(random(2), random(3))};
    Cover<3> part = snow.bare();
    const std::size_t laid = snow.wake(part, box);
    const std::set<std::uint64_t> ids(part.particles.id.begin(), part.particles.id.end());
    REQUIRE(ids.size() == laid);
    const Vec<2> around = Vec<2>::Constant(edge + 2);
    for (std::size_t i = 0; i < whole.particles.size(); ++i) {
      const Vec<2>& place = whole.foot[i].place;
      if (box.contains(place)) REQUIRE(ids.contains(whole.particles.id[i]));
      if (!Box<2>{box.lower - around, box.upper + around}.contains(place))
        REQUIRE_FALSE(ids.contains(whole.particles.id[i]));
    }
    CHECK_FALSE(snow.sleeping.asleep(part, box));
  }
}

TEST_CASE("Snow that was taken is not laid again, and the surface around it is that of a cover laid at once",
          "[cover][height_field]") {
  const Snow snow;
  Cover<3> whole = snow.whole(), part = snow.bare();
  const Vec<2> at(14.5, 15.5);
  snow.wake(part, {at - Vec<2>::Constant(5), at + Vec<2>::Constant(5)});
  for (Cover<3>* cover : {&whole, &part}) {
    std::vector<GroundBin<3>> bins;
    for (std::uint32_t slot = 0; slot < cover->particles.size(); ++slot) {
      if (!((cover->foot[slot].place - at).norm() < 1.5)) continue;
      bins.push_back(ground_bin<3>(cover->foot[slot].place, cover->bin_size));
      remove_from_cover(*cover, slot);
    }
    REQUIRE(bins.size() > 100);
    if (!compact_cover(*cover)) settle_surface<3>(*cover, bins);
  }
  snow.sleeping.wake_all(part, snow.ground);
  for (std::size_t k = 0; k < 200; ++k) {
    const GroundBin<3> bin{static_cast<int>(k % 20) + 20, static_cast<int>(k / 20) + 25};
    REQUIRE(part.surface(bin) == whole.surface(bin));
    const auto a = part.slots_in(bin), b = whole.slots_in(bin);
    std::vector<Vec<3>> normals_a, normals_b;
    for (const std::uint32_t slot : a)
      if (part.alive(slot)) normals_a.push_back(part.surface_normal[slot]);
    for (const std::uint32_t slot : b)
      if (whole.alive(slot)) normals_b.push_back(whole.surface_normal[slot]);
    REQUIRE(normals_a == normals_b);
  }
}

TEST_CASE("Cover of depth 0 or no extent has no plots", "[cover][height_field]") {
  const HeightField ground = hills();
  for (const CoverLayer& none : {CoverLayer{.to = 10, .y = {0, 10}, .depth = 0}, CoverLayer{.to = 0, .y = {0, 10}}}) {
    const SleepingCover sleeping(none, {.spacing = d});
    Cover<3> cover = bare_cover<3>(none, {.spacing = d});
    CHECK(sleeping.plots().size() == 0);
    CHECK_FALSE(sleeping.asleep(cover, {{-100, -100}, {100, 100}}));
    CHECK(sleeping.wake_all(cover, ground) == 0);
  }
}
