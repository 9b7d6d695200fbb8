#include <catch2/catch.hpp>
#include <vector>

#include "io/system.hpp"
#include "temporary_folder.hpp"

using namespace spindrift;

TEST_CASE("peak memory grows with what is touched", "[system]") {
  const std::uint64_t before = peak_memory_bytes();
  REQUIRE(before > 0);
  std::vector<char> block(before + (std::size_t{64} << 20), 1);
  CHECK(block[block.size() / 2] == 1);
  CHECK(peak_memory_bytes() >= before + (std::size_t{32} << 20));
  CHECK(available_memory_bytes() > 0);
}

TEST_CASE("free disk space of a path that does not exist yet is that of its nearest folder", "[system]") {
  const TemporaryFolder folder;
  CHECK(free_disk_bytes(folder.path()) > 0);
  CHECK(free_disk_bytes(folder.path() / "not" / "yet" / "there") > 0);
  CHECK(free_disk_bytes("relative/and/absent") > 0);
}
