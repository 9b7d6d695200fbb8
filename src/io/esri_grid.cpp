#include "io/esri_grid.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>
#include <limits>
#include <map>
#include <optional>
#include <string_view>

namespace spindrift {
namespace {

constexpr double most_heights = 5e7, highest = 1e5;  // [m]
constexpr double hole = std::numeric_limits<double>::quiet_NaN();

/// Words one after the other, and the line that each stands in.
class Words {
 public:
  explicit Words(std::string_view text) : text_(text) {}

  /// The next word; empty at the end.
  std::string_view next() {
    while (at_ < text_.size() && is_blank(text_[at_])) line_ += text_[at_++] == '\n';
    const std::size_t begin = at_;
    while (at_ < text_.size() && !is_blank(text_[at_])) ++at_;
    return text_.substr(begin, at_ - begin);
  }
  std::string_view peek() const { return Words(*this).next(); }
  int line() const { return line_; }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t' || c == '\f' || c == '\v'; }

  std::string_view text_;
  std::size_t at_ = 0;
  int line_ = 1;
};

std::optional<double> number(std::string_view word) {
  double x = 0;
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto read = std::from_chars(word.data(), word.data() + word.size(), x);
  if (read.ec != std::errc() || read.ptr != word.data() + word.size()) return std::nullopt;
  return x;
}

std::string lowered(std::string_view word) {
  std::string text(word);
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

class Parser {
 public:
  Parser(std::string_view text, const std::string& name) : words_(text), name_(name) {}

  ElevationGrid parse() {
    read_header();
    ElevationGrid grid;
    grid.columns = points("ncols");
    grid.rows = points("nrows");
    if (static_cast<double>(grid.columns) * grid.rows > most_heights)
      refuse(fmt::format("{} x {} heights, at most {:g} can be: cut it to the part that the domain covers",
                         grid.columns, grid.rows, most_heights));
    grid.cell = cell();
    grid.x = first('x', grid.cell);
    grid.y = first('y', grid.cell);
    read_heights(grid);
    return grid;
  }

 private:
  [[noreturn]] void refuse(const std::string& why) const { throw GridFileError(fmt::format("{}: {}", name_, why)); }
  [[noreturn]] void refuse_here(const std::string& why) const {
    throw GridFileError(fmt::format("{}:{}: {}", name_, words_.line(), why));
  }
  static std::string shown(std::string_view word) {
    std::string text(word.substr(0, 40));
    for (char& c : text)
      if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    return '"' + text + '"';
  }

  void read_header() {
    constexpr std::array<std::string_view, 10> known = {
        "ncols", "nrows", "xllcorner", "xllcenter", "yllcorner", "yllcenter", "cellsize", "dx", "dy", "nodata_value"};
    for (;;) {
      const std::string_view word = words_.peek();
      if (word.empty() || number(word)) break;
      words_.next();
      std::string key = lowered(word);
      if (key.ends_with("centre")) key.replace(key.size() - 6, 6, "center");
      if (std::find(known.begin(), known.end(), key) == known.end())
        refuse_here(
            fmt::format("got {}, expected the header of an ESRI ASCII grid: ncols, nrows, xllcorner or "
                        "xllcenter, yllcorner or yllcenter, cellsize, NODATA_value",
                        shown(word)));
      const std::string_view value = words_.next();
      const std::optional<double> x = number(value);
      if (!x || (!std::isfinite(*x) && key != "nodata_value"))
        refuse_here(fmt::format("got {}, expected a number behind {}{}", shown(value), word, comma_hint(value)));
      if (!header_.emplace(key, *x).second) refuse_here(fmt::format("{} stands there twice", word));
    }
  }

  static std::string_view comma_hint(std::string_view word) {
    return word.find(',') != std::string_view::npos ? "; decimals have a point" : "";
  }

  std::optional<double> header(const std::string& key) const {
    const auto found = header_.find(key);
    if (found == header_.end()) return std::nullopt;
    return found->second;
  }

  int points(const std::string& key) const {
    const auto n = header(key);
    if (!n) refuse(fmt::format("its header has no {}", key));
    if (!(*n >= 2) || !(*n <= most_heights) || *n != std::floor(*n))
      refuse(fmt::format("{} is {}, expected a whole number from 2 on", key, *n));
    return static_cast<int>(*n);
  }

  double cell() const {
    const auto size = header("cellsize"), dx = header("dx"), dy = header("dy");
    if (!size && !(dx && dy)) refuse("its header has no cellsize");
    if (!size && std::abs(*dx - *dy) > 1e-9 * std::abs(*dx))
      refuse(fmt::format("cells of {} x {} m, expected square ones", *dx, *dy));
    const double cell = size ? *size : *dx;
    if (!(cell > 0) || !(cell <= 1e5))
      refuse(fmt::format("cellsize is {}, expected more than 0 and at most 1e5 m", cell));
    return cell;
  }

  double first(char axis, double cell) const {
    const auto corner = header(std::string(1, axis) + "llcorner"), centre = header(std::string(1, axis) + "llcenter");
    if (!corner && !centre) refuse(fmt::format("its header has neither {0}llcorner nor {0}llcenter", axis));
    if (corner && centre) refuse(fmt::format("its header has both {0}llcorner and {0}llcenter", axis));
    return centre ? *centre : *corner + cell / 2;
  }

  void read_heights(ElevationGrid& grid) {
    const double none = header("nodata_value").value_or(-9999);
    const double as_good_as_none = 5e-6 * std::abs(none);  // half a unit of the last of six digits, or less
    grid.z.resize(static_cast<std::size_t>(grid.columns) * static_cast<std::size_t>(grid.rows));
    std::size_t n = 0;
    for (int row = grid.rows - 1; row >= 0; --row)
      for (int column = 0; column < grid.columns; ++column, ++n) {
        const std::string_view word = words_.next();
        if (word.empty()) refuse(fmt::format("ends after {} of {} x {} heights", n, grid.columns, grid.rows));
        const std::optional<double> z = number(word);
        if (!z)
          refuse_here(fmt::format("got {}, expected the height in column {} of row {} from the north{}", shown(word),
                                  column + 1, grid.rows - row, comma_hint(word)));
        const bool is_hole = std::isnan(*z) || *z == none || std::abs(*z - none) <= as_good_as_none;
        if (!is_hole && !(std::abs(*z) <= highest))
          refuse_here(fmt::format("got {}, expected a height from -1e5 to 1e5 m; holes have NODATA_value, {}",
                                  shown(word), none));
        grid.at(column, row) = is_hole ? hole : *z;
      }
    if (!words_.next().empty()) refuse_here(fmt::format("goes on after its {} x {} heights", grid.columns, grid.rows));
  }

  Words words_;
  const std::string& name_;
  std::map<std::string, double> header_;
};

}  // namespace

ElevationGrid parse_esri_grid(std::string_view text, const std::string& name) {
  const auto refuse = [&](std::string_view why) { throw GridFileError(fmt::format("{} {}", name, why)); };
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  if (text.starts_with("II*") || text.starts_with("MM"))
    refuse("is a TIFF, expected an ESRI ASCII grid: gdal_translate -of AAIGrid makes one");
  if (text.find_first_not_of(" \t\r\n") == std::string_view::npos) refuse("is empty");
  return Parser(text, name).parse();
}

ElevationGrid read_esri_grid(const std::filesystem::path& file) {
  constexpr std::uintmax_t most = 1'000'000'000;
  const std::string name = file.string();
  std::error_code error;
  if (!std::filesystem::exists(file, error)) throw GridFileError("there is no file " + name);
  if (!std::filesystem::is_regular_file(file, error)) throw GridFileError(name + " is no regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error || size > most) throw GridFileError(name + " is longer than the 1 GB that a grid may have");
  std::ifstream stream(file, std::ios::binary);
  std::string text(size, '\0');
  if (!stream || !stream.read(text.data(), static_cast<std::streamsize>(size)))
    throw GridFileError(name + " cannot be read");
  return parse_esri_grid(text, name);
}

std::string esri_grid_text(const ElevationGrid& grid) {
  constexpr int none = -9999;
  std::string text = fmt::format("ncols {}\nnrows {}\nxllcenter {}\nyllcenter {}\ncellsize {}\nNODATA_value {}\n",
                                 grid.columns, grid.rows, grid.x, grid.y, grid.cell, none);
  for (int row = grid.rows - 1; row >= 0; --row)
    for (int column = 0; column < grid.columns; ++column) {
      const double z = grid.at(column, row);
      if (std::isnan(z)) {
        fmt::format_to(std::back_inserter(text), "{}", none);
      } else {
        fmt::format_to(std::back_inserter(text), "{}", z);
      }
      text += column + 1 < grid.columns ? ' ' : '\n';
    }
  return text;
}

}  // namespace spindrift
