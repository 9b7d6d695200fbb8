#include "io/csv.hpp"

#include <fmt/format.h>

#include <iterator>

#include "core/error.hpp"

namespace spindrift {

namespace {
constexpr std::size_t buffer_limit = std::size_t{1} << 16;  // [bytes]
}

CsvWriter::CsvWriter(std::filesystem::path path, const std::vector<std::string>& columns)
    : path_(std::move(path)), n_columns_(columns.size()), buffer_(fmt::format("{}\n", fmt::join(columns, ","))) {
  try {
    file_.emplace(path_);
  } catch (const std::system_error& reason) {
    throw write_error(path_, reason, buffer_.size());
  }
  flush();
}

CsvWriter::~CsvWriter() {
  try {
    close();
  } catch (const Error&) {
    // A destructor cannot tell; whoever wants to know calls close().
  }
}

void CsvWriter::row(std::span<const double> values, std::string_view word) {
  SPINDRIFT_CHECK(values.size() + (word.empty() ? 0 : 1) == n_columns_);
  fmt::format_to(std::back_inserter(buffer_), "{}{}{}\n", fmt::join(values, ","), word.empty() ? "" : ",", word);
  if (buffer_.size() >= buffer_limit) flush();
}

void CsvWriter::flush() {
  try {
    if (!file_) throw std::system_error(EBADF, std::generic_category(), "closed");
    file_->write(std::as_bytes(std::span(buffer_)));
  } catch (const std::system_error& reason) {
    file_.reset();  // what it holds now is unknown: a second try could write a row twice
    throw write_error(path_, reason, buffer_.size());
  }
  buffer_.clear();
}

void CsvWriter::close() {
  if (!file_) return;
  flush();
  try {
    file_->close();
  } catch (const std::system_error& reason) {
    throw write_error(path_, reason, 0);
  }
  file_.reset();
}

}  // namespace spindrift
