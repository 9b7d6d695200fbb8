#include "io/film.hpp"

#include <fmt/format.h>

#include <system_error>
#include <vector>

#include "io/program.hpp"
#include "io/system_calls.hpp"

namespace spindrift {

namespace fs = std::filesystem;

std::optional<std::string> make_film(const Film& film) {
  const auto ffmpeg = program_on_path("ffmpeg");
  if (!ffmpeg) return fmt::format("no {}: ffmpeg is not installed", film.file);
  const std::string temporary = "." + film.file + ".tmp";
  std::vector<std::string> words{"-nostdin", "-hide_banner", "-loglevel", "error", "-y"};
  const auto add = [&](std::initializer_list<std::string> more) { words.insert(words.end(), more); };
  add({"-framerate", fmt::format("{}", film.frames_per_second), "-start_number", "0", "-i", film.pictures});
  add({"-vf", "pad=ceil(iw/2)*2:ceil(ih/2)*2", "-c:v", "libx264", "-pix_fmt", "yuv420p", "-movflags", "+faststart"});
  if (film.threads > 0) add({"-threads", fmt::format("{}", film.threads)});
  add({"-f", "mp4", temporary});

  std::optional<std::string> why = run_program(*ffmpeg, words, film.folder);
  if (!why) {
    try {
      rename_file(film.folder / temporary, film.folder / film.file);
      return {};
    } catch (const std::system_error& failure) {
      why = failure.what();
    }
  }
  std::error_code ignored;
  fs::remove(film.folder / temporary, ignored);
  return fmt::format("warning: no {}, ffmpeg failed: {}", (film.folder / film.file).string(), *why);
}

}  // namespace spindrift
