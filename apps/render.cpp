#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numbers>
#include <optional>

#include "commands.hpp"
#include "core/parallel.hpp"
#include "counter.hpp"
#include "frame_choice.hpp"
#include "io/commit.hpp"
#include "io/film.hpp"
#include "io/frame_files.hpp"
#include "plain_text.hpp"
#include "run_folder.hpp"
#include "simulation/local_origin.hpp"
#include "simulation/preview.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/scenery.hpp"
#include "simulation/setup.hpp"

namespace spindrift {
namespace {

namespace fs = std::filesystem;

struct RenderArguments {
  std::string folder, output, camera, sun, size;
  std::optional<double> azimuth, elevation, zoom, opaque_smoke;
  bool close = false;
  FrameChoice frames;
  int threads = 0;
};

/// The files of a frame; the path of a layer that it does not have is empty.
struct FramePaths {
  fs::path particles, smoke;
};

/// `n` finite numbers with `separator` between them.
std::vector<double> numbers_in(const std::string& option, const std::string& text, char separator, std::size_t n,
                               const std::string& expected) {
  std::vector<double> numbers;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at <= end) {
    double number = 0;
    const auto [stop, error] = std::from_chars(at, end, number);
    if (error != std::errc{} || !std::isfinite(number) || (stop != end && *stop != separator)) break;
    numbers.push_back(number);
    at = stop + 1;
  }
  if (numbers.size() != n || at != end + 1)
    throw Error(ExitCode::bad_input, fmt::format("{}: got \"{}\", expected {}", option, text, expected));
  return numbers;
}

void require_within(const std::string& option, double value, double least, double most, const std::string& unit) {
  if (!(value >= least && value <= most))
    throw Error(ExitCode::bad_input,
                fmt::format("{}: got {:g}, expected {:g} to {:g}{}", option, value, least, most, unit));
}

/// Width and height [px], even.
std::optional<std::array<int, 2>> size_of(const RenderArguments& arguments) {
  if (arguments.size.empty()) return {};
  const std::string expected = "width x height in whole pixels from 16 to 16384, as 1920x1080";
  const std::vector<double> sides = numbers_in("--size", arguments.size, 'x', 2, expected);
  for (const double side : sides)
    if (!(side >= 16 && side <= 16384 && side == std::floor(side)))
      throw Error(ExitCode::bad_input, fmt::format("--size: got \"{}\", expected {}", arguments.size, expected));
  const auto even = [](double side) { return 2 * static_cast<int>(side / 2); };
  return std::array{even(sides[0]), even(sides[1])};
}

View view_of(const RenderArguments& arguments, const Scene& scene) {
  constexpr double degrees = std::numbers::pi / 180;
  View view = preview_view(scene);
  if (const auto size = size_of(arguments)) view.width = (*size)[0], view.height = (*size)[1];
  if (arguments.azimuth) view.azimuth = *arguments.azimuth * degrees;
  if (arguments.elevation) view.elevation = *arguments.elevation * degrees;
  if (arguments.zoom) view.zoom = *arguments.zoom;
  if (!arguments.camera.empty()) {
    const auto camera = numbers_in("--camera", arguments.camera, ',', 3,
                                   "azimuth, elevation and distance in degrees and metres, as 150,25,80");
    require_within("--camera", camera[1], -90, 90, " degrees of elevation");
    require_within("--camera", camera[2], 1e-3, 1e9, " m of distance");
    view.azimuth = camera[0] * degrees;
    view.elevation = camera[1] * degrees;
    view.distance = camera[2];
  }
  if (!arguments.sun.empty()) {
    const auto sun = numbers_in("--sun", arguments.sun, ',', 2, "azimuth and elevation in degrees, as 220,35");
    require_within("--sun", sun[1], 0, 90, " degrees of elevation");
    view.sun_azimuth = sun[0] * degrees;
    view.sun_elevation = sun[1] * degrees;
  }
  return view;
}

/// The wanted frames by number, of either layer.
std::map<std::uint64_t, FramePaths> chosen_frames(const RenderArguments& arguments) {
  std::map<std::uint64_t, FramePaths> all, chosen;
  for (const FrameFile& file : frame_files(arguments.folder, "particles")) all[file.number].particles = file.path;
  for (const FrameFile& file : frame_files(arguments.folder, "smoke")) all[file.number].smoke = file.path;
  if (all.empty())
    throw Error(ExitCode::bad_input, fmt::format("{}: has no frames, expected {}; its [output] may switch them off",
                                                 arguments.folder, frame_path("particles", 0).string()));
  for (const auto& [number, paths] : all)
    if (arguments.frames.takes(number)) chosen.emplace(number, paths);
  if (chosen.empty())
    throw Error(ExitCode::bad_input,
                fmt::format("{}: there is no frame {}, expected one of {} to {}", arguments.folder,
                            arguments.frames.frame.value_or(0), all.begin()->first, all.rbegin()->first));
  return chosen;
}

/// What makes a picture of a frame, for 2D or 3D runs.
using Draw = std::function<std::vector<std::byte>(const PictureFrame&)>;

Draw draw_flat(const RenderArguments& arguments, const Scene& scene) {
  const std::pair<const char*, bool> useless[] = {{"--camera", !arguments.camera.empty()},
                                                  {"--azimuth", arguments.azimuth.has_value()},
                                                  {"--elevation", arguments.elevation.has_value()},
                                                  {"--zoom", arguments.zoom.has_value()},
                                                  {"--close", arguments.close},
                                                  {"--sun", !arguments.sun.empty()}};
  for (const auto& [option, given] : useless)
    if (given)
      throw Error(ExitCode::bad_input,
                  fmt::format("{}: {} is a 2D run, which is drawn from the side", option, arguments.folder));
  const auto size = size_of(arguments);
  return [walls = make_walls<2>(scene), scene, size](const PictureFrame& stored) {
    PreviewFrame frame = preview_frame(scene, walls, stored);
    // As large as fits, of the domain's shape.
    const Vec<2> domain = frame.world.size();
    if (size)
      frame.width = std::max(2, std::min((*size)[0], static_cast<int>((*size)[1] * domain[0] / domain[1]) / 2 * 2));
    return frame.png();
  };
}

/// Where the dense flow of the chosen frames is, as seen from above, in the solver's coordinates.
Box<2> part_with_snow(const RenderArguments& arguments, const std::map<std::uint64_t, FramePaths>& frames,
                      const Scene& scene) {
  constexpr double nothing = std::numeric_limits<double>::infinity();
  Box<2> part{Vec<2>::Constant(nothing), Vec<2>::Constant(-nothing)};
  for (const auto& [number, paths] : frames) {
    if (paths.particles.empty()) continue;
    const StoredFrame stored = read_frame_file(paths.particles);
    const StoredFile file{stored, paths.particles};
    const PictureFrame frame = picture_frame(&file, nullptr, scene.origin);
    for (std::size_t i = 0; i < frame.layer.size(); ++i) {
      if (frame.layer[i] != 0) continue;
      const Vec<2> x(static_cast<double>(frame.positions[3 * i]), static_cast<double>(frame.positions[3 * i + 1]));
      part = {part.lower.cwiseMin(x), part.upper.cwiseMax(x)};
    }
  }
  if (!(part.lower[0] <= part.upper[0]))
    throw Error(ExitCode::bad_input,
                fmt::format("--close: {}: the frames hold no dense flow, expected some to look at", arguments.folder));
  return part;
}

Draw draw_deep(const RenderArguments& arguments, const Scene& scene,
               const std::map<std::uint64_t, FramePaths>& frames) {
  View view = view_of(arguments, scene);
  if (arguments.close) view.part = part_with_snow(arguments, frames, scene);
  const auto scenery = std::make_shared<Scenery>(scene, view);
  return [scenery](const PictureFrame& stored) { return scenery->png(stored); };
}

std::vector<std::byte> picture_of(const FramePaths& paths, const Scene& scene, const Draw& draw) {
  std::optional<StoredFrame> particles, smoke;
  std::optional<StoredFile> particle_file, smoke_file;
  if (!paths.particles.empty()) {
    particles = read_frame_file(paths.particles);
    particle_file.emplace(StoredFile{*particles, paths.particles});
  }
  if (!paths.smoke.empty()) {
    smoke = read_frame_file(paths.smoke);
    smoke_file.emplace(StoredFile{*smoke, paths.smoke});
  }
  return draw(
      picture_frame(particle_file ? &*particle_file : nullptr, smoke_file ? &*smoke_file : nullptr, scene.origin));
}

ExitCode render(const RenderArguments& arguments) {
  const auto run = read_run_json(arguments.folder);
  const auto frames = chosen_frames(arguments);
  Scene scene = around_local_origin(read_scene(fs::path(arguments.folder) / "scene.toml"));
  if (arguments.opaque_smoke) scene.output.opaque_smoke = *arguments.opaque_smoke;
  const ThreadLimit threads(arguments.threads);
  const Draw draw = scene.scene.dim == 3 ? draw_deep(arguments, scene, frames) : draw_flat(arguments, scene);

  const fs::path out = arguments.output.empty() ? fs::path(arguments.folder) / "render" : fs::path(arguments.output);
  make_folder(out);
  {
    Counter counter(frames.size(), "pictures");
    for (const auto& [number, paths] : frames) {
      commit(out / fmt::format("{:06}.png", number), picture_of(paths, scene, draw));
      counter.count();
    }
  }
  fmt::print(stderr, "{} picture{}\n", frames.size(), frames.size() == 1 ? "" : "s");
  const bool all =
      arguments.frames.takes_all() && frames.begin()->first == 0 && frames.rbegin()->first == frames.size() - 1;
  if (all && frames.size() > 1) {
    Film film;
    film.folder = out;
    film.pictures = "%06d.png";
    film.file = "film.mp4";
    film.frames_per_second = scene.output.frames_per_second;
    film.threads = arguments.threads;
    if (const auto why_not = make_film(film)) fmt::print(stderr, "{}\n", *why_not);
  }
  fmt::print("{}\n", out.string());
  return ExitCode::done;
}

}  // namespace

