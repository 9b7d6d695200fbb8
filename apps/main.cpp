#include <fmt/format.h>

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string_view>

#include "commands.hpp"
#include "simulation/spelling.hpp"

namespace spindrift {
namespace {

int failed(ExitCode code, std::string_view message) {
  fmt::print(stderr, "{}\n", message);
  return static_cast<int>(code);
}

/// The parser's complaint, or a better one: the first word that is no command or option, and what was meant.
std::string complaint(const CLI::App& app, int argc, char** argv, const CLI::ParseError& error) {
  std::vector<std::string_view> commands, options;
  const CLI::App* command = nullptr;
  for (const CLI::App* sub : app.get_subcommands(nullptr)) {
    commands.push_back(sub->get_name());
    if (argc > 1 && sub->get_name() == argv[1]) command = sub;
  }
  for_each_option(command ? *command : app, [&](const CLI::Option& option) {
    for (const std::string& name : option.get_lnames()) options.push_back(name);
  });
  const std::string help = fmt::format("\nSee {} --help.", command ? "spindrift " + command->get_name() : "spindrift");
  if (argc > 1 && !command && argv[1][0] != '-')
    return fmt::format("there is no command \"{}\"{}{}", argv[1], did_you_mean(argv[1], commands), help);
  for (int i = 1; i < argc; ++i) {
    std::string_view word = argv[i];
    if (word == "--") break;
    if (!word.starts_with("--")) continue;
    word = word.substr(2, word.find('=') - 2);
    if (std::find(options.begin(), options.end(), word) != options.end()) continue;
    const auto meant = nearest(word, options);
    return fmt::format("there is no option --{}{}{}", word, meant ? fmt::format("; did you mean --{}?", *meant) : "",
                       help);
  }
  return error.what() + help;
}

int run_program(int argc, char** argv) {
  CLI::App app{
      "Spindrift simulates mixed-motion avalanches: flowing snow, the cover that it sweeps along, and the snow smoke\n"
      "above it.",
      "spindrift"};
  app.footer(
      "First steps:\n"
      "  spindrift run configs/quickstart.toml    a small avalanche; its pictures are in runs/quickstart/preview\n"
      "  spindrift info runs/quickstart           what it came to\n"
      "  spindrift scene --reference              what a scene of your own may say\n"
      "  spindrift check my_slope.toml            its mistakes, and what it will cost\n\n"
      "Every command has its own --help.\n"
      "Example:  spindrift run configs/paper/fig09a_bumpy.toml -o runs/first\n"
      "Exit codes: 0 done, 2 bad input, 3 unstable, 4 bad file, 5 input or output failed, 6 would not fit, 70 a bug,\n"
      "75 stopped.");
  app.set_version_flag("--version", "spindrift " SPINDRIFT_VERSION);
  app.require_subcommand(1);
  Command chosen;
  add_run(app, chosen);
  add_check(app, chosen);
  add_scene(app, chosen);
  add_info(app, chosen);
  add_completion(app, chosen);
  add_export(app, chosen);
  add_render(app, chosen);
  add_verify(app, chosen);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return failed(ExitCode::bad_input, complaint(app, argc, argv, error));
  }
  return static_cast<int>(chosen());
}

}  // namespace
}  // namespace spindrift

int main(int argc, char** argv) {
  using namespace spindrift;
  // A file above the limit of its size (ulimit -f) is a failed write like any other, told with its name.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    return run_program(argc, argv);
  } catch (const Error& error) {
    return failed(error.code(), error.what());
  } catch (const std::bad_alloc&) {
    return failed(ExitCode::would_not_fit, "out of memory");
  } catch (const std::exception& error) {
    return failed(ExitCode::bug, fmt::format("a bug in spindrift, please report it: {}", error.what()));
  }
}
