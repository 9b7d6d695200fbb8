#include "simulation/map_sections.hpp"

#include <fmt/format.h>

#include <string>
#include <utility>
#include <vector>

#include "io/map_coordinates.hpp"
#include "io/map_line.hpp"
#include "simulation/outline_checks.hpp"
#include "simulation/registry.hpp"
#include "simulation/units.hpp"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

constexpr double most_thickness = 100;  // [m]
constexpr std::string_view of_folder = "terrain.avaframe";

class MapReader {
 public:
  MapReader(Scene& scene, Places& places, SceneReport& report, const fs::path& folder, const AvaframeFolder& found)
      : scene_(scene), places_(places), report_(report), folder_(folder), found_(found) {}

  void run() {
    expand(
        scene_.release, "release", found_.release,
        [this](ReleaseSection& release, const std::string& section, const MapPolygon& polygon, const std::string& who) {
          if (places_.contains(section + ".thickness") || places_.contains(section + ".layers")) return true;
          release.thickness = polygon.thickness.value_or(0);
          return good_thickness(polygon, who, section + ".thickness");
        });
    expand(scene_.obstacle, "obstacle", {}, [](auto&&...) { return true; });
    if (scene_.cover) cover(*scene_.cover);
    path();
  }

 private:
  /// Where the file is named: the key's path and place.
  void name(const std::string& path) { path_ = path, place_ = place_of(places_, path); }
  void add(std::string_view what) { report_.add(place_, path_, what); }

  template <class Section, class Complete>
  void expand(std::vector<Section>& sections, const std::string& kind, const std::vector<fs::path>& of_avaframe,
              Complete complete) {
    std::vector<Section> all;
    std::vector<std::size_t> from;
    std::vector<std::pair<std::size_t, Place>> of_file;  // new sections, and where their file is named
    for (std::size_t i = 0; i < sections.size(); ++i) {
      const std::string section = numbered(kind, i, sections.size());
      std::vector<fs::path> files = of_avaframe;
      name(std::string(of_folder));
      if (files.empty() && !sections[i].file.empty()) {
        files.push_back(folder_ / std::exchange(sections[i].file, {}));
        name(section + ".file");
        if (!fits(section, sections[i].shape)) files.clear();
      }
      const std::size_t before = all.size();
      for (const fs::path& file : files)
        for (const MapPolygon& polygon : polygons_of(file)) {
          Section one = sections[i];
          one.points = polygon.one_ring();
          if (!complete(one, section, polygon, who(file, polygon))) continue;
          of_file.emplace_back(all.size(), place_);
          all.push_back(std::move(one));
          from.push_back(i);
        }
      if (all.size() > before) continue;
      if (!files.empty()) report_.suspect(section + ".points");
      all.push_back(sections[i]);
      from.push_back(i);
    }
    if (all.size() != sections.size()) renumber(kind, sections.size(), from);
    sections = std::move(all);
    for (const auto& [k, place] : of_file) places_[numbered(kind, k, sections.size()) + ".points"] = place;
  }

  /// Whether a section may have its areas from a file.
  bool fits(const std::string& section, const std::string& shape) {
    report_.suspect(section + ".points");
    if (shape != "area") {
      report_.suspect(section + ".shape");
      add(fmt::format("needs {0}.shape = \"area\"; it is \"{1}\" at {2}", section, shape,
                      report_.text_of(place_of(places_, section + ".shape"))));
      return false;
    }
    return alone(section + ".points");
  }

  /// Whether nothing else says the same; tells it.
  bool alone(const std::string& other) {
    const auto there = places_.find(other);
    if (there == places_.end()) return true;
    add(fmt::format("contradicts {} at {}: leave out one", other, report_.text_of(there->second)));
    return false;
  }

  void cover(CoverSection& cover) {
    std::vector<fs::path> files = found_.cover;
    name(std::string(of_folder));
    if (!files.empty()) {
      if (!alone("cover.file") || !alone("cover.areas")) return;
    } else if (!cover.file.empty()) {
      files.push_back(folder_ / std::exchange(cover.file, {}));
      name("cover.file");
      if (!alone("cover.areas")) return;
    } else if (!found_.release.empty() && !places_.contains("cover.areas")) {
      return add("no areas of the cover, a .shp in ENT/ or Inputs/ENT/: say cover.file, or leave out [cover]");
    }
    const bool told = places_.contains("cover.depth");
    bool first = true;
    for (const fs::path& file : files)
      for (const MapPolygon& polygon : polygons_of(file)) {
        cover.areas.push_back(polygon.one_ring());
        if (told || !good_thickness(polygon, who(file, polygon), "cover.depth")) continue;
        if (!first && *polygon.thickness != cover.depth)
          return add(fmt::format("{}: is {} m thick, others are {} m: the cover has one depth, say cover.depth",
                                 who(file, polygon), number_text(*polygon.thickness), number_text(cover.depth)));
        cover.depth = *polygon.thickness;
        first = false;
      }
    if (!files.empty()) places_["cover.areas"] = place_;
  }

