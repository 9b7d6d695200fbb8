#include "simulation/scene_values.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <numbers>

#include "simulation/spelling.hpp"
#include "simulation/units.hpp"

namespace spindrift {
namespace {

bool contains(const Range& range, double x) {
  const bool high_enough = range.above_low ? x > range.low : x >= range.low;
  return high_enough && (range.below_high ? x < range.high : x <= range.high);
}

/// " above 0 and at most 100 m"; angles in degrees.
std::string text_of(const Range& range, std::string_view unit) {
  const bool angle = unit == "rad";
  const auto number = [&](double x) {
    return number_text(angle ? std::round(x * 180 / std::numbers::pi * 1e9) / 1e9 : x);
  };
  const std::string low = fmt::format(" {} {}", range.above_low ? "above" : "from", number(range.low));
  const std::string high = range.below_high
                               ? " and below " + number(range.high)
                               : fmt::format(" {} {}", range.above_low ? "and at most" : "to", number(range.high));
  return low + high + (unit.empty() ? "" : fmt::format(" {}", angle ? "deg" : unit));
}

/// Why a literal does not fit: `got X{kind}, expected {each}Y{hint}`.
struct Refusal {
  const TomlValue& literal;
  std::string hint, kind, each;
};

/// The value of a literal as each type of field takes it.  All throw Refusal.
class Converter {
 public:
  Converter(const Key& key, int dim) : key_(key), dim_(static_cast<std::size_t>(dim)) {}

  void operator()(const TomlValue& literal, bool& field) const { field = as<bool>(literal); }

  template <std::integral Integer>
  requires(!std::same_as<Integer, bool>) void operator()(const TomlValue& literal, Integer& field) const {
    const auto n = as<std::int64_t>(literal);
    if (!contains(key_.range, static_cast<double>(n))) throw Refusal{literal, {}, {}, {}};
    field = static_cast<Integer>(n);
  }

  void operator()(const TomlValue& literal, std::string& field) const {
    const auto& text = as<std::string>(literal);
    if (!key_.words.empty() && std::find(key_.words.begin(), key_.words.end(), text) == key_.words.end())
      throw Refusal{literal, did_you_mean(text, key_.words), {}, {}};
    field = text;
  }

  void operator()(const TomlValue& literal, double& field) const { field = number(literal); }

  void operator()(const TomlValue& literal, std::vector<double>& field) const {
    field = numbers(literal, key_.in_plan ? dim_ - 1 : dim_);
  }

  void operator()(const TomlValue& literal, std::array<double, 2>& field) const {
    const auto list = numbers(literal, 2);
    field = {list[0], list[1]};
  }

  void operator()(const TomlValue& literal, std::vector<std::array<double, 2>>& field) const {
    std::vector<std::array<double, 2>> points;
    for (const TomlValue& item : as<TomlList>(literal, "a list of pairs, each number "))
      (*this)(item, points.emplace_back());
    field = std::move(points);
  }

  void operator()(const TomlValue& literal, std::vector<std::vector<std::array<double, 2>>>& field) const {
    std::vector<std::vector<std::array<double, 2>>> outlines;
    for (const TomlValue& item : as<TomlList>(literal, "a list of outlines, each number "))
      (*this)(item, outlines.emplace_back());
    field = std::move(outlines);
  }

 private:
  template <class T>
  static const T& as(const TomlValue& literal, std::string_view each = "") {
    const T* value = std::get_if<T>(&literal.value);
    if (value == nullptr) throw Refusal{literal, {}, {}, std::string(each)};
    return *value;
  }

  double number(const TomlValue& literal) const {
    double x = 0;
    if (const auto* whole = std::get_if<std::int64_t>(&literal.value)) {
      x = static_cast<double>(*whole);
    } else if (const auto* text = std::get_if<std::string>(&literal.value)) {
      x = number(literal, *text);
    } else {
      x = as<double>(literal);
    }
    if (std::isfinite(x) && contains(key_.range, x)) return x;
    const bool bare_angle =
        key_.unit == "rad" && std::isfinite(x) && !std::holds_alternative<std::string>(literal.value);
    throw Refusal{literal, bare_angle ? fmt::format("; did you mean \"{} deg\"?", text_of(literal)) : "", {}, {}};
  }

  double number(const TomlValue& literal, const std::string& text) const {
    Quantity quantity;
    try {
      quantity = parse_quantity(text);
    } catch (const UnitError& error) {
      throw Refusal{literal, fmt::format("; {}", error.what()), {}, {}};
    }
    if (!same(quantity.dimension, parse_unit(key_.unit).dimension))
      throw Refusal{literal, {}, fmt::format(", {}", name_of(quantity.dimension)), {}};
    return quantity.value;
  }

  std::vector<double> numbers(const TomlValue& literal, std::size_t count) const {
    const std::string each = fmt::format("a list of {}, each ", count);
    const TomlList& list = as<TomlList>(literal, each);
    if (list.size() != count) throw Refusal{literal, {}, {}, each};
    std::vector<double> out;
    for (const TomlValue& item : list) out.push_back(number(item));
    return out;
  }

  const Key& key_;
  std::size_t dim_;
};

struct Expectation {
  const Key& key;

  std::string operator()(bool*) const { return "true or false"; }
  std::string operator()(int*) const { return "a whole number" + text_of(key.range, ""); }
  std::string operator()(std::uint64_t*) const { return "a whole number from 0"; }
  std::string operator()(std::string*) const {
    std::string text;
    for (std::size_t i = 0; i < key.words.size(); ++i)
      text += fmt::format("{}\"{}\"", i == 0 ? "" : i + 1 < key.words.size() ? ", " : " or ", key.words[i]);
    return text.empty() ? "a string" : text;
  }
  template <class Numbers>
  std::string operator()(Numbers*) const {
    const std::string what = key.unit.empty() ? "a number" : name_of(parse_unit(key.unit).dimension);
    return what + text_of(key.range, key.unit);
  }
};

}  // namespace

void assign(Scene& scene, const Key& key, std::size_t index, const TomlValue& literal, std::string_view path,
            SceneReport& report) {
  const Converter convert(key, scene.scene.dim);
  try {
    std::visit([&](auto* field) { convert(literal, *field); }, key.field(scene, index));
  } catch (const Refusal& refusal) {
    report.add(refusal.literal.place, path,
               fmt::format("got {}{}, expected {}{}{}", text_of(refusal.literal), refusal.kind, refusal.each,
                           expectation(key), refusal.hint));
  }
}

std::string expectation(const Key& key) {
  Scene scene = complete_scene("physical");
  return std::visit(Expectation{key}, key.field(scene));
}

}  // namespace spindrift
