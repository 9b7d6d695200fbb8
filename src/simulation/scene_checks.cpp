#include "simulation/scene_checks.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "simulation/ground_checks.hpp"
#include "simulation/registry.hpp"
#include "simulation/scene_vectors.hpp"
#include "simulation/units.hpp"

namespace spindrift {
namespace {

constexpr std::string_view axis_names[2][3] = {{"x", "z", ""}, {"x", "y", "z"}};

class Checker {
 public:
  Checker(const Scene& scene, const Places& places, SceneReport& report)
      : scene_(scene), places_(places), report_(report) {}

  void run() {
    names();
    sections();
    corners("domain", scene_.domain.lower, scene_.domain.upper);
    if (scene_.terrain) check_ground(scene_, places_, report_);
    for (std::size_t i = 0; i < scene_.obstacle.size(); ++i) {
      const std::string section = numbered("obstacle", i, scene_.obstacle.size());
      if (scene_.obstacle[i].shape == "box")
        corners(section, scene_.obstacle[i].lower, scene_.obstacle[i].upper);
      else
        area(section + ".shape", section + ".points", scene_.obstacle[i].points);
    }
    if (scene_.cover)
      for (const auto& outline : scene_.cover->areas) area("cover.areas", "cover.areas", outline);
    for (std::size_t i = 0; i < scene_.release.size(); ++i)
      release(numbered("release", i, scene_.release.size()), scene_.release[i]);
    for (std::size_t i = 0; i < scene_.smoke.size(); ++i)
      shape(numbered("smoke", i, scene_.smoke.size()), scene_.smoke[i]);
    if (scene_.path) path(scene_.path->points);
    pylons();
    if (scene_.suspension) lid(*scene_.suspension);
    if (scene_.suspension && scene_.suspension->tiles) tiles(*scene_.suspension);
    if (scene_.cover && scene_.cover->to >= 0)
      ordered("cover.from", scene_.cover->from, "cover.to", scene_.cover->to, true);
    if (scene_.entrainment)
      ordered("entrainment.threshold_surface", scene_.entrainment->threshold_surface, "entrainment.threshold_base",
              scene_.entrainment->threshold_base, false);
    sizes();
  }

 private:
  void names() {
    name("scene.name", scene_.scene.name);
    if (scene_.scene.dim == 2 && report_.good({"scene.dim"}))
      for (const char* side : {"domain.front", "domain.back"})
        if (places_.contains(side)) add(side, "a 2D scene has no such side; scene.dim is 2");
  }

  void name(std::string_view path, const std::string& name) {
    const auto allowed = [](char c) {
      return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '.' || c == '_' ||
             c == '-';
    };
    if (name.empty() || name.size() > 64 || name == "." || name == ".." ||
        !std::all_of(name.begin(), name.end(), allowed))
      add(path, fmt::format("got {}, expected 1 to 64 letters, digits, '.', '_' or '-'", text_of({name, {}})));
  }

  /// A line seen from above on 3D ground.
  void path(const std::vector<std::array<double, 2>>& points) {
    const std::string key = "path.points";
    if (!report_.good({"path", key, "scene.dim"})) return;
    check_area_ground("path", scene_, places_, report_);
    if (points.empty()) return add(key, "missing, expected at least 2 points (x, y)");
    if (points.size() == 1) return add(key, "got 1 point, expected at least 2 (x, y)");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto [x, y] = points[i];
      inside_domain(key, {x, y}, {x, y}, {0, 1});
      if (i > 0 && points[i] == points[i - 1])
        add(key, fmt::format("got ({}, {}) twice in a row", number_text(x), number_text(y)));
    }
  }

  /// Each has a name of its own and stands in the domain.
  void pylons() {
    for (std::size_t i = 0; i < scene_.pylon.size(); ++i) {
      const PylonSection& pylon = scene_.pylon[i];
      const std::string section = numbered("pylon", i, scene_.pylon.size()), position = section + ".position";
      name(section + ".name", pylon.name);
      for (std::size_t j = 0; j < i; ++j)
        if (scene_.pylon[j].name == pylon.name)
          add(section + ".name", fmt::format("got {}, as pylon[{}] is called", text_of({pylon.name, {}}), j));
      if (!report_.good({position, "scene.dim"})) continue;
      if (pylon.position.empty()) add(position, dim() == 2 ? "missing, expected [x]" : "missing, expected [x, y]");
      std::vector<std::size_t> axes(pylon.position.size());
      std::iota(axes.begin(), axes.end(), std::size_t{0});
      inside_domain(position, pylon.position, pylon.position, axes);
    }
  }

