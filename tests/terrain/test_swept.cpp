// F13: nothing jumps over a box, however thin it is and however far something moves in a step.

#include <catch2/catch.hpp>
#include <random>

#include "terrain/swept.hpp"

using namespace spindrift;

namespace {

template <int Dim>
bool strictly_inside(const Box<Dim>& box, const Vec<Dim>& x) {
  return (x.array() > box.lower.array()).all() && (x.array() < box.upper.array()).all();
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("F13: the face by which a way enters a thin box", "[terrain]", ((int Dim), Dim), 2, 3) {
  Box<Dim> wall{Vec<Dim>(Vec<Dim>::Constant(-5)), Vec<Dim>(Vec<Dim>::Constant(5))};
  wall.lower[0] = 2, wall.upper[0] = 2.01;
  const auto at = [](double x, double across) {
    Vec<Dim> place = Vec<Dim>::Constant(across);
    place[0] = x;
    return place;
  };
  const auto ahead = entry_into<Dim>(wall, at(0, 0), at(1000, 3));
  REQUIRE(ahead);
  CHECK(ahead->place == 2);
  CHECK(ahead->normal == -Vec<Dim>::Unit(0));
  const auto back = entry_into<Dim>(wall, at(3, 0), at(-3, 1));
  REQUIRE(back);
  CHECK(back->place == 2.01);
  CHECK(back->normal == Vec<Dim>::Unit(0));
  CHECK(!entry_into<Dim>(wall, at(0, 0), at(1.99, 3)));                     // stops before it
  CHECK(!entry_into<Dim>(wall, at(0, 6), at(5, 6)));                        // passes beside it
  CHECK(!entry_into<Dim>(wall, at(2.005, 0), at(9, 0)));                    // begins inside
  CHECK(!entry_into<Dim>(wall, at(2, 0), at(2, 1)));                        // slides along the face
  CHECK(!entry_into<Dim>(wall, at(2, 0), at(1, 1)));                        // leaves the face
  CHECK(entry_into<Dim>(wall, at(2, 0), at(9, 1)));                         // from the face through the box
  CHECK(entry_into<Dim>(wall, at(std::nextafter(2.0, 3.0), 0), at(9, 0)));  // the same, rounded
}

TEMPLATE_TEST_CASE_SIG("F13: a way meets a box where sampling it finds it inside", "[terrain]", ((int Dim), Dim), 2,
                       3) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto random = [&] {
    Vec<Dim> x;
    for (int k = 0; k < Dim; ++k) x[k] = uniform(engine);
    return x;
  };
  int n_hits = 0, n_misses = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const Vec<Dim> a = random(), b = random(), from = random(), to = random();
    const Box<Dim> box{a.cwiseMin(b), a.cwiseMax(b)};
    if (strictly_inside<Dim>(box, from)) continue;
    constexpr int n = 5000;
    int first = n + 1;
    for (int i = n; i >= 0; --i)
      if (strictly_inside<Dim>(box, from + i / double(n) * (to - from))) first = i;
    const auto hit = entry_into<Dim>(box, from, to);
    if (first > n) {
      ++n_misses;
      continue;  // a corner may be cut between two samples
    }
    ++n_hits;
    REQUIRE(hit);
    const Vec<Dim> entered = from + first / double(n) * (to - from);
    const double beyond = hit->normal.dot(entered - hit->place * hit->normal.cwiseAbs());
    CHECK(beyond <= 0);
    CHECK(beyond > -2.0 * (to - from).norm() / n);
    CHECK(hit->normal.dot(to - from) < 0);
  }
  CHECK(n_hits > 20);
  CHECK(n_misses > 20);
}
