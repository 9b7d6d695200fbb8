#pragma once
/// Quantities with units, "38 deg" or "1.2 kg/m^3", as SI numbers, with the check that a length stands where a length
/// is expected.

#include <array>
#include <stdexcept>
#include <string>
#include <string_view>

namespace spindrift {

/// Exponents of metre, second, kilogram and radian. Fractions occur: kg m^-2 s^-1 (m/s)^-1.7.
using Dimension = std::array<double, 4>;

struct Unit {
  double factor = 1;  ///< what one of it is in SI
  Dimension dimension{};
};

struct Quantity {
  double value = 0;  ///< in SI
  Dimension dimension{};
};

/// What is wrong with a quantity, as the end of a sentence: `the unit "metre" is unknown; did you mean "m"?`
class UnitError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A unit such as "m", "kg/m^3", "kg m^-2 s^-1 (m/s)^-1.7": factors side by side, '*' or '/' between them (a '/'
/// divides by the one factor that follows), '^' with a number, parentheses. "" and "1" have no dimension.  Throws
/// UnitError.
Unit parse_unit(std::string_view text);

/// A number and a unit, blanks between them optional.  Throws UnitError.
Quantity parse_quantity(std::string_view text);

bool same(const Dimension& a, const Dimension& b);

/// "a length", "a speed", or for what has no name "a quantity in kg m^-2 s^-1".
std::string name_of(const Dimension& dimension);

/// The shortest text that reads back as the same bits, the same in every locale: 0.1, 1e-06, -3.
std::string number_text(double value);

}  // namespace spindrift
