#include "simulation/syntax_hint.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace spindrift {
namespace {

std::string_view trimmed(std::string_view s) {
  while (!s.empty() && (s.front() == ' ' || s.front() == '\t')) s.remove_prefix(1);
  while (!s.empty() && (s.back() == ' ' || s.back() == '\t' || s.back() == '\r')) s.remove_suffix(1);
  return s;
}

std::string_view line_of(std::string_view text, std::size_t line) {
  for (; line > 1; --line) text.remove_prefix(std::min(text.find('\n') + 1, text.size()));
  return text.substr(0, text.find('\n'));
}

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

bool is_number_part(char c) {
  return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+';
}

}  // namespace

std::string syntax_hint(std::string_view text, std::size_t line, std::string_view why) {
  if (why.find("utf-8") != std::string_view::npos) return "; save the file as plain text in UTF-8";
  const std::string_view whole = line_of(text, line);
  const std::string_view said = trimmed(whole.substr(0, whole.find('#')));
  const std::size_t equals = said.find('=');
  if (equals == std::string_view::npos) return "";
  const std::string_view name = trimmed(said.substr(0, equals)), value = trimmed(said.substr(equals + 1));
  if (name.find(' ') != std::string_view::npos && name.find('"') == std::string_view::npos) {
    std::string joined(name);
    std::replace(joined.begin(), joined.end(), ' ', '_');
    return fmt::format("; names have no blanks: {}", joined);
  }
  if (value.empty()) return fmt::format("; a value is missing behind {} =", name);
  const auto digits_end = std::find_if_not(value.begin(), value.end(), is_number_part);
  const bool number_first = digits_end != value.begin();
  if (is_letter(value.front()) &&
      std::all_of(value.begin(), value.end(), [](char c) { return is_letter(c) || c == '_'; }))
    return fmt::format("; words stand in quotes: {} = \"{}\"", name, value);
  if (number_first && digits_end != value.end() && *digits_end == ',' && value.find('[') == std::string_view::npos)
    return "; decimals have a point, and lists stand in [ ]";
  const std::string_view unit = trimmed({digits_end, value.end()});
  const bool has_unit = !unit.empty() && (is_letter(unit.front()) || static_cast<unsigned char>(unit.front()) >= 0x80);
  if (number_first && has_unit && value.find_first_of("\"'[{") == std::string_view::npos)
    return fmt::format("; a number with its unit stands in quotes: {} = \"{}\"", name, value);
  return "";
}

}  // namespace spindrift
