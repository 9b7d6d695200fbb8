#include "simulation/ground_checks.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "io/esri_grid.hpp"
#include "simulation/ground.hpp"
#include "simulation/outline_checks.hpp"
#include "simulation/units.hpp"

namespace spindrift {
namespace {

class GroundChecker {
 public:
  GroundChecker(const Scene& scene, const Places& places, SceneReport& report)
      : scene_(scene), places_(places), report_(report) {}

  void run() {
    const TerrainSection& terrain = *scene_.terrain;
    if (!report_.good({"terrain.shape", "scene.dim"})) return;
    if (terrain.is_field() && scene_.scene.dim == 2)
      return add("terrain.shape", fmt::format("got \"{}\", expected ground of a slice, as \"slope\" or \"polyline\": "
                                              "scene.dim is 2",
                                              terrain.shape));
    if (terrain.shape == "polyline") polyline(terrain.points);
    if (terrain.shape == "grid") grid();
    angle(terrain);
    cliffs(terrain);
  }

 private:
  void angle(const TerrainSection& terrain) {
    const bool may_be_level =
        terrain.shape == "plane" || terrain.shape == "valley" || terrain.shape == "polyline" || terrain.shape == "grid";
    if (report_.good({"terrain.angle"}) && terrain.angle == 0 && !may_be_level)
      add("terrain.angle", fmt::format("got 0, expected more: ground of shape \"{}\" falls", terrain.shape));
  }

  void cliffs(const TerrainSection& terrain) {
    if (terrain.shape != "cliff" && terrain.shape != "cliff_band") return;
    if (report_.good({"terrain.cliff_at", "terrain.cliff_height", "terrain.drop"}) &&
        terrain.cliff_at + terrain.cliff_height >= terrain.drop)
      add("terrain.cliff_height",
          fmt::format("got {}, expected a cliff above the slope's foot: cliff_at + cliff_height "
                      "below the drop of {} m at {}",
                      number_text(terrain.cliff_height), number_text(terrain.drop), text_of("terrain.drop")));
    if (terrain.shape == "cliff_band" && report_.good({"terrain.cliff_angle", "terrain.angle"}) &&
        terrain.cliff_angle <= terrain.angle)
      add("terrain.cliff_angle",
          fmt::format("got {} rad, expected more than the slope's angle of {} rad at {}",
                      number_text(terrain.cliff_angle), number_text(terrain.angle), text_of("terrain.angle")));
  }

  void polyline(const std::vector<std::array<double, 2>>& points) {
    const std::string_view path = places_.contains("terrain.file") ? "terrain.file" : "terrain.points";
    if (!report_.good({path})) return;
    if (points.size() < 2) return add(path, fmt::format("got {} points, expected at least 2 (x, z)", points.size()));
    for (std::size_t i = 1; i < points.size(); ++i) {
      if (points[i][0] < points[i - 1][0])
        return add(path, fmt::format("point {} lies left of the one before it; x may not decrease", i + 1));
      if (points[i] == points[i - 1]) return add(path, fmt::format("point {} is the same as the one before it", i + 1));
    }
    if (points[0][0] == points[1][0] || points[points.size() - 2][0] == points.back()[0])
      add(path, "the first and the last piece may not be vertical");
  }

  /// The elevation model lies under the whole domain. It may have holes there.
  void grid() {
    constexpr std::string_view path = "terrain.file";
    if (!report_.good({path, "domain.lower", "domain.upper"})) return;
    if (scene_.elevation == nullptr)
      return add(path, "missing, expected the path of an elevation model, or terrain.avaframe");
    const ElevationGrid& model = *scene_.elevation;
    const Box<2> domain = domain_in_plan(scene_);
    const Vec<2> half = Vec<2>::Constant(model.cell / 2), corner = Vec<2>(model.x, model.y) - half;
    const Box<2> extent{corner, corner + model.cell * Vec<2>(model.columns, model.rows)};
    bool covered = true;
    for (int k = 0; k < 2; ++k) {
      const auto off = [&](std::string_view bound, double value) {
        covered = false;
        add(bound, fmt::format("reaches {} along {}, expected it over the grid of {} at {}, which has heights from {} "
                               "to {}",
                               number_text(value), k == 0 ? "x" : "y", path, text_of(path),
                               number_text(extent.lower[k]), number_text(extent.upper[k])));
      };
      if (domain.lower[k] < extent.lower[k]) off("domain.lower", domain.lower[k]);
      if (domain.upper[k] > extent.upper[k]) off("domain.upper", domain.upper[k]);
    }
    if (covered) heights(model, part_under(domain, model));
  }

  void heights(const ElevationGrid& model, const GridPart& part) {
    for (int row = part.first[1]; row <= part.last[1]; ++row)
      for (int column = part.first[0]; column <= part.last[0]; ++column)
        if (!std::isnan(model.at(column, row))) return;
    add("terrain.file", "has no heights under the domain, all are holes");
  }

  std::string text_of(std::string_view path) const { return report_.text_of(place_of(places_, path)); }
  void add(std::string_view path, std::string_view what) { report_.add(place_of(places_, path), path, what); }

  const Scene& scene_;
  const Places& places_;
  SceneReport& report_;
};

}  // namespace

void check_ground(const Scene& scene, const Places& places, SceneReport& report) {
  GroundChecker(scene, places, report).run();
}

void check_ground_under(const ReleaseSection& release, const std::string& section, const Scene& scene,
                        const Places& places, SceneReport& report) {
  const std::string path = section + ".shape";
  if (!report.good({path, "terrain", "terrain.shape", "scene.dim"})) return;
  const auto add = [&](std::string_view what) { report.add(place_of(places, path), path, what); };
  if (!scene.terrain)
    return add(fmt::format("\"{}\" needs the section [terrain], which the scene does not have", release.shape));
  const std::string ground = fmt::format("terrain.shape is \"{}\" at {}", scene.terrain->shape,
                                         report.text_of(place_of(places, "terrain.shape")));
  if (release.shape == "slab" && scene.terrain->is_field())
    add(fmt::format("\"slab\" needs ground that is the same all along y, {}; did you mean \"area\"?", ground));
  if (release.shape == "area" && !scene.terrain->is_field())
    add(fmt::format("\"area\" needs one of the 3D grounds \"{}\", {}; did you mean \"slab\"?",
                    fmt::join(field_shapes, "\", \""), ground));
  if (release.shape == "area") check_area(section + ".points", release.points, scene, places, report);
}

void check_area(const std::string& path, const std::vector<std::array<double, 2>>& points, const Scene& scene,
                const Places& places, SceneReport& report) {
  if (!scene.elevation || points.size() < 3 || !report.good({path})) return;
  const std::string wrong = off_the_model(*scene.elevation, points);
  if (!wrong.empty()) report.add(place_of(places, path), path, wrong);
}

void check_area_ground(const std::string& path, const Scene& scene, const Places& places, SceneReport& report) {
  if (!report.good({"terrain", "terrain.shape", "scene.dim"}) || (scene.terrain && scene.terrain->is_field())) return;
  report.add(place_of(places, path), path,
             fmt::format("needs one of the 3D grounds \"{}\" as terrain.shape", fmt::join(field_shapes, "\", \"")));
}

}  // namespace spindrift
