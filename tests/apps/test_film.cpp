#include <catch2/catch.hpp>

#include "small_scenes.hpp"
#include "workplace.hpp"

using namespace spindrift::testing;

namespace {

/// A folder with a run to make and, in bin/, an ffmpeg of our own.
class FilmSet : public Workplace {
 public:
  explicit FilmSet(const std::string& script) {
    write("a.toml", avalanche);
    fs::create_directory(folder() / "bin");
    if (script.empty()) return;
    write("bin/ffmpeg", "#!/bin/bash\n" + script);
    fs::permissions(folder() / "bin/ffmpeg", fs::perms::owner_all);
  }
  Outcome film(const std::string& more = "") const {
    return run("run a.toml -o r --until 0.25 --frames-per-second 20 " + more,
               "PATH='" + (folder() / "bin").string() + "'");
  }
  bool has(const char* name) const { return fs::exists(folder() / "r" / name); }
};

}  // namespace

TEST_CASE("a run with pictures ends with a film of them", "[film]") {
  // Leaves its words, one a line, and writes what it was asked for; its talk stays off the terminal.
  const FilmSet set(
      "echo talk; echo more talk >&2; printf '%s\\n' \"$PWD\" \"$@\" >../words\n[[ ! -t 0 ]] && ! read -r || exit 9\n"
      "echo film >\"${@: -1}\"\n");
  const Outcome outcome = set.film();
  CHECK(outcome.code == 0);
  CHECK(outcome.out == "r\n");
  CHECK(outcome.err.find("talk") == std::string::npos);
  CHECK(outcome.err.find("mp4") == std::string::npos);
  CHECK(text_of(set.folder() / "r/preview.mp4") == "film\n");
  CHECK_FALSE(set.has(".preview.mp4.tmp"));
  const std::string words = text_of(set.folder() / "words");
  CHECK(words.starts_with(fs::canonical(set.folder() / "r").string() + "\n"));
  for (const std::string line :
       {"-framerate\n20\n", "-i\npreview/%06d.png\n", "-c:v\nlibx264\n", "-pix_fmt\nyuv420p\n"})
    CHECK(words.find("\n" + line) != std::string::npos);
}

TEST_CASE("no pictures, no film", "[film]") {
  const FilmSet set("echo film >\"${@: -1}\"\n");
  CHECK(set.film("--no-preview").code == 0);
  CHECK_FALSE(set.has("preview.mp4"));
}

TEST_CASE("where there is no ffmpeg one line says so, and nothing in quiet", "[film]") {
  const FilmSet set("");
  const Outcome outcome = set.film();
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("\nno preview.mp4: ffmpeg is not installed\n") != std::string::npos);
  CHECK_FALSE(set.has("preview.mp4"));
  CHECK(set.film("--quiet").err.empty());
  set.write("bin/ffmpeg", "not executable");
  CHECK(set.film().err.find("ffmpeg is not installed") != std::string::npos);
}

TEST_CASE("a failing ffmpeg is a warning, never a failure of the run", "[film]") {
  struct Row {
    std::string script, why;
  };
  const auto row = GENERATE(
      Row{"echo >.preview.mp4.tmp; printf 'one\\n\\033[31mUnknown encoder\\n\\n' >&2; exit 1", "[31mUnknown encoder"},
      Row{"exit 3", "ended with code 3"}, Row{"kill -9 $$", "ended by signal 9"},
      Row{"exit 0", "rename: No such file or directory"});
  const FilmSet set(row.script);
  const Outcome outcome = set.film();
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("\nwarning: no r/preview.mp4, ffmpeg failed: " + row.why + "\n") != std::string::npos);
  CHECK_FALSE(set.has("preview.mp4"));
  CHECK_FALSE(set.has(".preview.mp4.tmp"));
  CHECK(set.run("info r --json").out.find("\"status\": \"done\"") != std::string::npos);
}

TEST_CASE("the real ffmpeg makes a film that players take", "[film]") {
  const Workplace place;
  if (place.shell("ffmpeg -version && ffprobe -version").code != 0) {
    WARN("skipped: no ffmpeg and ffprobe");
    return;
  }
  place.write("a.toml", avalanche);  // pictures 201 px wide: an odd number, which yuv420p cannot have
  const Outcome outcome = place.run("run a.toml -o 'a %06d film'");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.find("mp4") == std::string::npos);
  const std::string told = place
                               .shell(
                                   "ffprobe -v error -count_frames -show_entries "
                                   "stream=codec_name,pix_fmt,width,r_frame_rate,nb_read_frames "
                                   "-of default=noprint_wrappers=1 'a %06d film/preview.mp4'")
                               .out;
  for (const char* line :
       {"codec_name=h264\n", "pix_fmt=yuv420p\n", "width=202\n", "r_frame_rate=10/1\n", "nb_read_frames=6\n"})
    CHECK(told.find(line) != std::string::npos);
}
