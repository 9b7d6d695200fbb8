#include <fmt/format.h>

#include <memory>

#include "commands.hpp"
#include "simulation/registry.hpp"
#include "simulation/scene_reader.hpp"
#include "simulation/scene_reference.hpp"
#include "simulation/scene_schema.hpp"
#include "simulation/scene_writer.hpp"

namespace spindrift {
namespace {

struct Wanted {
  bool schema = false, defaults = false, reference = false;
  std::string preset = "physical";
  SceneArguments print;
};

ExitCode show(const Wanted& wanted) {
  if (wanted.schema) {
    fmt::print("{}", scene_schema());
  } else if (wanted.reference) {
    fmt::print("{}", scene_reference());
  } else if (wanted.defaults) {
    fmt::print("{}", described_defaults(wanted.preset));
  } else {
    Origins origins;
    const Scene scene = read_scene(wanted.print.file, wanted.print.settings, &origins);
    fmt::print("{}", write_scene(scene, &origins));
  }
  return ExitCode::done;
}

}  // namespace

void add_scene(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("scene", "Tell what a scene may say, or what one amounts to");
  const auto wanted = std::make_shared<Wanted>();
  CLI::Option_group* what = command->add_option_group("what");
  what->add_flag("--schema", wanted->schema, "the JSON Schema of scene files, for editors");
  what->add_flag("--defaults", wanted->defaults, "every key with its default, unit and meaning, as a scene file");
  what->add_flag("--reference", wanted->reference, "the same as a page to read, in Markdown: docs/scene.md");
  what->add_option("--print", wanted->print.file, "the scene with every value, and where each one comes from")
      ->type_name("SCENE.toml");
  what->require_option(1);
  const auto& presets = find_key("scene.preset")->words;
  command->add_option("--preset", wanted->preset, "whose defaults")
      ->check(CLI::IsMember(std::vector<std::string>(presets.begin(), presets.end())))
      ->capture_default_str();
  add_settings(*command, wanted->print.settings);
  command->footer("Example:  spindrift scene --print my_slope.toml --set terrain.angle='40 deg'");
  command->callback([wanted, &chosen] { chosen = [wanted] { return show(*wanted); }; });
}

}  // namespace spindrift
