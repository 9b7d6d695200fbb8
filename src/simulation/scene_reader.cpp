#include "simulation/scene_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <memory>
#include <optional>
#include <utility>

#include "core/error.hpp"
#include "io/elevation_model.hpp"
#include "io/point_file.hpp"
#include "simulation/avaframe.hpp"
#include "simulation/grid_domain.hpp"
#include "simulation/map_sections.hpp"
#include "simulation/registry.hpp"
#include "simulation/scene_checks.hpp"
#include "simulation/scene_file.hpp"
#include "simulation/scene_report.hpp"
#include "simulation/scene_values.hpp"
#include "simulation/spelling.hpp"
#include "simulation/syntax_hint.hpp"

namespace spindrift {
namespace {

constexpr int schema_version = 1;

/// A key that the file sets, with what it sets it to.
struct Entry {
  const Key* key;
  std::size_t index;  ///< of its section, where that repeats
  std::string path;
  const TomlValue* literal;
};

class Reader {
 public:
  Reader(TomlTable document, const std::string& file) : document_(std::move(document)), report_(file) {}

  Scene read(const std::string& default_name, const std::filesystem::path& folder) {
    check_version();
    for (const TomlMember& member : document_)
      if (member.name != "schema_version") visit(member, {member.name, member.name, 0});
    assign_if([](const Key& key) { return key.section() == "scene"; });
    take_defaults();
    assign_if([](const Key& key) { return key.section() != "scene"; });
    AvaframeFolder maps = read_avaframe(folder);
    read_terrain_file(folder, maps.elevation);
    find_domain();
    read_maps(scene_, places_, report_, folder, maps);
    count_layers();
    derive(default_name);
    check_scene(scene_, places_, report_);
    report_.throw_if_bad();
    return scene_;
  }

  Origins origins() const {
    Origins all;
    for (const auto& [path, place] : places_) all[path] = report_.text_of(place);
    return all;
  }

  void apply(const std::string& setting) {
    const std::size_t equals = setting.find('=');
    if (equals == std::string::npos || equals == 0)
      return report_.add({0, 0}, fmt::format("\"{}\"", setting), "expected key=value, as in scene.end_time=5");
    const auto trim = [](std::string_view s) {
      while (!s.empty() && s.front() == ' ') s.remove_prefix(1);
      while (!s.empty() && s.back() == ' ') s.remove_suffix(1);
      return s;
    };
    const std::string_view view = setting;
    const std::string_view path = trim(view.substr(0, equals));
    constexpr std::ptrdiff_t deepest = 2;  // coupling.drag.constant
    if (std::count(path.begin(), path.end(), '.') > deepest) return report_.add({0, 0}, path, "unknown key");
    const auto wrong = set_member(document_, path, trim(view.substr(equals + 1)));
    if (wrong) report_.add({0, 0}, path, *wrong);
  }

 private:
  void check_version() {
    for (const TomlMember& member : document_) {
      if (member.name != "schema_version") continue;
      const auto* version = std::get_if<std::int64_t>(&member.value[0].value);
      if (version == nullptr || *version != schema_version)
        report_.add(member.value[0].place, "schema_version",
                    fmt::format("got {}, expected {}", text_of(member.value[0]), schema_version));
      return;
    }
    report_.add({}, "schema_version", fmt::format("missing, expected schema_version = {} at the top", schema_version));
  }

  /// A name on its way through the document.
  struct Path {
    std::string known;  ///< as the registry has it: "release.shape"
    std::string shown;  ///< as the user reads it: "release[1].shape"
    std::size_t index;  ///< of the section, where that repeats

    Path operator/(const std::string& name) const { return {known + "." + name, shown + "." + name, index}; }
  };

  void visit(const TomlMember& member, const Path& path) {
    const TomlValue& literal = member.value[0];
    if (const Key* key = find_key(path.known)) {
      places_[path.shown] = literal.place;
      entries_.push_back({key, path.index, path.shown, &literal});
    } else if (const Section* section = find_section(path.known)) {
      const auto* list = std::get_if<TomlList>(&literal.value);
      if (!section->repeats || list == nullptr) return enter(*section, literal, member.place, path);
      for (std::size_t i = 0; i < list->size(); ++i)
        enter(*section, (*list)[i], (*list)[i].place, {path.known, numbered(section->path, i, list->size()), i});
    } else {
      unknown(member.place, path, std::holds_alternative<TomlTable>(literal.value));
    }
  }

  void enter(const Section& section, const TomlValue& literal, const Place& place, const Path& path) {
    places_[path.shown] = place;
    section.create(scene_);
    const auto* table = std::get_if<TomlTable>(&literal.value);
    if (table == nullptr)
      return report_.add(literal.place, path.shown,
                         fmt::format("got {}, expected a section [{}]", text_of(literal), section.path));
    for (const TomlMember& inner : *table) visit(inner, path / inner.name);
  }