  void sections() {
    need(!scene_.release.empty(), "release", scene_.dense_flow.has_value(), "dense_flow");
    need(!scene_.smoke.empty(), "smoke", scene_.suspension.has_value(), "suspension");
    need(scene_.cover.has_value(), "cover", scene_.terrain.has_value(), "terrain");
    need(scene_.cover.has_value(), "cover", scene_.dense_flow.has_value(), "dense_flow");
    need(scene_.coupling.has_value(), "coupling", scene_.dense_flow.has_value(), "dense_flow");
    need(scene_.coupling.has_value(), "coupling", scene_.suspension.has_value(), "suspension");
    need(scene_.entrainment.has_value(), "entrainment", scene_.cover.has_value(), "cover");
    need(scene_.entrainment.has_value(), "entrainment", scene_.dense_flow.has_value(), "dense_flow");
  }

  void need(bool present, std::string_view path, bool other_present, std::string_view other) {
    if (present && !other_present && report_.good({other}))
      add(path, fmt::format("needs the section [{}], which the scene does not have", other));
  }

  /// Whether both corners are there and in order; says so if not.
  bool corners(std::string_view section, const std::vector<double>& lower, const std::vector<double>& upper) {
    const std::string low = fmt::format("{}.lower", section), high = fmt::format("{}.upper", section);
    if (!report_.good({low, high, "scene.dim"})) return false;
    if (lower.empty()) add(low, fmt::format("missing, expected a list of {} lengths", scene_.scene.dim));
    if (upper.empty()) add(high, fmt::format("missing, expected a list of {} lengths", scene_.scene.dim));
    if (lower.empty() || upper.empty()) return false;
    for (std::size_t k = 0; k < lower.size(); ++k)
      if (!(lower[k] < upper[k]))
        add(high, fmt::format("got {} along {}, expected more than {} of {} at {}", number_text(upper[k]), axis(k),
                              number_text(lower[k]), low, report_.text_of(place_of(places_, low))));
    return report_.good({low, high});
  }

  void release(const std::string& section, const ReleaseSection& release) {
    if (release.shape == "slab" || release.shape == "area")
      check_ground_under(release, section, scene_, places_, report_);
    if (release.shape != "slab") shape(section, release);
  }

  /// A box, a ball, a polygon or an area.
  template <class Shaped>
  void shape(const std::string& section, const Shaped& shaped) {
    const std::string low = section + ".lower", high = section + ".upper", center = section + ".center";
    const std::string points = section + ".points";
    if (!report_.good({section + ".shape", "scene.dim"})) return;
    std::vector<std::size_t> axes(dim());
    std::iota(axes.begin(), axes.end(), std::size_t{0});
    if (shaped.shape == "box") {
      if (!corners(section, shaped.lower, shaped.upper)) return;
      inside_domain(low, shaped.lower, shaped.lower, axes);
      inside_domain(high, shaped.upper, shaped.upper, axes);
    } else if (shaped.shape == "polygon" || shaped.shape == "area") {
      const bool from_above = shaped.shape == "area";
      if (report_.good({points}) && shaped.points.size() < 3)
        add(points,
            fmt::format("got {} points, expected at least 3 (x, {})", shaped.points.size(), from_above ? "y" : "z"));
      for (const auto& [x, z] : shaped.points) inside_domain(points, {x, z}, {x, z}, {0, from_above ? 1 : dim() - 1});
    } else if (shaped.center.empty()) {
      if (report_.good({center})) add(center, fmt::format("missing, expected a list of {} lengths", dim()));
    } else {
      std::vector<double> least = shaped.center, most = shaped.center;
      for (double& x : least) x -= shaped.radius;
      for (double& x : most) x += shaped.radius;
      if (report_.good({section + ".radius"})) inside_domain(center, least, most, axes);
    }
  }

  /// An outline seen from above on 3D ground, for which the key `cause` asks.
  void area(const std::string& cause, const std::string& points, const std::vector<std::array<double, 2>>& outline) {
    if (!report_.good({cause, points, "scene.dim"})) return;
    check_area_ground(cause, scene_, places_, report_);
    if (outline.size() < 3)
      return add(points, fmt::format("got {} points, expected at least 3 (x, y)", outline.size()));
    for (const auto& [x, y] : outline) inside_domain(points, {x, y}, {x, y}, {0, 1});
    check_area(points, outline, scene_, places_, report_);
  }

