#include <fmt/format.h>
#include <fmt/ranges.h>

#include <memory>

#include "commands.hpp"
#include "simulation/registry.hpp"

namespace spindrift {
namespace {

using Words = std::vector<std::string>;

/// The words that an option takes, from its validator's text "{csv,vtk}" or its type's "csv|vtk"; empty: any.
Words values_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.find('}');
  if (type.find('|') != std::string::npos) return CLI::detail::split(type, '|');
  if (open == std::string::npos || close == std::string::npos) return {};
  return CLI::detail::split(type.substr(open + 1, close - open - 1), ',');
}

Words commands_of(const CLI::App& app) {
  Words names;
  for (const CLI::App* command : app.get_subcommands(nullptr)) names.push_back(command->get_name());
  return names;
}

Words options_of(const CLI::App& command) {
  Words names;
  for_each_option(command, [&](const CLI::Option& option) {
    for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  });
  return names;
}

/// "terrain.shape=" of every key.
Words settings() {
  Words paths;
  for (const Key& key : keys()) paths.push_back(key.path + "=");
  return paths;
}

/// One `case` a line: the words that may follow a key's '=' and those that may follow an option.
std::string value_cases(const CLI::App& app) {
  std::string text;
  Scene scene = complete_scene("physical");
  for (const Key& key : keys()) {
    Words words(key.words.begin(), key.words.end());
    if (std::holds_alternative<bool*>(key.field(scene))) words = {"true", "false"};
    if (!words.empty()) text += fmt::format("    {}=) echo \"{}\" ;;\n", key.path, fmt::join(words, " "));
  }
  for (const CLI::App* command : app.get_subcommands(nullptr))
    for_each_option(*command, [&](const CLI::Option& option) {
      const Words words = values_of(option);
      if (!words.empty())
        text += fmt::format("    {}--{}) echo \"{}\" ;;\n", command->get_name(), option.get_lnames()[0],
                            fmt::join(words, " "));
    });
  return text;
}

std::string option_cases(const CLI::App& app) {
  std::string text;
  for (const CLI::App* command : app.get_subcommands(nullptr))
    text += fmt::format("    {}) echo \"{}\" ;;\n", command->get_name(), fmt::join(options_of(*command), " "));
  return text;
}

/// What both shells share: functions that print words.
std::string tables(const CLI::App& app) {
  return fmt::format(
      "_spindrift_commands() {{ echo \"{}\"; }}\n"
      "_spindrift_settings() {{ echo \"{}\"; }}\n"
      "_spindrift_options() {{\n  case $1 in\n{}  esac\n}}\n"
      "_spindrift_values() {{\n  case $1 in\n{}  esac\n}}\n",
      fmt::join(commands_of(app), " "), fmt::join(settings(), " "), option_cases(app), value_cases(app));
}

/// Bash breaks words at '=', so only what stands behind the last one is completed.
constexpr std::string_view bash_part = R"sh(_spindrift() {
  local line=${COMP_LINE:0:COMP_POINT} before current last command
  current=${line##* }
  before=${line%"$current"}
  before=${before%"${before##*[! ]}"}
  last=${before##* }
  command=$(set -- $before; echo "$2")
  COMPREPLY=()
  if [[ $before != *" "* ]]; then
    COMPREPLY=($(compgen -W "$(_spindrift_commands) --help --version" -- "$current"))
  elif [[ $last == --set && $current == *=* ]]; then
    COMPREPLY=($(compgen -W "$(_spindrift_values "${current%%=*}=")" -- "${current#*=}"))
  elif [[ $last == --set ]]; then
    COMPREPLY=($(compgen -W "$(_spindrift_settings)" -- "$current"))
    compopt -o nospace 2>/dev/null
  elif [[ -n $(_spindrift_values "$command$last") ]]; then
    COMPREPLY=($(compgen -W "$(_spindrift_values "$command$last")" -- "$current"))
  elif [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$(_spindrift_options "$command")" -- "$current"))
  else
    compopt -o default 2>/dev/null
  fi
}
complete -F _spindrift spindrift
)sh";

constexpr std::string_view zsh_part = R"sh(_spindrift() {
  local command=${words[2]} last=${words[CURRENT-1]} current=${words[CURRENT]}
  if (( CURRENT == 2 )); then
    compadd -- $(_spindrift_commands) --help --version
  elif [[ $last == --set && $current == *=* ]]; then
    compset -P '*='
    compadd -- $(_spindrift_values "${current%%=*}=")
  elif [[ $last == --set ]]; then
    compadd -S '' -- $(_spindrift_settings)
  elif [[ -n $(_spindrift_values "$command$last") ]]; then
    compadd -- $(_spindrift_values "$command$last")
  elif [[ $current == -* ]]; then
    compadd -- $(_spindrift_options "$command")
  else
    _files
  fi
}
compdef _spindrift spindrift
)sh";

}  // namespace

void for_each_option(const CLI::App& command, const std::function<void(const CLI::Option&)>& f) {
  for (const CLI::Option* option : command.get_options())
    if (!option->get_lnames().empty()) f(*option);
  for (const CLI::App* group : command.get_subcommands(nullptr))
    if (group->get_name().empty()) for_each_option(*group, f);
}

void add_completion(CLI::App& app, Command& chosen) {
  CLI::App* command = app.add_subcommand("completion", "Print a script that completes commands, options and keys");
  const auto shell = std::make_shared<std::string>();
  command->add_option("SHELL", *shell, "bash or zsh")
      ->required()
      ->type_name("")
      ->check(CLI::IsMember(std::vector<std::string>{"bash", "zsh"}));
  command->footer(
      "Example:  source <(build/release/spindrift completion bash)     # in ~/.bashrc\n"
      "          source <(build/release/spindrift completion zsh)      # in ~/.zshrc, after compinit");
  command->callback([shell, &app, &chosen] {
    chosen = [shell, &app] {
      fmt::print("{}{}", tables(app), *shell == "bash" ? bash_part : zsh_part);
      return ExitCode::done;
    };
  });
}

}  // namespace spindrift
