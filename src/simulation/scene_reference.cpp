#include "simulation/scene_reference.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cctype>

#include "simulation/registry.hpp"
#include "simulation/scene_values.hpp"
#include "simulation/scene_writer.hpp"

namespace spindrift {
namespace {

constexpr std::string_view guide = R"md(# Scene reference

*Written by `spindrift scene --reference`; a test fails where this page and the program differ.*

A scene is a TOML file. It begins with `schema_version = 1`; `[domain]` with its two corners is the only section that
must be there, and an elevation model makes up for it. Every other section switches its part of the physics on, with the defaults below for what it leaves out.

- **Numbers** are SI, or text with a unit: `support_radius = 0.21`, `"21 cm"`, `angle = "38 deg"`, `"2 min"`,
  `"72 km/h"`. A plain angle is in radians.
- **Vectors** have as many numbers as the scene has dimensions: `[x, z]` in 2D, `[x, y, z]` in 3D. z points up. Ground
  profiles and polygons are pairs `(x, z)` in both; in 3D they go on along y. Areas of release are pairs `(x, y)`.
- **2D** is a slice one metre wide: masses are per metre of width.
- **Several of a kind**: `[[release]]`, `[[obstacle]]`, `[[smoke]]` and `[[pylon]]` may stand more than once; a single
  one may also be written `[release]`. `--set release[1].thickness=3` changes the second of them.
- **Terrain from a file**: `shape = "polyline"` with `file = "profile.txt"`, one point `x z` [m] a line, x from left to
  right; blanks, commas or semicolons between, `#` begins a comment, a first line of words counts for nothing. The first
  and the last piece go on beyond the points.
- **3D grounds**: from `plane` to `valley` heights over the x-y plane by a formula, sampled every `cell_size` and
  interpolated smoothly; they lie about the middle of the domain's breadth. A box that lies along its slope, with tilted
  `domain.gravity`, gets a `valley` of `angle = 0`.
- **Elevation models**: `shape = "grid"` with `file = "dem.asc"`, an ESRI ASCII grid with `xllcorner` or `xllcenter`, in
  any letter case; any other ending is read by GDAL, where it is built in, as a GeoTIFF is: north-up, square cells, one
  band, metres. The scene is told and its results are written in the model's coordinates; the run folder keeps a copy as
  `terrain.asc`. Where `[domain]` says no corners it goes around all known heights, with open sides. Holes may lie under
  the domain, but not under a release, cover or obstacle: snow that comes to one leaves.
- **Snow on 3D grounds**: `shape = "area"`, under a polygon seen from above, with its thickness normal to the ground.
  `cover.areas` says where cover lies. A hole in a polygon is told by a walk to its first corner, around it, and back on
  the same line.
- **Maps**: `file = "rel.shp"` stands for the polygons of a shapefile, GeoJSON or whatever else GDAL knows, holes and
  all: an area of release, of cover or of obstacle each. Their field `thickness` or `d0`, a number or text, is the
  release's thickness or the cover's depth, where the scene says none. A polygon off the model, or coordinates of another
  system (where polygons and model both say theirs), are refused.
- **Where the front is**: over a 3D ground its way is straight from the middle of the release, unless the scene has a
  `[path]`: a line seen from above, from `points` or a map, as long as the ground under it; snow beside it counts where
  the line is nearest. A folder of AvaFrame may have one, the shapefile of `LINES/` with `aimec` in its name.
- **Walls and dams**: an `[[obstacle]]` of `shape = "area"` raises the ground by its `height`. Its sides are as steep as
  a cell of the ground allows; one narrower than a cell gets lower, and keeps its volume.
- **Folders of AvaFrame**: `terrain.avaframe = "avaKot"` takes the only `.asc` or `.tif` in the folder or its `Inputs/`
  as elevation model, the shapefiles of `REL/` as releases, and where the scene has `[cover]` those of `ENT/` as its
  areas. One `[release]` may say what they have in common. On the command line: `--set terrain.avaframe=...`; the path
  is seen from the scene file.
- **Presets**: `scene.preset` chooses the defaults: `physical`, measured snow, or `paper`, the constants of the paper.
- **Mistakes** are told with file, line and column, what was expected and what was probably meant, all at once, before
  anything is written. What can be run but hardly makes sense gets a warning with its reason.

`spindrift scene --print SCENE.toml` shows a scene with every value and where it comes from, `spindrift check
SCENE.toml` what it will cost, `spindrift scene --schema` gives editors a JSON Schema.

```toml
schema_version = 1
[scene]
end_time = "8 s"
[domain]
lower = ["0 m", "0 m"]
upper = ["120 m", "48 m"]
[terrain]
start = ["0 m", "42 m"]
angle = "38 deg"
drop = "36 m"
[dense_flow]                  # flowing snow
[[release]]                   # a slab on the slope ...
length = "5 m"
thickness = "2 m"
[[release]]                   # ... and a ball that falls on it
shape = "ball"
center = ["30 m", "35 m"]
radius = "1 m"
[[obstacle]]                  # a wall across the run-out
lower = ["70 m", "0 m"]
upper = ["72 m", "9 m"]
[cover]                       # resting snow, and what sweeps it along
[entrainment]
[suspension]                  # the air, and what raises smoke
[coupling.drag]
[coupling.generation]
[coupling.adhesion]
```
)md";

/// In Markdown code, angles in degrees; empty: what has to be said, or follows from the dimension.
std::string default_text(const Key& key, Scene& scene) {
  const Slot field = key.field(scene);
  return has_value(field) ? fmt::format("`{}`", readable_text(key, field)) : "";
}

struct Grouping {
  const Key& key;

