#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "small_scenes.hpp"
#include "workplace.hpp"

using namespace spindrift::testing;

namespace {

const std::string& scene = box_scene;

}  // namespace

TEST_CASE("help and version go to stdout", "[commands]") {
  const Workplace place;
  CHECK(place.run("--version").out == "spindrift " SPINDRIFT_VERSION "\n");
  const auto words =
      GENERATE(as<std::string>{}, "--help", "run --help", "check --help", "info --help", "export --help", "-h");
  const Outcome help = place.run(words);
  CHECK(help.code == 0);
  CHECK(help.err.empty());
  CHECK(help.out.find("Example:  spindrift ") != std::string::npos);
}

TEST_CASE("a bad command line ends with code 2, says what was meant and touches nothing", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  struct Row {
    std::string words, message;
  };
  const auto row = GENERATE(
      Row{"", "A subcommand is required\nSee spindrift --help.\n"},
      Row{"rnu a.toml", "there is no command \"rnu\"; did you mean \"run\"?\nSee spindrift --help.\n"},
      Row{"chekc a.toml", "there is no command \"chekc\"; did you mean \"check\"?\nSee spindrift --help.\n"},
      Row{"frobnicate", "there is no command \"frobnicate\"\nSee spindrift --help.\n"},
      Row{"--verson", "there is no option --verson; did you mean --version?\nSee spindrift --help.\n"},
      Row{"run", "SCENE.toml is required\nSee spindrift run --help.\n"},
      Row{"run a.toml --sett a=1", "there is no option --sett; did you mean --set?\nSee spindrift run --help.\n"},
      Row{"run a.toml --frames_per_second=3",
          "there is no option --frames_per_second; did you mean --frames-per-second?\nSee spindrift run --help.\n"},
      Row{"info", "DIR is required\nSee spindrift info --help.\n"},
      Row{"export a", "--to is required\nSee spindrift export --help.\n"},
      Row{"export a --ot csv", "there is no option --ot; did you mean --to?\nSee spindrift export --help.\n"});
  const Outcome outcome = place.run(row.words);
  CHECK(outcome.code == 2);
  CHECK(outcome.err == row.message);
  CHECK(outcome.out.empty());
  CHECK(place.n_entries() == 1);
}

TEST_CASE("options take only values of their kind", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  const auto words =
      GENERATE(as<std::string>{}, "run a.toml --threads -1", "run a.toml --threads many", "run a.toml --until",
               "run a.toml --until never", "run a.toml --until -5", "run a.toml --seed -3", "run a.toml --seed 1.5",
               "run a.toml --frames-per-second nan", "run a.toml b.toml", "run a.toml --set nonsense",
               "run a.toml --set dense_flow.solvr=wcsph", "run b.toml", "run .", "check b.toml", "info a.toml");
  CAPTURE(words);
  const Outcome outcome = place.run(words);
  CHECK(outcome.code == 2);
  CHECK(outcome.out.empty());
  CHECK_FALSE(outcome.err.empty());
  CHECK(place.n_entries() == 1);
}

TEST_CASE("a bad scene ends run and check with code 2 and all its errors", "[commands]") {
  const Workplace place;
  place.write("bad.toml", scene + "preveiw = true\n[dense_fow]\n[suspension]\ncell_size = -1\n");
  const auto command = GENERATE(as<std::string>{}, "run", "check");
  const Outcome outcome = place.run(command + " bad.toml");
  CHECK(outcome.code == 2);
  CHECK(outcome.err ==
        "bad.toml:17:1: output.preveiw: unknown key; did you mean \"preview\"?\n"
        "bad.toml:18:2: dense_fow: unknown section; did you mean \"dense_flow\"?\n"
        "bad.toml:20:13: suspension.cell_size: got -1, expected a length above 0 and at most 10000 m\n");
  CHECK(outcome.out.empty());
  CHECK(place.n_entries() == 1);
}

TEST_CASE("a scene that would not fit ends with code 6 and touches nothing", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  const auto command = GENERATE(as<std::string>{}, "run", "check");
  const Outcome outcome = place.run(command + " a.toml --set suspension.cell_size='1e-6 mm'");
  CHECK(outcome.code == 6);
  CHECK(outcome.err.find("suspension.cell_size") != std::string::npos);
  CHECK(place.n_entries() == 1);
}

