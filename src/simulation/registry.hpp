#pragma once
/// The one table of everything that a scene file may say. Reading, checking, `--set`, writing and the docs follow it.

#include <limits>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "simulation/scene.hpp"

namespace spindrift {

/// Where a key's value lives in a Scene.
using Slot = std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::vector<double>*,
                          std::array<double, 2>*, std::vector<std::array<double, 2>>*>;

/// Numbers allowed, in SI.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;   ///< low itself is not allowed
  bool below_high = false;  ///< high itself is not allowed
};

struct Section {
  std::string_view path;  ///< "coupling.drag"
  std::string_view doc;
  bool (*exists)(const Scene&);
  void (*create)(Scene&);  ///< with its defaults, where it does not exist yet; and what it is part of
};

struct Key {
  std::string path;       ///< "dense_flow.support_radius"
  std::string_view unit;  ///< SI, "" for plain numbers and for what is no number
  Range range;
  std::vector<std::string_view> words;  ///< the strings allowed; empty: any
  std::string_view doc;
  std::string_view source;  ///< of the paper or of docs/departures
  Slot (*field)(Scene&);    ///< precondition: the section exists

  std::string_view section() const { return std::string_view(path).substr(0, path.rfind('.')); }
  std::string_view name() const { return std::string_view(path).substr(path.rfind('.') + 1); }
};

/// In the order in which a scene is written.
const std::vector<Section>& sections();
const std::vector<Key>& keys();

/// Null where there is none of that name.
const Section* find_section(std::string_view path);
const Key* find_key(std::string_view path);

/// A scene with every section, at the defaults of `preset`.
Scene complete_scene(std::string_view preset);

}  // namespace spindrift