  std::string operator()(const std::vector<double>*) const {
    return key.in_plan ? "a vector without its last axis, each " : "a vector, each ";
  }
  std::string operator()(const std::array<double, 2>*) const { return "a pair, each "; }
  std::string operator()(const std::vector<std::array<double, 2>>*) const { return "a list of pairs, each "; }
  std::string operator()(const std::vector<std::vector<std::array<double, 2>>>*) const {
    return "a list of lists of pairs, each ";
  }
  std::string operator()(const void*) const { return ""; }
};

std::string taken(const Key& key, Scene& scene) {
  return std::visit(Grouping{key}, key.field(scene)) + expectation(key);
}

std::string meaning(const Key& key) {
  std::string text(key.doc);
  if (!key.condition.name.empty())
    text += fmt::format(" *({} {})*", key.condition.name, fmt::join(key.condition.values, ", "));
  if (!key.source.empty()) text += fmt::format(" [{}]", key.source);
  return text;
}

std::string heading(const Section& section) {
  return section.repeats ? fmt::format("\n## `[[{}]]`\n\n", section.path)
                         : fmt::format("\n## `[{}]`\n\n", section.path);
}

}  // namespace

std::string scene_reference() {
  Scene physical = complete_scene("physical"), paper = complete_scene("paper");
  std::string text(guide);
  for (const Section& section : sections()) {
    std::string doc(section.doc);
    doc[0] = static_cast<char>(std::toupper(doc[0]));
    text += heading(section) + doc + ".\n\n| key | meaning | takes | default |\n| --- | --- | --- | --- |\n";
    for (const Key& key : keys()) {
      if (key.section() != section.path) continue;
      std::string standard = default_text(key, physical);
      if (const std::string other = default_text(key, paper); other != standard && key.path != "scene.preset")
        standard += fmt::format("; `paper`: {}", other);
      text += fmt::format("| `{}` | {} | {} | {} |\n", key.name(), meaning(key), taken(key, physical), standard);
    }
  }
  text +=
      "\nIn brackets: the equation or section of the paper, or the entry of [departures.md](departures.md), that "
      "the key belongs to.\n";
  return text;
}

}  // namespace spindrift
