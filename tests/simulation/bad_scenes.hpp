#pragma once
/// Scenes with mistakes, and what the reader must say about each, word by word.

#include <string>
#include <vector>

namespace spindrift {

inline const std::string head = "schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [100, 50]\n";  // lines 1 to 4
inline const std::string snow = head + "[terrain]\n[release]\n[dense_flow]\n";                        // lines 1 to 7

struct BadScene {
  std::string text;  ///< of the file
  std::string message;
};

inline std::vector<BadScene> bad_scenes() {
  return {
      BadScene{"schema_version = 2\n[domain]\nlower = [0, 0]\nupper = [1, 1]\n[suspension]\ncell_size = 0.1\n",
               "a.toml:1:18: schema_version: got 2, expected 1"},
      BadScene{"[domain]\nlower = [0, 0]\nupper = [10, 10]\n",
               "a.toml:1:1: schema_version: missing, expected schema_version = 1 at the top"},
      BadScene{"schema_version = \"1\"\n[domain]\nlower = [0, 0]\nupper = [10, 10]\n",
               "a.toml:1:18: schema_version: got \"1\", expected 1"},
      BadScene{"schema_version = 1\n", "a.toml:1:1: domain: missing, expected a section [domain]"},
      BadScene{"schema_version = 1\n[domian]\nlower = [0, 0]\nupper = [10, 10]\n",
               "a.toml:2:2: domian: unknown section; did you mean \"domain\"?"},
      BadScene{"schema_version = 1\n[domain]\nlower = [0, 0]\n",
               "a.toml:2:2: domain.upper: missing, expected a list of 2 lengths"},
      BadScene{"schema_version = 1\n[domain]\nlower = [0, 0]\nuper = [10, 10]\n",
               "a.toml:4:1: domain.uper: unknown key; did you mean \"upper\"?"},
      BadScene{"schema_version = 1\n[domain]\nlower = [0, 20]\nupper = [10, 10]\n",
               "a.toml:4:9: domain.upper: got 10 along z, expected more than 20 of domain.lower at a.toml:3:9"},
      BadScene{"schema_version = 1\n[domain]\nlower = [0, 0, 0]\nupper = [10, 10]\n",
               "a.toml:3:9: domain.lower: got a list of 3, expected a list of 2, each a length from -1e+07 to 1e+07 m"},
      BadScene{"schema_version = 1\n[scene]\ndim = 4\n[domain]\nlower = [0, 0, 0]\nupper = [10, 10, 10]\n",
               "a.toml:3:7: scene.dim: got 4, expected a whole number from 2 to 3"},
      BadScene{"schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [10, inf]\n",
               "a.toml:4:14: domain.upper: got inf, expected a length from -1e+07 to 1e+07 m"},
      BadScene{"schema_version = 1\n[domain]\nlower = [0, 0]\nupper = [10, \"10 s\"]\n",
               "a.toml:4:14: domain.upper: got \"10 s\", a time, expected a length from -1e+07 to 1e+07 m"},
      BadScene{head + "front = \"open\"\n", "a.toml:5:9: domain.front: a 2D scene has no such side; scene.dim is 2"},
      BadScene{head + "left = \"opne\"\n",
               "a.toml:5:8: domain.left: got \"opne\", expected \"open\" or \"closed\"; did you mean \"open\"?"},
      BadScene{head + "gravity = -9.81\n",
               "a.toml:5:11: domain.gravity: got -9.81, expected a list of 2, each an acceleration from -1000 to 1000 "
               "m/s^2"},
      BadScene{head + "[scene]\nname = \"../escape\"\n",
               "a.toml:6:8: scene.name: got \"../escape\", expected 1 to 64 letters, digits, '.', '_' or '-'"},
      BadScene{head + "[scene]\nend_time = 0\n",
               "a.toml:6:12: scene.end_time: got 0, expected a time above 0 and at most 1e+06 s"},
      BadScene{head + "[scene]\nend_time = \"10 m\"\n",
               "a.toml:6:12: scene.end_time: got \"10 m\", a length, expected a time above 0 and at most 1e+06 s"},
      BadScene{head + "[scene]\nseed = 1.5\n", "a.toml:6:8: scene.seed: got 1.5, expected a whole number from 0"},
      BadScene{
          head + "[scene]\nseed = 99999999999999999999\n",
          "a.toml:6:28: Error while parsing decimal integer: '99999999999999999999' is not representable in 64 bits"},
      BadScene{head + "[scene]\npreset = \"real\"\n",
               "a.toml:6:10: scene.preset: got \"real\", expected \"physical\" or \"paper\""},
      BadScene{head + "support_radius = 0.2\n",
               "a.toml:5:1: domain.support_radius: unknown key; did you mean \"dense_flow.support_radius\"?"},
      BadScene{head + "[release]\n",
               "a.toml:5:2: release: needs the section [dense_flow], which the scene does not have"},
      BadScene{head + "[dense_flow]\n[release]\n",
               "a.toml:6:2: release.shape: \"slab\" needs the section [terrain], which the scene does not have"},
      BadScene{head + "[dense_flow]\n[cover]\n[entrainment]\n",
               "a.toml:6:2: cover: needs the section [terrain], which the scene does not have"},
      BadScene{head + "[coupling.drag]\n",
               "a.toml:5:2: coupling: needs the section [dense_flow], which the scene does not have\n"
               "a.toml:5:2: coupling: needs the section [suspension], which the scene does not have"},
      BadScene{head + "[densflow]\n[release]\nshape = \"box\"\nlower = [1, 1]\nupper = [2, 2]\n",
               "a.toml:5:2: densflow: unknown section; did you mean \"dense_flow\"?"},
      BadScene{head + "[dense_flow]\n[release]\nshape = \"box\"\nlower = [1, 1]\n",
               "a.toml:6:2: release.upper: missing, expected a list of 2 lengths"},
      BadScene{head + "[dense_flow]\n[release]\nshape = \"box\"\nlower = [-1, 1]\nupper = [0.5, 60]\n",
               "a.toml:8:9: release.lower: reaches -1 along x, expected it inside the domain, whose domain.lower "
               "stands at a.toml:3:9\n"
               "a.toml:9:9: release.upper: reaches 60 along z, expected it inside the domain, whose domain.upper "
               "stands at a.toml:4:9"},
      BadScene{head + "[dense_flow]\n[release]\nshape = \"box\"\nlower = [1, 1]\nupper = [1, 2]\n",
               "a.toml:9:9: release.upper: got 1 along x, expected more than 1 of release.lower at a.toml:8:9"},
      BadScene{snow + "suport_radius = 0.2\n",
               "a.toml:8:1: dense_flow.suport_radius: unknown key; did you mean \"support_radius\"?"},
      BadScene{snow + "support_radius = -0.2\n",
               "a.toml:8:18: dense_flow.support_radius: got -0.2, expected a length above 0 and at most 100 m"},
      BadScene{
          snow + "support_radius = \"0.2 s\"\n",
          "a.toml:8:18: dense_flow.support_radius: got \"0.2 s\", a time, expected a length above 0 and at most 100 m"},
      BadScene{snow + "support_radius = \"0.2\"\n",
               "a.toml:8:18: dense_flow.support_radius: got \"0.2\", a plain number, expected a length above 0 and at "
               "most 100 m"},
      BadScene{snow + "support_radius = \"0.2 metres\"\n",
               "a.toml:8:18: dense_flow.support_radius: got \"0.2 metres\", expected a length above 0 and at most 100 "
               "m; the unit \"metres\" is unknown"},
      BadScene{snow + "support_radius = nan\n",
               "a.toml:8:18: dense_flow.support_radius: got nan, expected a length above 0 and at most 100 m"},
      BadScene{snow + "support_radius = 1e308\n",
               "a.toml:8:18: dense_flow.support_radius: got 1e+308, expected a length above 0 and at most 100 m"},
      BadScene{snow + "support_radius = 60\n",
               "a.toml:8:18: dense_flow.support_radius: got 60, expected at most the domain's shortest side, 50 m, at "
               "a.toml:4:9"},
      BadScene{snow + "support_radius = [0.2]\n",
               "a.toml:8:18: dense_flow.support_radius: got a list of 1, expected a length above 0 and at most 100 m"},
      BadScene{snow + "support_radius = true\n",
               "a.toml:8:18: dense_flow.support_radius: got true, expected a length above 0 and at most 100 m"},
      BadScene{
          snow + "solver = \"dfsp\"\n",
          "a.toml:8:10: dense_flow.solver: got \"dfsp\", expected \"dfsph\" or \"wcsph\"; did you mean \"dfsph\"?"},
      BadScene{snow + "max_iterations = 1.5\n",
               "a.toml:8:18: dense_flow.max_iterations: got 1.5, expected a whole number from 1 to 1e+06"},
      BadScene{snow + "depth = 1\n", "a.toml:8:1: dense_flow.depth: unknown key; did you mean \"cover.depth\"?"},
      BadScene{snow + "[terain]\nangle = 1\n", "a.toml:8:2: terain: unknown section; did you mean \"terrain\"?"},
      BadScene{snow + "[cover]\nfrom = 10\nto = 5\n",
               "a.toml:10:6: cover.to: got 5, expected more than 10 of cover.from at a.toml:9:8"},
      BadScene{snow + "[cover]\nto = 5\n[entrainment]\nthreshold_surface = \"2 1/s\"\n",
               "a.toml:10:2: entrainment.threshold_base: got 1e-04, expected at least 2 of "
               "entrainment.threshold_surface at a.toml:11:21"},
      BadScene{snow + "[output]\npreview = \"yes\"\n",
               "a.toml:9:11: output.preview: got \"yes\", expected true or false"},
      BadScene{snow + "[output]\npreview_width = 1979-05-27\n",
               "a.toml:9:17: output.preview_width: got a date, expected a whole number from 16 to 16384"},
      BadScene{snow + "[suspension]\ncell_size = 51\nconfinement = 0.2\n",
               "a.toml:9:13: suspension.cell_size: got 51, expected at most the domain's shortest side, 50 m, at "
               "a.toml:4:9\n"
               "a.toml:10:15: suspension.confinement: got 0.2, expected a section [suspension.confinement]"},
      BadScene{snow + "[[suspension]]\n", "a.toml:8:1: suspension: got a list of 1, expected a section [suspension]"},
      BadScene{snow + "[coupling.drga]\nconstant = 1\n",
               "a.toml:8:2: coupling: needs the section [suspension], which the scene does not have\n"
               "a.toml:8:11: coupling.drga: unknown section; did you mean \"coupling.drag\"?"},
      BadScene{snow + "density = 1\ndensity = 2\n",
               "a.toml:9:11: Error while parsing key-value pair: cannot redefine existing integer 'density'"},
      BadScene{snow + "density = 1 2\n",
               "a.toml:8:13: Error while parsing key-value pair: expected a comment or whitespace, saw '2'"},
      BadScene{
          head + "[terrain]\nangle = 38\n",
          "a.toml:6:9: terrain.angle: got 38, expected an angle from 0 and below 90 deg; did you mean \"38 deg\"?"},
      BadScene{head + "[terrain]\nshape = \"polyline\"\n",
               "a.toml:5:2: terrain.points: got 0 points, expected at least 2 (x, z)"},
      BadScene{
          head + "[terrain]\nshape = \"polyline\"\npoints = [[0, 1], [2, 3, 4]]\n",
          "a.toml:7:19: terrain.points: got a list of 3, expected a list of 2, each a length from -1e+07 to 1e+07 m"},
      BadScene{head + "[terrain]\nshape = \"polyline\"\npoints = [[0, 1], [5, 0], [4, 0]]\n",
               "a.toml:7:10: terrain.points: point 3 lies left of the one before it; x may not decrease"},
      BadScene{head + "[terrain]\nshape = \"polyline\"\npoints = [[0, 1], [5, 0], [5, -1]]\n",
               "a.toml:7:10: terrain.points: the first and the last piece may not be vertical"},
      BadScene{head + "[terrain]\nshape = \"polyline\"\npoints = [[0, 1], [5, 0], [5, 0], [6, 0]]\n",
               "a.toml:7:10: terrain.points: point 3 is the same as the one before it"},
      BadScene{head + "[terrain]\nshape = \"cliff\"\ncliff_at = 30\n",
               "a.toml:5:2: terrain.cliff_height: got 20, expected a cliff above the slope's foot: cliff_at + "
               "cliff_height below the drop of 50 m at a.toml:5:2"},
      BadScene{
          head + "[dense_flow]\nsolver = dfsph\n",
          "a.toml:6:10: Error while parsing value: could not determine value type; words stand in quotes: solver = "
          "\"dfsph\""},
      BadScene{head + "[terrain]\nangle = 38 deg\n",
               "a.toml:6:12: Error while parsing key-value pair: expected a comment or whitespace, saw 'd'; a number "
               "with its unit stands in quotes: angle = \"38 deg\""},
      BadScene{head + "[dense_flow]\nfriction mu = 0.2\n",
               "a.toml:6:10: Error while parsing key-value pair: expected '=', saw 'm'; names have no blanks: "
               "friction_mu"},
      BadScene{head + "[scene]\nend_time = 1,5\n",
               "a.toml:6:13: Error while parsing key-value pair: expected a comment or whitespace, saw ','; decimals "
               "have a point, and lists stand in [ ]"},
      BadScene{head + "[scene]\nname = \"B\xE4r\"\n",
               "a.toml:6:9: Encountered invalid utf-8 sequence; save the file as plain text in UTF-8"},
      BadScene{std::string("\xFF\xFEs\0c\0", 6),
               "a.toml:1:1: Encountered invalid utf-8 sequence; save the file as plain text in UTF-8"},
      BadScene{head + "[dense_flow]\nsupport_radius =\n",
               "a.toml:6:17: Error while parsing key-value pair: expected value, saw '\\n'; a value is missing behind "
               "support_radius ="},
      BadScene{head + "[dense_flow]\n[[release]]\nshape = \"box\"\nlower = [1, 1]\nupper = [2, 2]\n[[release]]\n"
                      "shape = \"ball\"\nradius = \"1 kg\"\ncenter = [5, 5]\n",
               "a.toml:12:10: release[1].radius: got \"1 kg\", a mass, expected a length above 0 and at most 1e+05 m"},
      BadScene{head + "[dense_flow]\n[[release]]\nshape = \"ball\"\n",
               "a.toml:6:1: release.center: missing, expected a list of 2 lengths"},
      BadScene{head + "[dense_flow]\n[release]\nshape = \"ball\"\ncenter = [1, 5]\nradius = 3\n",
               "a.toml:8:10: release.center: reaches -2 along x, expected it inside the domain, whose domain.lower "
               "stands at a.toml:3:9"},
      BadScene{head + "[dense_flow]\n[release]\nshape = \"polygon\"\npoints = [[1, 1], [2, 2]]\n",
               "a.toml:8:10: release.points: got 2 points, expected at least 3 (x, z)"},
      BadScene{
          head + "[dense_flow]\n[release]\nshape = \"cube\"\n",
          "a.toml:7:9: release.shape: got \"cube\", expected \"slab\", \"area\", \"box\", \"ball\" or \"polygon\""},
      BadScene{snow + "[[release]]\n",
               "a.toml:8:1: Error while parsing table header: cannot redefine existing table 'release' "
               "as array-of-tables"},
      BadScene{head + "release = [1, 2]\n", "a.toml:5:1: domain.release: unknown key"},
      BadScene{head + "[terrain]\n[dense_flow]\n[release]\nthickness = 2\nlayers = 3\n",
               "a.toml:9:10: release.layers: contradicts release.thickness at a.toml:8:13: leave out one"},
      BadScene{head + "[terrain]\nshape = \"polyline\"\nfile = \"no_such_profile.txt\"\n",
               "a.toml:7:8: terrain.file: there is no file no_such_profile.txt"},
      BadScene{head + "[terrain]\nshape = \"polyline\"\nfile = \"p.txt\"\npoints = [[0, 1], [2, 1]]\n",
               "a.toml:7:8: terrain.file: contradicts terrain.points at a.toml:8:10: leave out one"},
      BadScene{
          head + "[terrain]\nfile = \"p.txt\"\n",
          "a.toml:6:8: terrain.file: needs terrain.shape = \"polyline\" or \"grid\"; it is \"slope\" at a.toml:5:2"},
      BadScene{head + "[obstacle]\nlower = [0, 0]\n",
               "a.toml:5:2: obstacle.upper: missing, expected a list of 2 lengths"},
      BadScene{head + "[smoke]\nlower = [0, 0]\nupper = [1, 1]\n",
               "a.toml:5:2: smoke: needs the section [suspension], which the scene does not have"},
      BadScene{head + "[suspension]\n[smoke]\nshape = \"polygon\"\npoints = [[0, 0], [1, 1]]\n",
               "a.toml:8:10: smoke.points: got 2 points, expected at least 3 (x, z)"},
      BadScene{
          head + "[suspension]\n[smoke]\nshape = \"polygon\"\npoints = [[0, 0], [1, 1], [1, 60]]\n",
          "a.toml:8:10: smoke.points: reaches 60 along z, expected it inside the domain, whose domain.upper stands "
          "at a.toml:4:9"},
      BadScene{head + "[suspension]\nwall = \"no_slip\"\nlid = [1, 0]\n",
               "a.toml:7:7: suspension.lid: contradicts domain.top = \"open\" at a.toml:2:2: a lid closes the top"},
      BadScene{snow + "density = -1\nviscosity = -1\n[cover]\nto = 1\nfrom = 2\ndepth = 0\n",
               "a.toml:8:11: dense_flow.density: got -1, expected a density above 0 and at most 1e+05 kg/m^3\n"
               "a.toml:9:13: dense_flow.viscosity: got -1, expected a viscosity from 0 to 1e+06 Pa s\n"
               "a.toml:11:6: cover.to: got 1, expected more than 2 of cover.from at a.toml:12:8\n"
               "a.toml:13:9: cover.depth: got 0, expected a length above 0 and at most 1000 m"}};
}

}  // namespace spindrift
