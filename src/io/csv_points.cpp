#include "io/csv_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "io/component_names.hpp"

namespace spindrift {
namespace {

std::string unit_of(const Attributes& attributes, const std::string& array) {
  const auto found = std::ranges::find(attributes, "unit." + array, &Attribute::name);
  const auto* unit = found == attributes.end() ? nullptr : std::get_if<std::string>(&found->value);
  return unit ? " [" + *unit + "]" : "";
}

}  // namespace

std::string csv_text(const PointCloud& cloud) {
  std::vector<NamedArray> columns{cloud.positions};
  columns.front().name.clear();
  columns.insert(columns.end(), cloud.arrays.begin(), cloud.arrays.end());

  fmt::memory_buffer text;
  const auto into = std::back_inserter(text);
  const char* comma = "";
  for (const NamedArray& array : columns)
    for (int k = 0; k < array.components; ++k, comma = ",") {
      const std::string unit = array.name.empty() ? " [m]" : unit_of(cloud.attributes, array.name);
      fmt::format_to(into, "{}{}{}", comma, component_name(array.name, array.components, k), unit);
    }
  text.push_back('\n');

  const std::size_t n = cloud.n_points();
  for (std::size_t i = 0; i < n; ++i) {
    comma = "";
    for (const NamedArray& array : columns) {
      const std::size_t components = static_cast<std::size_t>(array.components);
      std::visit(
          [&](const auto& values) {
            for (const auto value : values.subspan(i * components, components)) {
              fmt::format_to(into, "{}{}", comma, value);
              comma = ",";
            }
          },
          array.values);
    }
    text.push_back('\n');
  }
  return fmt::to_string(text);
}

}  // namespace spindrift