  /// The line of path.file, or of an AvaFrame folder where the scene tells none.
  void path() {
    if (scene_.path && !scene_.path->file.empty()) {
      name("path.file");
      const fs::path file = folder_ / std::exchange(scene_.path->file, {});
      if (!alone("path.points") || !read_path(file)) report_.suspect("path.points");
    } else if (!found_.paths.empty() && !places_.contains("path.points")) {
      name(std::string(of_folder));
      if (found_.paths.size() > 1)
        add(fmt::format("has several lines of the path, {} and {}: say path.file", found_.paths[0].string(),
                        found_.paths[1].string()));
      else if (read_path(found_.paths[0]))
        return;
      report_.suspect("path.points");
    }
  }

  bool read_path(const fs::path& file) {
    MapLine line;
    try {
      line = read_map_line(file);
    } catch (const MapFileError& error) {
      return add(error.what()), false;
    }
    if (!in_same_system(file)) return false;
    if (const std::string wrong = off_the_domain(line); !wrong.empty())
      return add(fmt::format("{}: {}", file.string(), wrong)), false;
    if (!scene_.path) scene_.path.emplace();
    scene_.path->points = std::move(line);
    places_["path.points"] = place_;
    return true;
  }

  bool good_thickness(const MapPolygon& polygon, const std::string& who, const std::string& key) {
    if (!polygon.thickness) {
      add(fmt::format("{}: has no thickness, expected metres in its field \"thickness\" or \"d0\", or {} in the scene",
                      who, key));
      return false;
    }
    if (*polygon.thickness > 0 && *polygon.thickness <= most_thickness) return true;
    add(fmt::format("{}: thickness: got {}, expected above 0 and at most {} m", who, number_text(*polygon.thickness),
                    most_thickness));
    return false;
  }

  static std::string who(const fs::path& file, const MapPolygon& polygon) {
    return fmt::format("{}: polygon {}{}", file.string(), polygon.number + 1,
                       polygon.name.empty() ? "" : fmt::format(" (\"{}\")", polygon.name));
  }

  bool in_same_system(const fs::path& file) {
    if (found_.elevation.empty() || same_coordinates(file, found_.elevation)) return true;
    add(fmt::format("{}: is in another system of coordinates than {}: project it to that", file.string(),
                    found_.elevation.string()));
    return false;
  }

  /// Of a file, if all of them lie where they may; else none, and the report says why.
  std::vector<MapPolygon> polygons_of(const fs::path& file) {
    std::vector<MapPolygon> polygons;
    try {
      polygons = read_map_polygons(file);
    } catch (const MapFileError& error) {
      add(error.what());
      return {};
    }
    if (!in_same_system(file)) return {};
    for (const MapPolygon& polygon : polygons) {
      const Outline outline = polygon.one_ring();
      std::string wrong = scene_.elevation ? off_the_model(*scene_.elevation, outline) : "";
      if (wrong.empty()) wrong = off_the_domain(outline);
      if (wrong.empty()) continue;
      add(fmt::format("{}: {}", who(file, polygon), wrong));
      return {};
    }
    return polygons;
  }

  std::string off_the_domain(const Outline& outline) const {
    const DomainSection& domain = scene_.domain;
    if (domain.lower.size() != 3 || domain.upper.size() != 3) return "";
    const Box<2> extent = extent_of(outline);
    for (int k = 0; k < 2; ++k) {
      const double low = domain.lower[static_cast<std::size_t>(k)], high = domain.upper[static_cast<std::size_t>(k)];
      if (extent.lower[k] < low || extent.upper[k] > high)
        return fmt::format("reaches {} along {}, expected it inside the domain, which goes from {} to {}",
                           number_text(extent.lower[k] < low ? extent.lower[k] : extent.upper[k]), k == 0 ? "x" : "y",
                           number_text(low), number_text(high));
    }
    return "";
  }

  /// Gives the places of the sections of a kind, of which there were n, to those that were made from them.
  void renumber(const std::string& kind, std::size_t n, const std::vector<std::size_t>& from) {
    std::vector<Places> of_section(n);
    for (std::size_t i = 0; i < n; ++i) {
      const std::string section = numbered(kind, i, n);
      for (const auto& [path, place] : places_)
        if (path == section || path.starts_with(section + ".")) of_section[i][path.substr(section.size())] = place;
    }
    std::erase_if(places_, [&](const auto& entry) {
      return entry.first == kind || entry.first.starts_with(kind + ".") || entry.first.starts_with(kind + "[");
    });
    for (std::size_t k = 0; k < from.size(); ++k)
      for (const auto& [key, place] : of_section[from[k]]) places_[numbered(kind, k, from.size()) + key] = place;
  }

  Scene& scene_;
  Places& places_;
  SceneReport& report_;
  const fs::path& folder_;
  const AvaframeFolder& found_;
  std::string path_;
  Place place_;
};

}  // namespace

void read_maps(Scene& scene, Places& places, SceneReport& report, const fs::path& folder, const AvaframeFolder& found) {
  MapReader(scene, places, report, folder, found).run();
}

}  // namespace spindrift
