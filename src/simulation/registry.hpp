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
using Slot =
    std::variant<bool*, int*, std::uint64_t*, double*, std::string*, std::vector<double>*, std::array<double, 2>*,
                 std::vector<std::array<double, 2>>*, std::vector<std::vector<std::array<double, 2>>>*>;

/// Numbers allowed, in SI.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool above_low = false;   ///< low itself is not allowed
  bool below_high = false;  ///< high itself is not allowed
};

/// That a word of the same section has one of some values.
struct Condition {
  std::string_view name;                 ///< "shape"; empty: no condition
  std::vector<std::string_view> values;  ///< "box", "ball"
};

struct Section {
  std::string_view path;  ///< "coupling.drag"
  std::string_view doc;
  bool repeats;  ///< there may be several: [[release]]
  std::size_t (*count)(const Scene&);
  void (*create)(Scene&);  ///< one more where it repeats; else where it does not exist yet, with what it is part of

  bool exists(const Scene& scene) const { return count(scene) > 0; }
};

struct Key {
  std::string path;       ///< "dense_flow.support_radius"
  std::string_view unit;  ///< SI, "" for plain numbers and for what is no number
  Range range;
  std::vector<std::string_view> words;  ///< the strings allowed; empty: any
  std::string_view doc;
  std::string_view source;  ///< of the paper or of docs/departures
  Condition condition;      ///< with which it means something
  Slot (*slot)(Scene&, std::size_t);
  bool in_plan = false;  ///< a vector seen from above: without its last axis

  /// Precondition: the section exists, and has more than `index` of its kind.
  Slot field(Scene& scene, std::size_t index = 0) const { return slot(scene, index); }

  std::string_view section() const { return std::string_view(path).substr(0, path.rfind('.')); }
  std::string_view name() const { return std::string_view(path).substr(path.rfind('.') + 1); }
};

/// In the order in which a scene is written.
const std::vector<Section>& sections();
const std::vector<Key>& keys();

/// Null where there is none of that name.
const Section* find_section(std::string_view path);
const Key* find_key(std::string_view path);

/// Whether the key means something there: its condition holds, and 2D scenes have no front and back.
bool applies(const Key& key, Scene& scene, std::size_t index);

/// What one of `count` sections of the same kind is called: "release", or "release[1]" of several.
std::string numbered(std::string_view section, std::size_t index, std::size_t count);
/// The same for one of its keys: "release[1].thickness".
std::string numbered(const Key& key, std::size_t index, std::size_t count);

/// A scene with every section, once, at the defaults of `preset`.
Scene complete_scene(std::string_view preset);

}  // namespace spindrift
