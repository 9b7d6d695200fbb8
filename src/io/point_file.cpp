#include "io/point_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace spindrift {
namespace {

std::vector<std::string_view> words_of(std::string_view line) {
  constexpr std::string_view gaps = " \t\r,;";
  std::vector<std::string_view> words;
  line = line.substr(0, line.find('#'));
  for (;;) {
    line.remove_prefix(std::min(line.find_first_not_of(gaps), line.size()));
    if (line.empty()) return words;
    words.push_back(line.substr(0, line.find_first_of(gaps)));
    line.remove_prefix(words.back().size());
  }
}

std::optional<double> number(std::string_view word) {
  double x = 0;
  const char* end = word.data() + word.size();
  const auto read = std::from_chars(word.data(), end, x);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(x)) return std::nullopt;
  return x;
}

}  // namespace

std::vector<std::array<double, 2>> read_points(const std::filesystem::path& file) {
  constexpr std::uintmax_t most = 16 * 1024 * 1024;
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error))
    throw PointFileError(fmt::format("there is no file {}", file.string()));
  if (std::filesystem::file_size(file, error) > most)
    throw PointFileError(fmt::format("{} is longer than the 16 MB that points may have", file.string()));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw PointFileError(fmt::format("{} cannot be opened for reading", file.string()));

  std::vector<std::array<double, 2>> points;
  std::string line;
  bool first = true;
  for (int n = 1; std::getline(stream, line); ++n) {
    const auto refuse = [&](const std::string& why) {
      throw PointFileError(fmt::format("{}:{}: {}", file.string(), n, why));
    };
    const std::vector<std::string_view> words = words_of(line);
    if (words.empty()) continue;
    const bool heading = std::exchange(first, false) && !number(words[0]);
    if (heading) continue;
    if (words.size() != 2)
      refuse(fmt::format("got {} value{}, expected two numbers: x and z", words.size(), words.size() == 1 ? "" : "s"));
    for (const std::string_view word : words)
      if (!number(word)) refuse(fmt::format("got \"{}\", expected a finite number", word.substr(0, 40)));
    points.push_back({*number(words[0]), *number(words[1])});
    if (const std::size_t k = points.size(); k > 1 && points[k - 1][0] < points[k - 2][0])
      refuse(fmt::format("x = {} lies left of x = {} of the point before; x may not decrease", points[k - 1][0],
                         points[k - 2][0]));
  }
  if (points.empty()) throw PointFileError(fmt::format("{} holds no points", file.string()));
  return points;
}

}  // namespace spindrift
