// The median, of few values in any order.

#include <catch2/catch.hpp>

#include "core/median.hpp"

using spindrift::median;

TEST_CASE("The median is the value in the middle, the larger one of two", "[median]") {
  CHECK(median({7}) == 7);
  CHECK(median({3, 1}) == 3);
  CHECK(median({9, -1, 2}) == 2);
  CHECK(median({4, 8, 1, 6}) == 6);
  CHECK(median({5, 5, 1, 5, 9}) == 5);
}
