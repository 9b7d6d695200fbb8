#include "io/ply.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <limits>

#include "io/component_names.hpp"

namespace spindrift {

static_assert(std::endian::native == std::endian::little, "values are copied as they stand in memory");

namespace {

using Bytes = std::vector<std::byte>;

struct Column {
  const NamedArray* array;
  const char* type;
};

const char* type_of(const NamedArray& array) {
  if (std::holds_alternative<std::span<const float>>(array.values)) return "float";
  if (std::holds_alternative<std::span<const double>>(array.values)) return "double";
  if (std::holds_alternative<std::span<const std::uint8_t>>(array.values)) return "uchar";
  const auto values = std::get<std::span<const std::int64_t>>(array.values);
  using Int = std::numeric_limits<std::int32_t>;
  return std::ranges::all_of(values, [](std::int64_t v) { return v >= Int::min() && v <= Int::max(); }) ? "int"
                                                                                                        : "double";
}

template <class T>
void append(Bytes& bytes, T value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  std::memcpy(bytes.data() + at, &value, sizeof value);
}

void append_point(Bytes& bytes, const Column& column, std::size_t point) {
  const std::size_t components = static_cast<std::size_t>(column.array->components);
  std::visit(
      [&](const auto& values) {
        using T = typename std::decay_t<decltype(values)>::value_type;
        for (const T value : values.subspan(point * components, components)) {
          if constexpr (!std::is_same_v<T, std::int64_t>) {
            append(bytes, value);
          } else if (column.type == std::string_view("int")) {
            append(bytes, static_cast<std::int32_t>(value));
          } else {
            append(bytes, static_cast<double>(value));
          }
        }
      },
      column.array->values);
}

/// Of the form "name: value", on one line.
std::string comment(const Attribute& attribute) {
  std::string text = std::visit([](const auto& v) { return fmt::format("{}", v); }, attribute.value);
  text = attribute.name + ": " + text;
  std::ranges::replace_if(
      text, [](char c) { return c == '\n' || c == '\r'; }, ' ');
  return text;
}

}  // namespace

Bytes ply_bytes(const PointCloud& cloud) {
  NamedArray positions = cloud.positions;
  positions.name.clear();
  std::vector<Column> columns{{&positions, type_of(positions)}};
  for (const NamedArray& array : cloud.arrays) columns.push_back({&array, type_of(array)});
  const std::size_t n = cloud.n_points();

  std::string header = "ply\nformat binary_little_endian 1.0\n";
  for (const Attribute& attribute : cloud.attributes) header += "comment " + comment(attribute) + "\n";
  header += fmt::format("element vertex {}\n", n);
  for (const auto& [array, type] : columns)
    for (int k = 0; k < array->components; ++k)
      header += fmt::format("property {} {}\n", type, component_name(array->name, array->components, k));
  header += "end_header\n";

  const auto start = std::as_bytes(std::span(header));
  Bytes bytes(start.begin(), start.end());
  for (std::size_t i = 0; i < n; ++i)
    for (const Column& column : columns) append_point(bytes, column, i);
  return bytes;
}

}  // namespace spindrift