  /// Suggests, in this order: a key of the same section, the same key of another section, the nearest whole path.
  void unknown(const Place& place, const Path& at, bool is_section) {
    const std::string& path = at.known;
    std::vector<std::string_view> paths, siblings;
    const std::size_t dot = path.rfind('.');
    const std::string section = dot == std::string::npos ? "" : path.substr(0, dot);
    const std::string_view name = std::string_view(path).substr(dot == std::string::npos ? 0 : dot + 1);
    std::optional<std::string_view> elsewhere;
    if (is_section) {
      for (const Section& known : sections()) paths.push_back(known.path);
    } else {
      for (const Key& key : keys()) {
        paths.push_back(key.path);
        if (key.section() == section) siblings.push_back(key.name());
        if (key.name() == name && !elsewhere) elsewhere = key.path;
      }
    }
    std::optional<std::string_view> meant = nearest(name, siblings);
    report_.suspect(meant ? fmt::format("{}.{}", section, *meant) : std::string());
    if (!meant) meant = elsewhere;
    if (!meant && (meant = nearest(path, paths))) report_.suspect(*meant);
    report_.add(place, at.shown, fmt::format("unknown {}{}", is_section ? "section" : "key", did_you_mean(meant)));
  }

  template <class Chosen>
  void assign_if(Chosen chosen) {
    for (const Entry& entry : entries_) {
      if (!chosen(*entry.key)) continue;
      const bool needs_dim = std::holds_alternative<std::vector<double>*>(entry.key->field(scene_, entry.index));
      if (!needs_dim || report_.good({"scene.dim"}))
        assign(scene_, *entry.key, entry.index, *entry.literal, entry.path, report_);
    }
  }

  /// The preset's values for every key of the sections that exist, other than [scene].
  void take_defaults() {
    Scene preset = complete_scene(scene_.scene.preset);
    for (const Key& key : keys()) {
      if (key.section() == "scene") continue;
      for (std::size_t i = 0; i < find_section(key.section())->count(scene_); ++i)
        std::visit([&](auto* to) { *to = *std::get<decltype(to)>(key.field(preset)); }, key.field(scene_, i));
    }
  }

  /// Puts the thickness of slabs that are told by their layers into release.thickness.
  void count_layers() {
    if (!scene_.dense_flow || !report_.good({"dense_flow.support_radius", "dense_flow.support_ratio"})) return;
    for (std::size_t i = 0; i < scene_.release.size(); ++i) {
      const std::string section = numbered("release", i, scene_.release.size());
      const std::string path = section + ".layers", thickness = section + ".thickness";
      const int layers = std::exchange(scene_.release[i].layers, 0);
      if (layers == 0 || !report_.good({path, thickness})) continue;
      if (places_.contains(thickness)) {
        contradict(path, thickness);
      } else {
        scene_.release[i].thickness = layers * scene_.dense_flow->spacing();
        places_[thickness] = place_of(places_, path);
      }
    }
  }

  /// Two keys that say the same thing.
  void contradict(const std::string& path, const std::string& other) {
    report_.add(place_of(places_, path), path,
                fmt::format("contradicts {} at {}: leave out one", other, report_.text_of(place_of(places_, other))));
  }

  /// Finds the files of terrain.avaframe, and makes the release whose areas they tell where the scene has none.
  AvaframeFolder read_avaframe(const std::filesystem::path& folder) {
    const std::string path = "terrain.avaframe";
    if (!scene_.terrain || scene_.terrain->avaframe.empty() || !report_.good({path})) return {};
    const auto give_up = [&] {
      for (const char* section : {"terrain", "release", "domain", "cover"}) report_.suspect(section);
      return AvaframeFolder{};
    };
    std::vector<std::string> others{"terrain.file", "terrain.points", "release.points",
                                    "release.file", "release.at",     "release[1]"};
    if (scene_.terrain->shape != "grid") others.push_back("terrain.shape");
    if (!scene_.release.empty() && scene_.release[0].shape != "area") others.push_back("release.shape");
    for (const std::string& other : others)
      if (places_.contains(other)) return contradict(path, other), give_up();
    AvaframeFolder found;
    try {
      if (scene_.scene.dim != 3) throw AvaframeError("needs scene.dim = 3");
      found = find_avaframe(folder / std::exchange(scene_.terrain->avaframe, {}));
    } catch (const AvaframeError& error) {
      report_.add(place_of(places_, path), path, error.what());
      return give_up();
    }
    scene_.terrain->shape = "grid";
    scene_.terrain->file = found.elevation.string();
    places_["terrain.file"] = place_of(places_, path);
    if (scene_.release.empty()) scene_.release.push_back(complete_scene(scene_.scene.preset).release[0]);
    scene_.release[0].shape = "area";
    return found;
  }