  /// The extent of something lies in the domain, whose axis axes[k] is its k-th; says so if not.
  void inside_domain(const std::string& path, const std::vector<double>& least, const std::vector<double>& most,
                     const std::vector<std::size_t>& axes) {
    if (!report_.good({path, "domain.lower", "domain.upper", "scene.dim"})) return;
    for (std::size_t k = 0; k < axes.size(); ++k) {
      const std::size_t a = axes[k];
      if (least[k] < scene_.domain.lower[a]) outside(path, least[k], "domain.lower", a);
      if (most[k] > scene_.domain.upper[a]) outside(path, most[k], "domain.upper", a);
    }
  }

  void outside(std::string_view path, double value, std::string_view bound, std::size_t k) {
    add(path, fmt::format("reaches {} along {}, expected it inside the domain, whose {} stands at {}",
                          number_text(value), axis(k), bound, report_.text_of(place_of(places_, bound))));
  }

  /// Tiles need air that is at rest where nothing happens.
  void tiles(const SuspensionSection& suspension) {
    const auto contradicts = [&](std::string_view path, bool moves) {
      if (moves && report_.good({path}))
        add("suspension.tiles", fmt::format("contradicts {} at {}: that moves the air everywhere", path,
                                            report_.text_of(place_of(places_, path))));
    };
    const auto any = [](const std::vector<double>& v) {
      return std::ranges::any_of(v, [](double x) { return x != 0; });
    };
    contradicts("suspension.wind", any(suspension.wind));
    contradicts("suspension.initial_flow", suspension.initial_flow != "wind");
    contradicts("suspension.lid", any(suspension.lid));
  }

  void lid(const SuspensionSection& suspension) {
    if (!report_.good({"suspension.lid", "suspension.wall", "domain.top"})) return;
    const std::vector<double>& lid = suspension.lid;
    if (is_zero(lid)) return;
    if (lid.back() != 0)
      add("suspension.lid",
          fmt::format("got {} along z, expected 0: a lid moves along itself", number_text(lid.back())));
    if (scene_.domain.top != "closed")
      add("suspension.lid", fmt::format("contradicts domain.top = \"{}\" at {}: a lid closes the top",
                                        scene_.domain.top, report_.text_of(place_of(places_, "domain.top"))));
  }

  void ordered(std::string_view low, double low_value, std::string_view high, double high_value, bool strictly) {
    if (!report_.good({low, high}) || high_value > low_value || (!strictly && high_value == low_value)) return;
    add(high,
        fmt::format("got {}, expected {} {} of {} at {}", number_text(high_value), strictly ? "more than" : "at least",
                    number_text(low_value), low, report_.text_of(place_of(places_, low))));
  }

  /// The domain holds at least one cell and one particle along each axis.
  void sizes() {
    if (!report_.good({"scene.dim", "domain.lower", "domain.upper"})) return;
    double shortest = scene_.domain.upper[0] - scene_.domain.lower[0];
    for (std::size_t k = 1; k < scene_.domain.lower.size(); ++k)
      shortest = std::min(shortest, scene_.domain.upper[k] - scene_.domain.lower[k]);
    const auto fits = [&](std::string_view path, double size) {
      if (report_.good({path}) && size > shortest)
        add(path, fmt::format("got {}, expected at most the domain's shortest side, {} m, at {}", number_text(size),
                              number_text(shortest), report_.text_of(place_of(places_, "domain.upper"))));
    };
    if (scene_.suspension) fits("suspension.cell_size", scene_.suspension->cell_size);
    if (scene_.dense_flow) fits("dense_flow.support_radius", scene_.dense_flow->support_radius);
  }

  std::size_t dim() const { return static_cast<std::size_t>(scene_.scene.dim); }
  std::string_view axis(std::size_t k) const { return axis_names[scene_.scene.dim - 2][k]; }
  void add(std::string_view path, std::string_view what) { report_.add(place_of(places_, path), path, what); }

  const Scene& scene_;
  const Places& places_;
  SceneReport& report_;
};

}  // namespace

Place place_of(const Places& places, std::string_view path) {
  for (;;) {
    const auto found = places.find(path);
    if (found != places.end()) return found->second;
    const std::size_t dot = path.rfind('.');
    if (dot == std::string_view::npos) return {};
    path = path.substr(0, dot);
  }
}

void check_scene(const Scene& scene, const Places& places, SceneReport& report) {
  Checker(scene, places, report).run();
}

}  // namespace spindrift
