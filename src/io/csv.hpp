#pragma once
/// A growing table of numbers.

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/system_calls.hpp"

namespace spindrift {

/// Writes a table row by row: a header line, then numbers in their shortest form that reads back to the same bits,
/// whatever the locale. Rows are buffered; what was flushed survives a kill. All throw Error(io_failed).
class CsvWriter {
 public:
  /// Creates `path`, or empties it, and writes the header.
  CsvWriter(std::filesystem::path path, const std::vector<std::string>& columns);
  /// Writes what is buffered if it can; call close() to learn of failures.
  ~CsvWriter();

  /// word: of the last column, where that is not a number; without commas. Pre: one value a column.
  void row(std::span<const double> values, std::string_view word = {});
  void flush();
  void close();

 private:
  std::filesystem::path path_;
  std::size_t n_columns_;
  std::string buffer_;
  std::optional<OutputFile> file_;
};

}  // namespace spindrift
