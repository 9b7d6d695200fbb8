#pragma once
/// TOML text as a plain tree of values, each with its place: the only door to the TOML package.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace spindrift {

/// Line and column of a value, from 1. Line 0: it was given on the command line.
struct Place {
  std::uint32_t line = 1, column = 1;
};

struct TomlValue;

struct TomlMember {
  std::string name;
  Place place;                   ///< of the name
  std::vector<TomlValue> value;  ///< exactly one
};

using TomlTable = std::vector<TomlMember>;
using TomlList = std::vector<TomlValue>;
struct TomlDate {};

struct TomlValue {
  std::variant<bool, std::int64_t, double, std::string, TomlDate, TomlList, TomlTable> value;
  Place place;
};

/// Text that is not TOML: where, and why.
struct SyntaxError {
  Place place;
  std::string why;
};

/// Members in the order of the text.  Throws SyntaxError: also for values nested, or names dotted, more than 16 deep.
TomlTable parse_toml(std::string_view text);

/// Puts `path` = `text` into `table`, in place of what stood there. The text is TOML, or else taken as a string, so
/// that `solver=wcsph` and `angle=38 deg` need no quotes. Of several tables of one name `name[1]` is the second.
/// Returns what is wrong where there is no such table, or where the path does not say which.
std::optional<std::string> set_member(TomlTable& table, std::string_view path, std::string_view text);

}  // namespace spindrift
