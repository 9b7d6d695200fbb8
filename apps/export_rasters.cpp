#include "export_rasters.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "core/error.hpp"
#include "io/commit.hpp"
#include "io/digest.hpp"
#include "io/esri_grid.hpp"
#include "io/geotiff.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/scene_writer.hpp"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

struct MapName {
  std::string_view ours, theirs;
};
/// The first three are AvaFrame's: peak flow thickness, velocity, pressure; the others follow their manner.
constexpr std::array<MapName, 7> map_names{{{"flow_thickness", "pft"},
                                            {"flow_speed", "pfv"},
                                            {"flow_pressure", "ppr"},
                                            {"smoke_density", "psd"},
                                            {"cloud_height", "pch"},
                                            {"deposit", "dep"},
                                            {"erosion", "ero"}}};

/// What stands before the last underscore of a name; its parts have none themselves.
std::string simulation_name(const Scene& scene) {
  std::string release = scene.scene.name;
  std::ranges::replace(release, '_', '-');
  const std::string id = Digest().add(canonical_scene(scene)).hex().substr(0, 10);
  return fmt::format("{}_{}_{}_spindrift", release, id, scene.entrainment ? "ent" : "null");
}

ElevationGrid read_map(const fs::path& file) {
  try {
    return read_esri_grid(file);
  } catch (const GridFileError& error) {
    throw Error(ExitCode::incompatible_file, error.what());
  }
}

}  // namespace

std::size_t export_rasters(const fs::path& run, const fs::path& out, std::string_view format) {
  if (format == "tif" && !writes_geotiff())
    throw Error(ExitCode::bad_input,
                "--format tif: this build writes no GeoTIFF; install libgdal-dev, then configure and build again");
  std::vector<MapName> present;
  for (const MapName& name : map_names)
    if (fs::exists(run / "peaks" / fmt::format("{}.asc", name.ours))) present.push_back(name);
  if (present.empty())
    throw Error(ExitCode::bad_input,
                fmt::format("{}: has no maps, expected peaks/flow_thickness.asc; runs in 3D with a terrain make them, "
                            "unless output.rasters is false",
                            run.string()));
  const std::string simulation = simulation_name(read_scene(run / "scene.toml"));
  make_folder(out);
  for (const MapName& name : present) {
    const ElevationGrid map = read_map(run / "peaks" / fmt::format("{}.asc", name.ours));
    const fs::path file = out / fmt::format("{}_{}.{}", simulation, name.theirs, format);
    if (format == "tif")
      commit(file, geotiff_bytes(map));
    else
      commit(file, esri_grid_text(map));
  }
  return present.size();
}

}  // namespace spindrift