TEST_CASE("bash completes commands, options, keys and their words", "[commands]") {
  const Workplace place;
  place.write("script.bash", place.run("completion bash").out);
  const auto completed = [&](const std::string& line) {
    place.write("ask.bash", "source ./script.bash\nCOMP_LINE='" + line +
                                "'\nCOMP_POINT=${#COMP_LINE}\n_spindrift\necho \"${COMPREPLY[*]}\"\n");
    return place.shell("bash ask.bash").out;
  };
  CHECK(completed("spindrift ru") == "run\n");
  CHECK(completed("spindrift run --thr") == "--threads\n");
  CHECK(completed("spindrift run a.toml --set terrain.sh") == "terrain.shape=\n");
  CHECK(completed("spindrift run a.toml --set terrain.shape=b") == "bumps bowl\n");
  CHECK(completed("spindrift run a.toml --set output.smoke=") == "true false\n");
  CHECK(completed("spindrift scene --preset p") == "physical paper\n");
  CHECK(completed("spindrift run a.toml --set zzz") == "\n");
  CHECK(completed("spindrift export r --to p") == "ply\n");
}

TEST_CASE("check warns of what hardly makes sense, with place and reason", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  const Outcome outcome = place.run("check a.toml --set suspension.cell_size=0.1");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.starts_with("--set: warning: suspension.cell_size: cells of 0.1 m are finer than the particles"));
  CHECK(place.run("run a.toml --quiet --set suspension.cell_size=0.1").err.empty());
}

TEST_CASE("check tells what a run would need, and writes nothing", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  const Outcome outcome = place.run("check a.toml --set suspension.cell_size=0.2 --set scene.end_time='2 s'");
  CHECK(outcome.code == 0);
  CHECK(outcome.err.empty());
  CHECK(outcome.out.starts_with("scene       a, 2D, 2 s\nextent      x "));
  CHECK(outcome.out.find(" m\nparticles   about 50 released, 0 in the cover\n") != std::string::npos);
  CHECK(outcome.out.find("cells       800 (40 x 20)\nframes      21\nmemory      about ") != std::string::npos);
  CHECK(place.n_entries() == 1);
}

TEST_CASE("the locale of the user changes nothing", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  const std::string words = "check a.toml --set suspension.cell_size='0.25 m'";
  const std::string plain = place.run(words).out.substr(0, 120);
  CHECK(place.run(words, "LC_ALL=de_DE.UTF-8 TZ=Asia/Tokyo").out.substr(0, 120) == plain);
}

TEST_CASE("info tells what run.json holds", "[commands]") {
  const Workplace place;
  const auto write_run = [&](const std::string& text) {
    fs::create_directories(place.folder() / "r");
    place.write("r/run.json", text);
  };
  write_run(R"({"status": "done", "time": 2.5, "mass": {"initial": 10, "dense": 9}, "dt_limiters": {}})");
  const Outcome plain = place.run("info r");
  CHECK(plain.code == 0);
  CHECK(plain.out ==
        "status                           done\ntime                             2.5 s\n"
        "mass.initial                     10 kg/m\nmass.dense                       9 kg/m\n");
  const Outcome json = place.run("info r --json");
  CHECK(json.code == 0);
  CHECK(json.out.find("{\n  \"status\": \"done\",\n  \"time\": 2.5,") == 0);

  const auto broken = GENERATE(as<std::string>{}, "", "{", "[1]", "{\"status\": }", "\xFF\xFE");
  write_run(broken);
  CHECK(place.run("info r").code == 4);
  CHECK(place.run("info r --json").code == 4);
}

TEST_CASE("a run goes to its end, names its folder and can be asked about", "[commands]") {
  const Workplace place;
  place.write("drop.toml", scene);
  const Outcome run = place.run("run drop.toml");
  CHECK(run.code == 0);
  CHECK(run.out == "runs/drop\n");
  CHECK(run.err.find("done: ") != std::string::npos);
  CHECK(place.run("info runs/drop --json").out.find("\"status\": \"done\"") != std::string::npos);

  const Outcome quiet = place.run("run drop.toml -o there --quiet --until '10 ms' --seed 3 --threads 1 --no-preview");
  CHECK(quiet.code == 0);
  CHECK(quiet.out == "there\n");
  CHECK(quiet.err.empty());
}

