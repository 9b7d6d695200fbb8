#include <catch2/catch.hpp>
#include <cstdint>

#include "small_scenes.hpp"
#include "workplace.hpp"

using namespace spindrift::testing;

namespace {

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// "640x360", from the head of a PNG file.
std::string size_of(const fs::path& file) {
  const std::string bytes = text_of(file);
  if (!bytes.starts_with("\x89PNG") || bytes.size() < 24) return "no PNG file";
  const auto number = [&](std::size_t at) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = value << 8 | static_cast<unsigned char>(bytes[at + k]);
    return std::to_string(value);
  };
  return number(16) + "x" + number(20);
}

/// A folder with a small avalanche in r/, frames 0 to 2, without ffmpeg on its path.
class DrawnRun : public Workplace {
 public:
  explicit DrawnRun(const std::string& scene) {
    write("a.toml", scene);
    REQUIRE(spindrift("run a.toml -o r --quiet --set output.preview_width=160").code == 0);
  }
  Outcome spindrift(const std::string& words) const { return run(words, "PATH=/nowhere"); }
  std::size_t n_files(const std::string& name) const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder() / name), {}));
  }
};

const std::string deep = avalanche_3d;
const std::string flat = [] {
  std::string text = avalanche;
  return text.replace(text.find("end_time = 0.5"), 14, "end_time = 0.2");
}();

}  // namespace

TEST_CASE("a 3D run leaves pictures, and render draws the same ones from its frames", "[render]") {
  const DrawnRun place(deep);
  REQUIRE(place.n_files("r/preview") == 3);
  CHECK(size_of(place.folder() / "r/preview/000002.png") == "160x90");
  const Outcome all = place.spindrift("render r");
  CHECK(all.code == 0);
  CHECK(all.out == "r/render\n");
  CHECK(all.err == "3 pictures\nno film.mp4: ffmpeg is not installed\n");
  for (const char* name : {"000000.png", "000001.png", "000002.png"})
    CHECK(text_of(place.folder() / "r/render" / name) == text_of(place.folder() / "r/preview" / name));

  const Outcome one = place.spindrift("render r --frame 1 --size 201x101 -o there/deep --threads 1");
  CHECK(one.out == "there/deep\n");
  CHECK(one.err == "1 picture\n");
  CHECK(place.n_files("there/deep") == 1);
  CHECK(size_of(place.folder() / "there/deep/000001.png") == "200x100");
  CHECK(place.spindrift("render r --every 2 -o second").err == "2 pictures\n");
  CHECK(place.n_files("second") == 2);
}

TEST_CASE("camera and light of a picture can be chosen", "[render]") {
  const DrawnRun place(deep);
  const std::string usual = text_of(place.folder() / "r/preview/000002.png");
  for (const std::string words : {"--camera 100,20,15", "--camera=-60,20,15", "--azimuth 0", "--elevation 80",
                                  "--zoom 2", "--close", "--sun 90,10", "--opaque-smoke 1e-4"}) {
    CAPTURE(words);
    REQUIRE(place.spindrift("render r --frame 2 -o other " + words).code == 0);
    CHECK(text_of(place.folder() / "other/000002.png") != usual);
    CHECK(size_of(place.folder() / "other/000002.png") == "160x90");
  }
}

TEST_CASE("render draws 2D runs as their previews are", "[render]") {
  const DrawnRun place(flat);
  CHECK(place.spindrift("render r --every 1").code == 0);
  CHECK(place.n_files("r/render") == 3);
  CHECK(size_of(place.folder() / "r/render/000001.png") == size_of(place.folder() / "r/preview/000001.png"));
  CHECK(place.spindrift("render r --frame 0 --size 400x140 -o small").code == 0);
  CHECK(size_of(place.folder() / "small/000000.png") == "200x140");  // the domain is 20 m x 14 m
  const std::string option =
      GENERATE("--camera 1,2,3", "--azimuth 1", "--elevation 1", "--zoom 2", "--close", "--sun 1,2");
  const Outcome outcome = place.spindrift("render r " + option);
  CHECK(outcome.code == 2);
  CHECK(outcome.err == option.substr(0, option.find(' ')) + ": r is a 2D run, which is drawn from the side\n");
}

