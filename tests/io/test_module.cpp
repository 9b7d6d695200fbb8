#include <catch2/catch.hpp>
#include <string>

#include "core/error.hpp"
#include "io/module.hpp"

using namespace spindrift;

namespace {

std::string why(const char* file) {
  try {
    load_module(file, "rel.shp");
  } catch (const Error& error) {
    CHECK(error.code() == ExitCode::bad_input);
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("A module that does not load is told with what asked for it and why", "[io]") {
  CHECK_THAT(why("spindrift_none.so"),
             Catch::StartsWith("rel.shp needs spindrift_none.so, which does not load: spindrift_none.so: cannot open"));
  CHECK_THAT(why("libm.so.6"), Catch::StartsWith("rel.shp needs libm.so.6") && Catch::Contains("spindrift_module"));
}
