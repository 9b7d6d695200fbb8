#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>

#include "commands.hpp"
#include "counter.hpp"
#include "export_frame.hpp"
#include "export_rasters.hpp"
#include "frame_choice.hpp"
#include "io/commit.hpp"
#include "io/frame_files.hpp"
#include "io/vdb.hpp"
#include "io/vtk_xml.hpp"
#include "plain_text.hpp"
#include "run_folder.hpp"
#include "simulation/spelling.hpp"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

struct ExportArguments {
  std::string folder, to, output, only, format = "asc";
  FrameChoice frames;
  double smoke_above = 1e-4;
};

const std::vector<std::string_view> layers{"particles", "smoke"};

void require_known(const std::string& what, const std::string& word, const std::vector<std::string_view>& known) {
  if (std::ranges::find(known, word) != known.end()) return;
  throw Error(ExitCode::bad_input, fmt::format("{} \"{}\" is not known, expected one of: {}{}", what, word,
                                               fmt::join(known, ", "), did_you_mean(word, known)));
}

/// The wanted frames of a layer.
std::vector<FrameFile> chosen_frames(const ExportArguments& arguments, const std::string& layer) {
  std::vector<FrameFile> files;
  if (!arguments.only.empty() && arguments.only != layer) return files;
  if (arguments.to == "vdb" && layer != "smoke") return files;
  files = frame_files(arguments.folder, layer);
  std::erase_if(files, [&](const FrameFile& file) { return !arguments.frames.takes(file.number); });
  return files;
}

/// Why there is nothing to export.
Error nothing_chosen(const ExportArguments& arguments) {
  std::uint64_t first = std::numeric_limits<std::uint64_t>::max(), last = 0;
  for (const std::string_view layer : layers) {
    if (!arguments.only.empty() && arguments.only != layer) continue;
    for (const FrameFile& file : frame_files(arguments.folder, std::string(layer))) {
      first = std::min(first, file.number);
      last = std::max(last, file.number);
    }
  }
  const std::string kind = arguments.only.empty() ? "" : " of " + arguments.only;
  if (first > last)
    return {ExitCode::bad_input,
            fmt::format(
                "{}: has no frames{}, expected {}; the run may have no such layer, or its [output] switches frames off",
                arguments.folder, kind, frame_path(arguments.only.empty() ? "particles" : arguments.only, 0).string())};
  return {ExitCode::bad_input, fmt::format("{}: there is no frame {}{}, expected one of {} to {}", arguments.folder,
                                           arguments.frames.frame.value_or(0), kind, first, last)};
}

ExitCode export_maps(const ExportArguments& arguments, const fs::path& out) {
  require_known("--format", arguments.format, {raster_formats.begin(), raster_formats.end()});
  const std::size_t n = export_rasters(arguments.folder, out, arguments.format);
  fmt::print(stderr, "{} maps as {}\n", n, arguments.format);
  fmt::print("{}\n", out.string());
  return ExitCode::done;
}

ExitCode export_run(const ExportArguments& arguments) {
  std::vector<std::string_view> kinds(frame_formats.begin(), frame_formats.end());
  kinds.push_back("raster");
  require_known("--to", arguments.to, kinds);
  if (!arguments.only.empty()) require_known("--only", arguments.only, layers);
  if (arguments.to == "vdb" && !writes_vdb())
    throw Error(ExitCode::bad_input,
                "--to vdb: this build writes no OpenVDB; install libopenvdb-dev, then configure and build again");
  const auto run = read_run_json(arguments.folder);
  const fs::path out = arguments.output.empty() ? fs::path(arguments.folder) / "export" : fs::path(arguments.output);
  if (arguments.to == "raster") return export_maps(arguments, out);
  const auto dim = run.find("dim");
  if (dim == run.end() || (*dim != 2 && *dim != 3))
    throw Error(ExitCode::incompatible_file, arguments.folder + "/run.json: expected \"dim\": 2 or 3");
  const ExportOptions options{arguments.to, dim->get<int>(), arguments.smoke_above};

  std::array<std::vector<FrameFile>, 2> chosen;
  std::size_t n_files = 0;
  for (std::size_t k = 0; k < layers.size(); ++k)
    n_files += (chosen[k] = chosen_frames(arguments, std::string(layers[k]))).size();
  if (n_files == 0) throw nothing_chosen(arguments);

  make_folder(out);
  double bytes_written = 0;
  {
    Counter counter(n_files, "files");
    for (std::size_t k = 0; k < layers.size(); ++k) {
      const std::string layer(layers[k]);
      std::vector<SeriesEntry> series;
      for (const FrameFile& file : chosen[k]) {
        const StoredFrame frame = read_frame_file(file.path);
        if (frame.lattice.has_value() != (layer == "smoke"))
          throw Error(ExitCode::incompatible_file, fmt::format("{}: expected {}", file.path.string(), layer));
        const std::string name = fmt::format("{}_{:06}.{}", layer, file.number, exported_ending(options.format, layer));
        const std::vector<std::byte> bytes = exported(frame, options, file.path);
        commit(out / name, bytes);
        series.push_back({name, frame_number(frame, "time", file.path)});
        bytes_written += static_cast<double>(bytes.size());
        counter.count();
      }
      if (options.format == "vtk" && !series.empty()) commit(out / (layer + ".pvd"), pvd_text(series));
    }
  }
  fmt::print(stderr, "{} frame{} of particles and {} of smoke as {}: {}\n", chosen[0].size(),
             chosen[0].size() == 1 ? "" : "s", chosen[1].size(), options.format, bytes_text(bytes_written));
  fmt::print("{}\n", out.string());
  return ExitCode::done;
}

}  // namespace

void add_export(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand(
      "export", "Write the frames of a run in formats that other programs open; prints the folder's name");
  const auto arguments = std::make_shared<ExportArguments>();
  command->add_option("DIR", arguments->folder, "run folder")->required()->type_name("");
  command
      ->add_option("--to", arguments->to,
                   "csv: tables of numbers, a row a particle or cell\n"
                   "vtk: .vtp, .vti and .pvd, for ParaView before 5.10, VisIt, PyVista, meshio\n"
                   "ply: point clouds, for Blender, Houdini, MeshLab, CloudCompare\n"
                   "vdb: volumes of smoke, for Blender, Houdini and renderers\n"
                   "raster: the maps of a 3D run under AvaFrame's names, for QGIS and AvaFrame")
      ->required()
      ->type_name("csv|vtk|ply|vdb|raster");
  command->add_option("--format", arguments->format, "raster: ESRI ASCII grids or GeoTIFF")
      ->capture_default_str()
      ->type_name("asc|tif");
  command->add_option("-o,--output", arguments->output, "where to (default: export/ in the run folder)")
      ->type_name("DIR");
  arguments->frames.add_to(*command);
  command->add_option("--only", arguments->only, "particles or smoke alone")->type_name("particles|smoke");
  command
      ->add_option("--smoke-above", arguments->smoke_above,
                   "csv, ply, vdb: leave out cells with no more smoke than this [kg/m^3]; -1: none, for the wind")
      ->check(CLI::Number)
      ->capture_default_str()
      ->type_name("DENSITY");
  command->footer(
      "Example:  spindrift export runs/quickstart --to csv --every 10\n"
      "The frames themselves are VTKHDF: ParaView from 5.10 on opens particles.hdf.series and smoke.hdf.series as they"
      "\nare. docs/results.md tells more.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return export_run(*arguments); }; });
}

}  // namespace spindrift
