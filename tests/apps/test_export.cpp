#include <catch2/catch.hpp>

#include "small_scenes.hpp"
#include "workplace.hpp"

using namespace spindrift::testing;

namespace {

const std::string tools = SPINDRIFT_SOURCE_DIR "/tools/";

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

/// A folder with the box run to its end in r/, frames 0 to 2.
class BoxRun : public Workplace {
 public:
  BoxRun() {
    write("box.toml", box_scene);
    REQUIRE(run("run box.toml -o r --quiet --frames-per-second 100").code == 0);
  }
  std::size_t n_files(const std::string& name) const {
    return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder() / name), {}));
  }
};

}  // namespace

TEST_CASE("export writes all frames, every Nth or one, and prints where", "[export]") {
  const BoxRun box;
  const Outcome all = box.run("export r --to csv");
  CHECK(all.code == 0);
  CHECK(all.out == "r/export\n");
  CHECK(contains(all.err, "3 frames of particles and 0 of smoke as csv: "));
  CHECK(box.n_files("r/export") == 3);
  const std::string table = text_of(box.folder() / "r/export/particles_000002.csv");
  CHECK(
      table.starts_with("x [m],y [m],z [m],id,density [kg/m^3],entrained_at [s],layer,mass [kg/m],overlap,"
                        "pressure [Pa],velocity_x [m/s],velocity_y [m/s],velocity_z [m/s]\n"));

  CHECK(box.run("export r --to vtk --every 2 -o there/deep").out == "there/deep\n");
  CHECK(box.n_files("there/deep") == 3);  // two frames and particles.pvd
  CHECK(contains(text_of(box.folder() / "there/deep/particles.pvd"), "file=\"particles_000002.vtp\""));
  CHECK(box.run("export r --to ply --frame 1 -o one").code == 0);
  CHECK(box.n_files("one") == 1);
  CHECK(box.run("export r --to ply --frame 1 --only particles -o one").code == 0);
}

TEST_CASE("what cannot be exported is told with what was expected, and nothing is written", "[export]") {
  const BoxRun box;
  struct Row {
    std::string words, message;
  };
  const auto row = GENERATE(
      Row{"absent --to csv", "absent: there is no such folder, expected a run folder\n"},
      Row{". --to csv", ".: not a run folder, it has no run.json\n"},
      Row{"r --to vtu", "--to \"vtu\" is not known, expected one of: csv, vtk, ply, vdb, raster"},
      Row{"r --to csv --frame 3", "r: there is no frame 3, expected one of 0 to 2\n"},
      Row{"r --to csv --only smok", "--only \"smok\" is not known, expected one of: particles, smoke; did you mean"},
      Row{"r --to csv --only smoke", "r: has no frames of smoke, expected frames/smoke_000000.hdf; "},
      Row{"r --to csv --every 0", "--every: "}, Row{"r --to csv --frame -1", "--frame: "},
      Row{"r --to csv --smoke-above much", "--smoke-above: "},
      Row{"r --to csv --every 2 --frame 1", "--every excludes"});
  const Outcome outcome = box.run("export " + row.words);
  CHECK(outcome.code == 2);
  CHECK(outcome.err.find(row.message) == 0);
  CHECK(outcome.out.empty());
  CHECK_FALSE(fs::exists(box.folder() / "r/export"));
}

TEST_CASE("a broken run ends export with code 4 and the name of the file", "[export]") {
  const BoxRun box;
  const fs::path frame = box.folder() / "r/frames/particles_000001.hdf";
  const std::string good = text_of(frame);
  const auto broken = GENERATE_COPY(as<std::string>{}, "", "no frame", good.substr(0, good.size() / 2));
  box.write("r/frames/particles_000001.hdf", broken);
  const Outcome outcome = box.run("export r --to csv");
  CHECK(outcome.code == 4);
  CHECK(contains(outcome.err, "r/frames/particles_000001.hdf is not a frame that can be read: "));
  CHECK(fs::exists(box.folder() / "r/export/particles_000000.csv"));
  CHECK_FALSE(fs::exists(box.folder() / "r/export/particles_000001.csv"));

  const auto run_json = GENERATE(as<std::string>{}, "{", "[]", "{}", "{\"dim\": 4}", "{\"dim\": \"2\"}");
  box.write("r/run.json", run_json);
  CHECK(box.run("export r --to csv").code == 4);
}

