#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "simulation/spelling.hpp"
#include "simulation/units.hpp"

using namespace spindrift;

namespace {

std::string complaint(std::string_view text) {
  try {
    parse_quantity(text);
  } catch (const UnitError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("quantities come out in SI", "[units]") {
  struct Row {
    std::string_view text;
    double value;
    std::string_view same_as;
  };
  const Row row =
      GENERATE(Row{"0.33 m", 0.33, "m"}, Row{"33cm", 0.33, "m"}, Row{"2 km", 2000, "m"}, Row{"10 ms", 0.01, "s"},
               Row{"5 min", 300, "s"}, Row{"1.5 h", 5400, "s"}, Row{"38 deg", 38 * std::numbers::pi / 180, "rad"},
               Row{"38°", 38 * std::numbers::pi / 180, "rad"}, Row{"1.2 kg/m^3", 1.2, "kg m^-3"},
               Row{"0.3 g/cm^3", 300, "kg/m^3"}, Row{"72 km/h", 20, "m/s"}, Row{"9.81 m/s^2", 9.81, "m s^-2"},
               Row{"9.81 m/s/s", 9.81, "m/s^2"}, Row{"-9.81 m*s^-2", -9.81, "m/s^2"}, Row{"+3 kPa s", 3000, "Pa s"},
               Row{"4 N/m^2", 4, "Pa"}, Row{"10 kg m^-2 s^-1", 10, "kg/(m^2 s)"}, Row{"24 Hz", 24, "1/s"},
               Row{"0.02 kg m^-2 s^-1 (m/s)^-1.7", 0.02, "kg m^-3.7 s^0.7"}, Row{"5 %", 0.05, ""}, Row{"7", 7, "1"},
               Row{"  1e3  m ", 1000, "m"}, Row{"1e-3 t", 1, "kg"});
  CAPTURE(row.text);
  const Quantity quantity = parse_quantity(row.text);
  CHECK(quantity.value == Approx(row.value).epsilon(1e-14));
  CHECK(same(quantity.dimension, parse_unit(row.same_as).dimension));
}

TEST_CASE("dimensions that differ are told apart", "[units]") {
  const auto unit = GENERATE(as<std::string>{}, "s", "m^2", "m/s", "kg", "rad", "1", "m^1.001");
  CHECK_FALSE(same(parse_unit(unit).dimension, parse_unit("m").dimension));
}

TEST_CASE("what is no quantity is refused with a reason", "[units]") {
  CHECK(complaint("5 metre") == "the unit \"metre\" is unknown");
  CHECK(complaint("5 dag") == "the unit \"dag\" is unknown; did you mean \"deg\"?");
  CHECK(complaint("m") == "it does not begin with a number");
  CHECK(complaint("") == "it does not begin with a number");
  CHECK(complaint("+-5 m") == "it does not begin with a number");
  CHECK(complaint("1e400 m") == "the number is too large or too small");
  CHECK(complaint("5 m^") == "\" m^\" is not a unit");
  CHECK(complaint("5 m^nan") == "\" m^nan\" is not a unit");
  CHECK(complaint("5 (m") == "\" (m\" is not a unit");
  CHECK(complaint("5 m)") == "\" m)\" is not a unit");
  CHECK(complaint("5 m/") == "\" m/\" is not a unit");
  CHECK(complaint("5 " + std::string(60000, '(')).substr(0, 3) == "\" (");
}

TEST_CASE("dimensions have names", "[units]") {
  CHECK(name_of(parse_unit("km").dimension) == "a length");
  CHECK(name_of(parse_unit("min").dimension) == "a time");
  CHECK(name_of(parse_unit("g/cm^3").dimension) == "a density");
  CHECK(name_of(parse_unit("").dimension) == "a plain number");
  CHECK(name_of(parse_unit("kg m^-2 s^-1 (m/s)^-1.7").dimension) == "a quantity in kg m^-3.7 s^0.7");
}

TEST_CASE("numbers are written so that the same bits are read", "[units]") {
  const double x = GENERATE(0.0, 0.1, 1.0 / 3, -2.5e-308, 5e-324, 1e22, std::numeric_limits<double>::max());
  CHECK(parse_quantity(number_text(x)).value == x);
}

TEST_CASE("edit distance counts insertions, deletions, replacements and swaps", "[spelling]") {
  CHECK(edit_distance("", "") == 0);
  CHECK(edit_distance("", "abc") == 3);
  CHECK(edit_distance("kitten", "sitting") == 3);
  CHECK(edit_distance("rnu", "run") == 1);
  CHECK(edit_distance("domain", "domian") == 1);
  CHECK(edit_distance("drag", "drag") == 0);
}

TEST_CASE("the nearest name is offered only if it is near", "[spelling]") {
  const std::vector<std::string_view> names = {"support_radius", "density", "solver", "to", "at"};
  CHECK(nearest("suport_radius", names) == "support_radius");
  CHECK(nearest("densty", names) == "density");
  CHECK_FALSE(nearest("temperature", names).has_value());
  CHECK_FALSE(nearest("x", names).has_value());
  CHECK_FALSE(nearest("", names).has_value());
  CHECK_FALSE(nearest(std::string(100000, 'd'), names).has_value());
  CHECK(did_you_mean("solvr", names) == "; did you mean \"solver\"?");
  CHECK(did_you_mean("zzzzzz", names) == "");
}