TEST_CASE("a run tells programs where it stands, and keeps a log and a profile", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  const Outcome outcome = place.run("run a.toml -o out --log-json --profile trace.json");
  CHECK(outcome.code == 0);
  std::istringstream lines(outcome.err);
  std::vector<std::string> events;
  for (std::string line; std::getline(lines, line);) events.push_back(nlohmann::json::parse(line).at("event"));
  REQUIRE(events.size() >= 3);
  CHECK(events.front() == "start");
  CHECK(events.back() == "end");
  CHECK(std::count(events.begin(), events.end(), "progress") >= 1);
  CHECK(text_of(place.folder() / "out/log.txt").find("done: 0.02 of 0.02 s simulated in ") != std::string::npos);
  const nlohmann::json trace = nlohmann::json::parse(text_of(place.folder() / "trace.json"));
  CHECK(trace["traceEvents"].size() > 10);
  const Outcome bad = place.run("run a.toml -o a.toml/out --log-json");
  CHECK(bad.code == 5);
  const nlohmann::json error = nlohmann::json::parse(bad.err.substr(bad.err.rfind("{\"event\":\"error\"")));
  CHECK(error["code"] == 5);
}

TEST_CASE("a run replaces its own scene's results, and others only when told to", "[commands]") {
  const Workplace place;
  place.write("a.toml", scene);
  place.write("b.toml", scene);
  CHECK(place.run("run a.toml -o out").code == 0);
  CHECK(place.run("run a.toml -o out").err.starts_with("out: replacing the run of a.toml (done, 0.02 s)\n"));
  const Outcome other = place.run("run b.toml -o out");
  CHECK(other.code == 2);
  CHECK(other.err ==
        "out holds the run of a.toml (done, 0.02 s); choose another folder with -o, or replace it with --overwrite\n");
  CHECK(place.run("info out").out.find("a.toml") != std::string::npos);
  CHECK(place.run("run b.toml -o out --overwrite").code == 0);
  for (const char* broken : {"{", "[]", "{\"scene_file\": 3}"}) {
    place.write("out/run.json", broken);
    CHECK(place.run("run b.toml -o out").code == 2);
    CHECK(place.run("run b.toml -o out --overwrite").code == 0);
  }
  fs::create_directories(place.folder() / "docs");
  place.write("docs/letter.txt", "dear");
  CHECK(place.run("run a.toml -o docs").err.starts_with("docs is not empty and holds no run; choose another folder"));
  CHECK(std::distance(fs::directory_iterator(place.folder() / "docs"), {}) == 1);
}

TEST_CASE("a scene that is not there: the nearest beside it", "[commands]") {
  const Workplace place;
  place.write("quickstart.toml", scene);
  CHECK(place.run("check quikstart.toml").err ==
        "quikstart.toml: there is no such file; did you mean \"quickstart.toml\"?\n");
}

TEST_CASE("a run that is asked to stop ends after its step", "[commands]") {
  const Workplace place;
  const auto signal = GENERATE(as<std::string>{}, "INT", "TERM");
  place.write("drop.toml", scene);
  place.write("stop.sh", "'" SPINDRIFT_BINARY_DIR
                         "/spindrift' run drop.toml -o long --until 10000 --frames-per-second 0 >out 2>err &\n"
                         "until [ -e long/scene.toml ] || ! kill -0 $!; do sleep 0.02; done\n"
                         "kill -" +
                             signal + " $!\nwait $!\n");
  const int status = std::system(("cd '" + place.folder().string() + "' && timeout 60 bash stop.sh").c_str());
  REQUIRE(WIFEXITED(status));
  CHECK(WEXITSTATUS(status) == 75);
  CHECK(text_of(place.folder() / "err").find("stopped: ") != std::string::npos);
  CHECK(place.run("info long --json").out.find("\"status\": \"stopped\"") != std::string::npos);
}

TEST_CASE("scene tells the schema, the defaults, or what a scene amounts to", "[commands]") {
  const Workplace place;
  place.write("box.toml", scene);
  const Outcome schema = place.run("scene --schema");
  CHECK(schema.code == 0);
  CHECK(schema.out.starts_with("{\n  \"$schema\""));
  CHECK(place.run("scene --defaults --preset paper").out.find("[dense_flow]") != std::string::npos);
  const Outcome printed = place.run("scene --print box.toml --set dense_flow.density=200");
  CHECK(printed.code == 0);
  CHECK(printed.out.find("density = 200  # [kg/m^3], --set") != std::string::npos);
  CHECK(printed.out.find("support_radius = 0.4  # [m], box.toml:14:18") != std::string::npos);
  CHECK(place.run("scene").code == 2);
  CHECK(place.run("scene --schema --defaults").code == 2);
  CHECK(place.run("scene --defaults --preset pape").err.find("pape") != std::string::npos);
  CHECK(place.run("scene --print nothing.toml").code == 2);
}