TEST_CASE("Every frame and export of a run reads back the same by h5py, VTK, csv and our reader", "[export][slow]") {
  const std::string python = python_with("vtk, h5py, numpy");
  if (python.empty()) {
    WARN("skipped: no python3 with vtk, h5py and numpy (packages-extra.txt)");
    return;
  }
  const auto [name, scene] = GENERATE(std::pair{"flat", &avalanche}, std::pair{"deep", &avalanche_3d});
  CAPTURE(name);
  const Workplace place;
  place.write("a.toml", *scene);
  REQUIRE(place.run("run a.toml -o r --quiet --no-preview").code == 0);
  const std::string above = " --smoke-above 0.01";
  for (const std::string format : {"csv", "vtk", "ply"})
    REQUIRE(place.run("export r -o " + format + " --to " + format + (format == "vtk" ? "" : above)).code == 0);
  const Outcome read =
      place.shell(python + " '" SPINDRIFT_SOURCE_DIR "/tests/apps/read_back_run.py' r csv vtk ply 0.01");
  CAPTURE(read.err);
  REQUIRE(read.code == 0);
  for (const char* format : {"csv: ", "ply: ", "ply-by-VTK: ", "vtp: ", "vti: ", "vtkhdf: ", "reader: ", "series: "})
    CHECK(contains(read.out, format));
}

TEST_CASE("The Python tools read and draw a run, whatever layers it has", "[export][slow]") {
  const std::string python = python_with("h5py, numpy, matplotlib");
  if (python.empty()) {
    WARN("skipped: no python3 with h5py, numpy and matplotlib (packages-extra.txt)");
    return;
  }
  const Workplace place;
  const auto [text, expected] =
      GENERATE(std::pair{avalanche, "smoke of the last frame"}, std::pair{avalanche_3d, "velocity [m/s]"},
               std::pair{box_scene, "smoke: no frames"},
               std::pair{std::string("schema_version = 1\n[scene]\nend_time = 0.1\n[domain]\nlower = [0, 0]\n"
                                     "upper = [4, 2]\n[suspension]\ncell_size = 0.25\n"),
                         "particles: no frames"});
  place.write("a.toml", text);
  REQUIRE(place.run("run a.toml -o r --quiet --no-preview").code == 0);
  const Outcome summary = place.shell(python + " " + tools + "spindrift_reader.py r");
  CAPTURE(summary.err);
  CHECK(summary.code == 0);
  CHECK(contains(summary.out, expected));
  const Outcome plot = place.shell(python + " " + tools + "plot_run.py r");
  CAPTURE(plot.err);
  CHECK(plot.code == 0);
  CHECK(plot.out == "r/plot.png\n");
  CHECK(text_of(place.folder() / "r/plot.png").starts_with("\x89PNG"));
  CHECK(place.shell(python + " " + tools + "plot_run.py r --frame 0 -o first.svg").code == 0);
  CHECK(fs::exists(place.folder() / "first.svg"));

  for (const char* tool : {"spindrift_reader.py", "plot_run.py"}) {
    const Outcome absent = place.shell(python + " " + tools + tool + " absent");
    CHECK(absent.code == 1);
    CHECK(absent.err == "absent: there is no such folder, expected a run folder\n");
  }
  CHECK(
      place.shell(python + " " + tools + "plot_run.py r --frame 999").err.find("r: there is no frame 999, it has 0") ==
      0);
}

TEST_CASE("Blender draws an export, with its smoke", "[export][slow]") {
  const Workplace place;
  if (place.shell("blender --version").code != 0) {
    WARN("skipped: no blender");
    return;
  }
  place.write("a.toml", avalanche);
  REQUIRE(place.run("run a.toml -o r --quiet --no-preview").code == 0);
  REQUIRE(place.run("export r --to ply --every 5").code == 0);
  const auto blender = [&](const std::string& words) {
    return place.shell("blender -b --python-exit-code 9 -P " + tools + "blender_import.py -- " + words);
  };
  const Outcome drawn = blender("r/export --width 64 --samples 1 --render a.png --save a.blend");
  CAPTURE(drawn.out, drawn.err);
  CHECK(drawn.code == 0);
  CHECK(contains(drawn.out, "2 frames of r/export\n"));
  CHECK(text_of(place.folder() / "a.png").starts_with("\x89PNG"));
  CHECK(fs::exists(place.folder() / "a.blend"));
  CHECK(contains(blender("absent").err, "absent: no PLY files, expected those of `spindrift export RUN --to ply`"));
}