void add_render(CLI::App& app, Command& chosen) {
  CLI::App* command =
      app.add_subcommand("render",
                         "Draw the frames of a run anew, with another camera, light or size; prints the "
                         "folder's name");
  const auto arguments = std::make_shared<RenderArguments>();
  command->add_option("DIR", arguments->folder, "run folder")->required()->type_name("");
  command->add_option("-o,--output", arguments->output, "where to (default: render/ in the run folder)")
      ->type_name("DIR");
  CLI::Option* camera =
      command
          ->add_option("--camera", arguments->camera,
                       "where the camera stands as seen from the ground's middle: degrees from north (y) over east "
                       "(x),\ndegrees above the level, metres")
          ->type_name("AZIMUTH,ELEVATION,DISTANCE");
  command->add_option("--azimuth", arguments->azimuth, "of the camera alone [deg]; the rest so that all is seen")
      ->check(CLI::Range(-360.0, 360.0))
      ->type_name("DEGREES")
      ->excludes(camera);
  command->add_option("--elevation", arguments->elevation, "of the camera alone [deg]")
      ->check(CLI::Range(-90.0, 90.0))
      ->type_name("DEGREES")
      ->excludes(camera);
  command->add_option("--zoom", arguments->zoom, "2: from half the distance, onto the ground's middle")
      ->check(CLI::Range(1e-3, 1e3))
      ->type_name("FACTOR")
      ->excludes(camera);
  command
      ->add_flag(
          "--close", arguments->close,
          "from so near that the flowing snow of the chosen frames fills the picture, in place of all the ground")
      ->excludes(camera);
  command->add_option("--sun", arguments->sun, "where the sun stands, in degrees (default: left of the camera)")
      ->type_name("AZIMUTH,ELEVATION");
  command
      ->add_option("--size", arguments->size,
                   "of the pictures, in pixels (default: 16 to 9, output.preview_width of the scene wide);\n"
                   "those of 2D runs have the domain's shape and fit in it")
      ->type_name("WxH");
  command->add_option("--opaque-smoke", arguments->opaque_smoke, "in place of the scene's output.opaque_smoke [kg/m^3]")
      ->check(CLI::Range(1e-9, 1e4))
      ->type_name("DENSITY");
  arguments->frames.add_to(*command);
  command->add_option("--threads", arguments->threads, "threads to use, 0: all")
      ->check(CLI::Range(0, 4096))
      ->type_name("N");
  command->footer(
      "Example:  spindrift render runs/slope --azimuth 120 --elevation 15 --sun 200,25 --size 1920x1080\n"
      "Where all frames are drawn and ffmpeg is installed, film.mp4 stands beside the pictures.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return render(*arguments); }; });
}

}  // namespace spindrift
