#pragma once
/// Arrays with a name, as files hold them.

#include <cstdint>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace spindrift {

/// Values of someone else: `components` of them a point, the points one after another.
struct NamedArray {
  std::string name;
  int components = 1;
  std::variant<std::span<const float>, std::span<const double>, std::span<const std::uint8_t>,
               std::span<const std::int64_t>>
      values;

  std::size_t n_values() const {
    return std::visit([](const auto& v) { return v.size(); }, values);
  }
};

/// The same with values of its own.
struct StoredArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<float>, std::vector<double>, std::vector<std::uint8_t>, std::vector<std::int64_t>> values;

  NamedArray view() const {
    return std::visit([this](const auto& v) { return NamedArray{name, components, std::span(v)}; }, values);
  }
};

/// A fact about a whole file.
struct Attribute {
  std::string name;
  std::variant<std::string, double, std::int64_t> value;
};
using Attributes = std::vector<Attribute>;

}  // namespace spindrift
