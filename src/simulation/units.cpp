#include "simulation/units.hpp"

#include <charconv>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "simulation/spelling.hpp"

namespace spindrift {
namespace {

constexpr Dimension none{}, length{1, 0, 0, 0}, duration{0, 1, 0, 0}, mass{0, 0, 1, 0}, angle{0, 0, 0, 1};
constexpr Dimension frequency{0, -1, 0, 0}, force{1, -2, 1, 0}, pressure{-1, -2, 1, 0};

struct NamedUnit {
  std::string_view name;
  Unit unit;
};

constexpr NamedUnit units[] = {
    {"m", {1, length}},
    {"km", {1e3, length}},
    {"cm", {1e-2, length}},
    {"mm", {1e-3, length}},
    {"s", {1, duration}},
    {"ms", {1e-3, duration}},
    {"us", {1e-6, duration}},
    {"min", {60, duration}},
    {"h", {3600, duration}},
    {"kg", {1, mass}},
    {"g", {1e-3, mass}},
    {"t", {1e3, mass}},
    {"rad", {1, angle}},
    {"deg", {std::numbers::pi / 180, angle}},
    {"°", {std::numbers::pi / 180, angle}},
    {"Hz", {1, frequency}},
    {"N", {1, force}},
    {"kN", {1e3, force}},
    {"Pa", {1, pressure}},
    {"kPa", {1e3, pressure}},
    {"1", {1, none}},
    {"%", {1e-2, none}},
};

struct NamedDimension {
  std::string_view name;
  Dimension dimension;
};

constexpr NamedDimension dimensions[] = {
    {"a plain number", none},
    {"a length", length},
    {"a time", duration},
    {"a mass", mass},
    {"an angle", angle},
    {"a rate", frequency},
    {"a force", force},
    {"a pressure", pressure},
    {"a speed", {1, -1, 0, 0}},
    {"an acceleration", {1, -2, 0, 0}},
    {"an area", {2, 0, 0, 0}},
    {"a volume", {3, 0, 0, 0}},
    {"a density", {-3, 0, 1, 0}},
    {"a viscosity", {-1, -1, 1, 0}},
    {"a diffusivity", {2, -1, 0, 0}},
    {"a mass flux", {-2, -1, 1, 0}},
    {"a mass rate of a volume", {-3, -1, 1, 0}},
};

constexpr bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

/// Recursive descent over unit = [factor] {["*" | "/"] factor}, factor = (name | "(" unit ")") ["^" number].
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text), rest_(text) {}

  Unit whole() {
    skip_blanks();
    const Unit unit = rest_.empty() ? Unit{} : product();
    if (!rest_.empty()) fail();
    return unit;
  }

 private:
  Unit product() {
    Unit total = !rest_.empty() && rest_[0] == '/' ? Unit{} : factor();
    for (skip_blanks(); !rest_.empty() && rest_[0] != ')'; skip_blanks()) {
      const bool divides = take('/');
      if (!divides) take('*');
      skip_blanks();
      multiply(total, factor(), divides ? -1 : 1);
    }
    return total;
  }

  Unit factor() {
    Unit unit;
    if (take('(')) {
      if (++depth_ > 4) fail();
      skip_blanks();
      unit = product();
      if (!take(')')) fail();
      --depth_;
    } else {
      unit = named();
    }
    if (!take('^')) return unit;
    double exponent = 0;
    const auto [end, error] = std::from_chars(rest_.data(), rest_.data() + rest_.size(), exponent);
    if (error != std::errc{} || !std::isfinite(exponent)) fail();
    rest_.remove_prefix(static_cast<std::size_t>(end - rest_.data()));
    Unit power;
    multiply(power, unit, exponent);
    return power;
  }

  Unit named() {
    const std::size_t end = rest_.find_first_of(" \t*/^()");
    const std::string_view name = rest_.substr(0, end);
    if (name.empty()) fail();
    std::vector<std::string_view> names;
    for (const NamedUnit& u : units) {
      if (u.name == name) {
        rest_.remove_prefix(name.size());
        return u.unit;
      }
      names.push_back(u.name);
    }
    throw UnitError("the unit \"" + std::string(name) + "\" is unknown" + did_you_mean(name, names));
  }

  static void multiply(Unit& total, const Unit& by, double exponent) {
    total.factor *= std::pow(by.factor, exponent);
    for (std::size_t k = 0; k < total.dimension.size(); ++k) total.dimension[k] += exponent * by.dimension[k];
  }

  void skip_blanks() {
    while (!rest_.empty() && is_blank(rest_[0])) rest_.remove_prefix(1);
  }
  bool take(char c) {
    if (rest_.empty() || rest_[0] != c) return false;
    rest_.remove_prefix(1);
    return true;
  }
  [[noreturn]] void fail() const { throw UnitError("\"" + std::string(text_) + "\" is not a unit"); }

  std::string_view text_, rest_;
  int depth_ = 0;
};

}  // namespace

Unit parse_unit(std::string_view text) {
  return UnitParser(text).whole();
}

Quantity parse_quantity(std::string_view text) {
  while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
  std::string_view digits = text;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error == std::errc::result_out_of_range) throw UnitError("the number is too large or too small");
  if (error != std::errc{} || text.starts_with("+-")) throw UnitError("it does not begin with a number");
  const Unit unit = parse_unit(std::string_view(end, digits.data() + digits.size()));
  return {value * unit.factor, unit.dimension};
}

bool same(const Dimension& a, const Dimension& b) {
  for (std::size_t k = 0; k < a.size(); ++k)
    if (std::abs(a[k] - b[k]) > 1e-9) return false;
  return true;
}

std::string name_of(const Dimension& dimension) {
  for (const NamedDimension& known : dimensions)
    if (same(known.dimension, dimension)) return std::string(known.name);
  constexpr std::string_view symbols[] = {"m", "s", "kg", "rad"};
  std::string text = "a quantity in";
  for (const std::size_t k : {std::size_t{2}, std::size_t{0}, std::size_t{1}, std::size_t{3}}) {
    if (std::abs(dimension[k]) <= 1e-9) continue;
    text += " " + std::string(symbols[k]);
    const double rounded = std::round(dimension[k] * 1e9) / 1e9;
    if (rounded != 1) text += "^" + number_text(rounded);
  }
  return text;
}

std::string number_text(double value) {
  char buffer[32];
  const auto [end, error] = std::to_chars(buffer, buffer + sizeof buffer, value);
  return {buffer, end};
}

}  // namespace spindrift
