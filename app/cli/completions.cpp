#include "app/cli/completions.hpp"

#include "app/cli/option_table.hpp"
#include "app/cli/usage.hpp"

#ifdef CLAYSTACK_EXPORT
#include "claystack/export/walls.hpp"
#endif
#ifdef CLAYSTACK_FALCON
#include "app/cli/device_choice.hpp"
#endif

#include <CLI/CLI.hpp>

#include <algorithm>
#include <sstream>
#include <string_view>
#include <vector>

namespace clay::cli {
namespace {

/// A word in single quotes for a shell.
std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

/// Words that an option takes in addition to names of files.
struct OpenChoices {
  std::string_view option;
  std::vector<std::string> words;
};

const std::vector<OpenChoices>& open_choices() {
  static const std::vector<OpenChoices> all = {
#ifdef CLAYSTACK_EXPORT
      {"process", {solid::kProcessNames.begin(), solid::kProcessNames.end()}},
#endif
#ifdef CLAYSTACK_FALCON
      {"device", {kDeviceNames.begin(), kDeviceNames.end()}},
#endif
  };
  return all;
}

/// Suggestions of a shell for the value of an option.
struct Completion {
  std::vector<std::string> words;
  bool files = false;
};

Completion completion_of(const CLI::Option& option) {
  if (is_flag(option)) return {};
  if (auto choices = choices_of(option); !choices.empty()) return {std::move(choices), false};
  for (const OpenChoices& open : open_choices())
    if (option.check_lname(std::string(open.option))) return {open.words, true};
  return {{}, value_name(option) == kFileName};
}

/// Whether an argument without dashes is a file.
bool takes_files(const CLI::App& command) {
  return std::ranges::any_of(options_of(command, true), [](const CLI::Option* argument) {
    return value_name(*argument) == kFileName;
  });
}

/// Case lines: the values of the options of a command, then its arguments.
void add_values_for_bash(std::ostream& script, const CLI::App& command) {
  for (const CLI::Option* option : options_of(command, false)) {
    if (is_flag(*option)) continue;
    const Completion offered = completion_of(*option);
    for (const std::string& name : names_of(*option)) {
      script << "    " << command.get_name() << ':' << name << ')';
      if (!offered.words.empty()) script << " words=" << shell_word(joined(offered.words, " "));
      script << (offered.files ? " files=1" : "") << " ;;\n";
    }
  }
  if (takes_files(command)) script << "    " << command.get_name() << ":*) files=1 ;;\n";
}

std::string words_for_bash(const CLI::App& command) {
  std::vector<std::string> words;
  for (const CLI::Option* option : options_of(command, false))
    for (std::string& name : names_of(*option)) words.push_back(std::move(name));
  return joined(words, " ");
}

/// ':' and ']' end the fields of a specification of zsh.
std::string for_zsh(std::string_view text) {
  std::string word;
  for (const char c : text) {
    if (c == ':' || c == '[' || c == ']' || c == '\\') word += '\\';
    word += c == '\n' ? ' ' : c;
  }
  return word;
}

/// The part of a specification that offers the values.
std::string action_for_zsh(const CLI::Option& option) {
  const Completion offered = completion_of(option);
  if (offered.words.empty()) return offered.files ? "_files" : " ";
  if (!offered.files) return "(" + joined(offered.words, " ") + ")";
  for (const OpenChoices& open : open_choices())
    if (open.words == offered.words) return "_claystack_" + std::string(open.option);
  return "_files";
}

/// -F offers files also where the command takes none; -x offers none.
void add_command_for_fish(std::ostream& script, const CLI::App& command) {
  const std::string line =
      "complete -c claystack -n '__fish_seen_subcommand_from " + command.get_name() + "'";
  if (!takes_files(command)) script << line << " -f\n";
  for (const CLI::Option* option : options_of(command, false)) {
    script << line;
    for (const std::string& name : option->get_snames()) script << " -s " << name;
    for (const std::string& name : option->get_lnames()) script << " -l " << name;
    const Completion offered = completion_of(*option);
    if (!is_flag(*option)) script << (offered.files ? " -r -F" : " -x");
    if (!offered.words.empty()) script << " -a " << shell_word(joined(offered.words, " "));
    script << " -d " << shell_word(option->get_description()) << '\n';
  }
}

}  // namespace

std::string bash_completions(const CLI::App& app) {
  std::ostringstream script;
  const std::string names = joined(names_of_commands(app), " ");
  script << "# bash completion for claystack\n_claystack() {\n"
            "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
            "  local words= files=\n"
            "  [ \"$current\" != = ] || current=  # --option= is two words\n"
            "  [ \"$before\" != = ] || before=${COMP_WORDS[COMP_CWORD-2]}\n"
            "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    words="
         << shell_word(names + " help --help --version")
         << "\n  else\n    case ${COMP_WORDS[1]}:$before in\n    help:help) words="
         << shell_word(names) << " ;;\n";
  for (const CLI::App* command : commands_of(app)) add_values_for_bash(script, *command);
  script << "    esac\n    if [ -z \"$words\" ] && [[ $current == -* ]]; then\n"
            "      files=\n      case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : commands_of(app))
    script << "      " << command->get_name() << ") words=" << shell_word(words_for_bash(*command))
           << " ;;\n";
  script << "      esac\n    fi\n  fi\n"
            "  mapfile -t COMPREPLY < <(compgen -W \"$words\" -- \"$current\")\n"
            "  [ -n \"$files\" ] || return 0\n"
            "  compopt -o filenames -o default  # bash reads a quoted beginning of a name\n"
            "  mapfile -t -O ${#COMPREPLY[@]} COMPREPLY < <(compgen -f -- \"$current\")\n}\n"
            "complete -F _claystack claystack\n";
  return script.str();
}

std::string zsh_completions(const CLI::App& app) {
  std::ostringstream script;
  script << "#compdef claystack\n";
  for (const OpenChoices& open : open_choices())
    script << "_claystack_" << open.option << "() {\n  _alternative 'words:word:("
           << joined(open.words, " ") << ")' 'files:file:_files'\n}\n";
  script << "_claystack() {\n  local -a commands\n  commands=(\n";
  for (const CLI::App* command : commands_of(app))
    script << "    " << shell_word(command->get_name() + ":" + for_zsh(command->get_description()))
           << '\n';
  script << "  )\n  if (( CURRENT == 2 )) || [[ $CURRENT == 3 && $words[2] == help ]]; then\n"
            "    (( CURRENT == 2 )) && commands+=('help:Print the help of a command')\n"
            "    _describe command commands\n    return\n  fi\n"
            "  shift words\n  (( CURRENT-- ))\n  case $words[1] in\n";
  for (const CLI::App* command : commands_of(app)) {
    script << "  " << command->get_name() << ")\n    _arguments";
    for (const CLI::Option* option : options_of(*command, false))
      for (const std::string& name : names_of(*option)) {
        std::string spec = name + "[" + for_zsh(option->get_description()) + "]";
        if (!is_flag(*option))
          spec += ":" + for_zsh(value_name(*option)) + ":" + action_for_zsh(*option);
        script << " \\\n      " << shell_word(spec);
      }
    if (takes_files(*command)) script << " \\\n      '*:file:_files'";
    script << "\n    ;;\n";
  }
  script << "  esac\n}\n_claystack \"$@\"\n";
  return script.str();
}

std::string fish_completions(const CLI::App& app) {
  std::ostringstream script;
  for (const CLI::App* command : commands_of(app))
    script << "complete -c claystack -f -n __fish_use_subcommand -a " << command->get_name()
           << " -d " << shell_word(command->get_description()) << '\n';
  script << "complete -c claystack -f -n __fish_use_subcommand -a help -d "
            "'Print the help of a command'\n"
            "complete -c claystack -f -n '__fish_seen_subcommand_from help' -a "
         << shell_word(joined(names_of_commands(app), " ")) << '\n';
  for (const CLI::App* command : commands_of(app)) add_command_for_fish(script, *command);
  return script.str();
}

}  // namespace clay::cli