  /// The corners of the domain, which may be left out where an elevation model has them. Its sides are open then.
  void find_domain() {
    if (!report_.good({"domain", "terrain.file", "terrain.avaframe"})) return;
    DomainSection& domain = scene_.domain;
    if (scene_.elevation != nullptr && scene_.scene.dim == 3 && domain.lower.empty() && domain.upper.empty()) {
      surround(domain, *scene_.elevation);
      if (!places_.contains("domain.front")) domain.front = "open";
      if (!places_.contains("domain.back")) domain.back = "open";
      for (const char* corner : {"domain.lower", "domain.upper"}) places_[corner] = place_of(places_, "terrain.file");
    } else if (!places_.contains("domain")) {
      report_.add({}, "domain", "missing, expected a section [domain]");
    }
  }

  /// Puts what stands in terrain.file into terrain.points or the scene's elevation model.
  /// model  out, where not told: its path from here
  void read_terrain_file(const std::filesystem::path& folder, std::filesystem::path& model) {
    constexpr std::string_view path = "terrain.file";
    if (!scene_.terrain || scene_.terrain->file.empty() || !report_.good({path, "terrain.points"})) return;
    const std::string& shape = scene_.terrain->shape;
    if (shape != "polyline" && shape != "grid" && report_.good({"terrain.shape"}))
      return report_.add(place_of(places_, path), path,
                         fmt::format("needs terrain.shape = \"polyline\" or \"grid\"; it is \"{}\" at {}", shape,
                                     report_.text_of(place_of(places_, "terrain.shape"))));
    if (shape == "polyline" && places_.contains("terrain.points"))
      return contradict(std::string(path), "terrain.points");
    const auto refuse = [&](const std::exception& error) { report_.add(place_of(places_, path), path, error.what()); };
    try {
      if (shape == "grid") {
        if (model.empty()) model = folder / scene_.terrain->file;
        scene_.elevation = std::make_shared<const ElevationGrid>(read_elevation_model(model));
      } else {
        scene_.terrain->points = read_points(folder / std::exchange(scene_.terrain->file, {}));
        places_["terrain.points"] = place_of(places_, path);
      }
    } catch (const PointFileError& error) {
      refuse(error);
      report_.suspect("terrain.points");
    } catch (const GridFileError& error) {
      refuse(error);
    }
  }

  /// Defaults that follow from other values.
  void derive(const std::string& default_name) {
    const auto dim = static_cast<std::size_t>(scene_.scene.dim);
    if (!places_.contains("scene.name")) scene_.scene.name = default_name;
    if (scene_.domain.gravity.empty()) {
      scene_.domain.gravity.assign(dim, 0.0);
      scene_.domain.gravity.back() = -9.81;
    }
    const auto zero_unless_said = [dim](std::vector<double>& vector) {
      if (vector.empty()) vector.assign(dim, 0.0);
    };
    for (ReleaseSection& release : scene_.release) zero_unless_said(release.velocity);
    for (std::size_t i = 0; i < scene_.pylon.size(); ++i)
      if (scene_.pylon[i].name.empty()) scene_.pylon[i].name = fmt::format("pylon{}", i + 1);
    if (scene_.suspension) zero_unless_said(scene_.suspension->wind);
    if (scene_.suspension) zero_unless_said(scene_.suspension->lid);
  }

  TomlTable document_;
  SceneReport report_;
  Scene scene_;
  Places places_;
  std::vector<Entry> entries_;
};

}  // namespace

Scene parse_scene(std::string_view text, const std::string& file, const std::vector<std::string>& settings,
                  Origins* origins) {
  std::optional<Reader> reader;
  try {
    reader.emplace(parse_toml(text), file);
  } catch (const SyntaxError& error) {
    throw Error(ExitCode::bad_input, fmt::format("{}:{}:{}: {}{}", file, error.place.line, error.place.column,
                                                 error.why, syntax_hint(text, error.place.line, error.why)));
  }
  for (const std::string& setting : settings) reader->apply(setting);
  const Scene scene = reader->read(scene_name(file), std::filesystem::path(file).parent_path());
  if (origins != nullptr) *origins = reader->origins();
  return scene;
}

Scene read_scene(const std::filesystem::path& file, const std::vector<std::string>& settings, Origins* origins) {
  return parse_scene(scene_text(file), file.string(), settings, origins);
}

}  // namespace spindrift
