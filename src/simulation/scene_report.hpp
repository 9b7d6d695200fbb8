#pragma once
/// The errors of a scene file, all of them at once.

#include <initializer_list>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "simulation/toml_document.hpp"

namespace spindrift {

class SceneReport {
 public:
  /// file: as the user wrote it, for the messages.
  explicit SceneReport(std::string file) : file_(std::move(file)) {}

  /// `file:line:column: path: what`
  void add(const Place& place, std::string_view path, std::string_view what);

  /// Something else in the file was probably meant to be `path`: no use in saying that it is missing.
  void suspect(std::string_view path) { bad_paths_.emplace(path); }

  /// Whether nothing is wrong with any of `paths` or the sections around them, as far as is known.
  bool good(std::initializer_list<std::string_view> paths) const;

  /// "file:line:column" or "--set".
  std::string text_of(const Place& place) const;

  /// Throws Error(bad_input) with one line an error, at most 20, in the order of the file, the command line's last.
  void throw_if_bad() const;

 private:
  struct Line {
    Place place;
    std::string text;
  };
  std::string file_;
  std::vector<Line> lines_;
  std::set<std::string, std::less<>> bad_paths_;
};

/// A value as the user wrote it, for `got X`: numbers and words as they are, long texts cut.
std::string text_of(const TomlValue& literal);

}  // namespace spindrift