TEST_CASE("what cannot be drawn is told with what was expected, and nothing is written", "[render]") {
  const DrawnRun place(deep);
  struct Row {
    std::string words, message;
  };
  const auto row = GENERATE(
      Row{"absent", "absent: there is no such folder, expected a run folder\n"},
      Row{".", ".: not a run folder, it has no run.json\n"},
      Row{"r --frame 3", "r: there is no frame 3, expected one of 0 to 2\n"},
      Row{"r --size 640", "--size: got \"640\", expected width x height in whole pixels from 16 to 16384"},
      Row{"r --size 640x", "--size: got"}, Row{"r --size 640x15", "--size: got"},
      Row{"r --size 16385x100", "--size: got"}, Row{"r --size 100.5x100", "--size: got"},
      Row{"r --size axb", "--size: got"}, Row{"r --size 100x100x100", "--size: got"},
      Row{"r --camera 1,2", "--camera: got \"1,2\", expected azimuth, elevation and distance in degrees and metres"},
      Row{"r --camera 1,2,nan", "--camera: got"}, Row{"r --camera 1,2,3,", "--camera: got"},
      Row{"r --camera 1,91,3", "--camera: got 91, expected -90 to 90 degrees of elevation"},
      Row{"r --camera 1,2,0", "--camera: got 0, expected 0.001 to 1e+09 m of distance"},
      Row{"r --camera 1,2,3 --azimuth 4", "--camera excludes"}, Row{"r --camera 1,2,3 --close", "--camera excludes"},
      Row{"r --sun 100", "--sun: got \"100\", expected"},
      Row{"r --sun 100,-1", "--sun: got -1, expected 0 to 90 degrees of elevation"}, Row{"r --zoom 0", "--zoom: "},
      Row{"r --every 0", "--every: "}, Row{"r --elevation 91", "--elevation: "},
      Row{"r --every 2 --frame 1", "--every excludes"});
  const Outcome outcome = place.spindrift("render " + row.words);
  CAPTURE(row.words, outcome.err);
  CHECK(outcome.code == 2);
  CHECK((outcome.err.find(row.message) == 0 || contains(outcome.err, row.message)));
  CHECK(outcome.out.empty());
  CHECK_FALSE(fs::exists(place.folder() / "r/render"));
}

TEST_CASE("a broken run ends render with code 4 and the name of the file", "[render]") {
  const DrawnRun place(deep);
  const std::string good = text_of(place.folder() / "r/frames/smoke_000001.hdf");
  place.write("r/frames/smoke_000001.hdf", good.substr(0, good.size() / 2));
  const Outcome outcome = place.spindrift("render r");
  CHECK(outcome.code == 4);
  CHECK(contains(outcome.err, "r/frames/smoke_000001.hdf is not a frame that can be read: "));
  CHECK(fs::exists(place.folder() / "r/render/000000.png"));
  CHECK_FALSE(fs::exists(place.folder() / "r/render/000001.png"));

  // A frame of the other layer under its name.
  place.write("r/frames/smoke_000001.hdf", text_of(place.folder() / "r/frames/particles_000001.hdf"));
  const Outcome other = place.spindrift("render r --frame 1");
  CHECK(other.code == 4);
  CHECK(contains(other.err, "r/frames/smoke_000001.hdf: expected smoke"));

  place.write("r/run.json", "[]");
  CHECK(place.spindrift("render r").code == 4);
  fs::remove(place.folder() / "r/scene.toml");
  place.write("r/run.json", "{}");
  const Outcome sceneless = place.spindrift("render r");
  CHECK(sceneless.code != 0);
  CHECK(contains(sceneless.err, "r/scene.toml"));
}

TEST_CASE("a run without frames cannot be drawn, one with a single layer can", "[render]") {
  const Workplace place;
  place.write("a.toml", deep);
  REQUIRE(
      place.run("run a.toml -o r --quiet --no-preview --set output.particles=false --set output.smoke=false").code ==
      0);
  const Outcome none = place.run("render r");
  CHECK(none.code == 2);
  CHECK(none.err == "r: has no frames, expected frames/particles_000000.hdf; its [output] may switch them off\n");
  REQUIRE(place.run("run a.toml -o r --quiet --no-preview --set output.particles=false --until 0.05").code == 0);
  CHECK(place.run("render r --size 160x90").code == 0);
  CHECK(size_of(place.folder() / "r/render/000000.png") == "160x90");
  const Outcome close = place.run("render r --close -o close");
  CHECK(close.code == 2);
  CHECK(close.err == "--close: r: the frames hold no dense flow, expected some to look at\n");
  CHECK_FALSE(fs::exists(place.folder() / "close"));
}
