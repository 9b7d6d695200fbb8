#include <catch2/catch.hpp>
#include <vector>

#include "io/digest.hpp"

using namespace spindrift;

TEST_CASE("bare bytes give the published values of XXH3-128", "[digest]") {
  CHECK(Digest().hex() == "99aa06d3014798d86001c324468d497f");
  const std::string abc = "abc";
  CHECK(Digest().bytes(std::as_bytes(std::span(abc))).hex() == "06b05ab6733a618578af5f94892f3950");
}

TEST_CASE("a digest built piece by piece depends on the pieces, their order and their lengths", "[digest]") {
  const std::vector<double> a{1, 2, 3}, b{4, 5}, a_long{1, 2, 3, 4}, b_short{5};
  const auto of = [](std::span<const double> x, std::span<const double> y) { return Digest().add(x).add(y).hex(); };
  CHECK(of(a, b) == of(a, b));
  CHECK(of(a, b) != of(b, a));
  CHECK(of(a, b) != of(a_long, b_short));
  CHECK(of(a, {}) != of({}, a));
  CHECK(Digest().add("ab").add("c").hex() != Digest().add("a").add("bc").hex());
}

TEST_CASE("one flipped bit anywhere changes the digest", "[digest]") {
  std::vector<std::uint8_t> data(300, 17);
  const std::string whole = Digest().add(std::span<const std::uint8_t>(data)).hex();
  for (std::size_t i = 0; i < data.size(); ++i) {
    data[i] ^= 4;
    CHECK(Digest().add(std::span<const std::uint8_t>(data)).hex() != whole);
    data[i] ^= 4;
  }
  CHECK(Digest().add(std::span<const std::uint8_t>(data)).hex() == whole);
}

TEST_CASE("a digest may be read on the way", "[digest]") {
  Digest digest;
  digest.add(1.0);
  const std::string half = digest.hex();
  CHECK(digest.hex() == half);
  CHECK(digest.add(2.0).hex() != half);
  CHECK(digest.hex() == Digest().add(1.0).add(2.0).hex());
}
