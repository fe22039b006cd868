#include "app/cli/manual.hpp"

#include "claystack/version.hpp"

#ifdef CLAYSTACK_EXPORT
#include "claystack/export/walls.hpp"
#endif
#ifdef CLAYSTACK_FALCON
#include "app/cli/device_choice.hpp"
#endif

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

namespace clay::cli {
namespace {

/// A line for roff: nothing in it is a request, and a hyphen can be copied.
std::string roff(std::string_view text) {
  std::string line;
  for (const char c : text) {
    if (c == '\\')
      line += "\\e";
    else if (c == '-')
      line += "\\-";
    else
      line += c == '\n' ? ' ' : c;
  }
  if (line.starts_with('.') || line.starts_with('\'')) line.insert(0, "\\&");
  return line;
}

/// A word in single quotes for a shell.
std::string shell_word(std::string_view text) {
  std::string word = "'";
  for (const char c : text) word += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return word + "'";
}

bool is_flag(const CLI::Option& option) { return option.get_items_expected_max() == 0; }

/// "TEXT" of "TEXT:{light,dark}".
std::string value_name(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  return type.substr(0, type.find_first_of(": "));
}

/// The values that the option takes, if they are listed.
std::vector<std::string> choices_of(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t begin = type.find('{'), end = type.find('}');
  std::vector<std::string> choices;
  if (begin == std::string::npos || end == std::string::npos) return choices;
  std::istringstream list(type.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(list, word, ',');) choices.push_back(word);
  return choices;
}

/// The words that an option takes beside the names of files.
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

/// What a shell offers for the value of an option.
struct Completion {
  std::vector<std::string> words;
  bool files = false;
};

Completion completion_of(const CLI::Option& option) {
  if (is_flag(option)) return {};
  if (auto choices = choices_of(option); !choices.empty()) return {std::move(choices), false};
  for (const OpenChoices& open : open_choices())
    if (option.check_lname(std::string(open.option))) return {open.words, true};
  return {{}, true};
}

std::vector<std::string> names_of(const CLI::Option& option) {
  std::vector<std::string> names;
  for (const std::string& name : option.get_snames()) names.push_back("-" + name);
  for (const std::string& name : option.get_lnames()) names.push_back("--" + name);
  return names;
}

std::string joined(const std::vector<std::string>& words, std::string_view between) {
  std::string text;
  for (const std::string& word : words) text.append(text.empty() ? "" : between).append(word);
  return text;
}

std::vector<const CLI::App*> commands_of(const CLI::App& app) {
  std::vector<const CLI::App*> commands;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (!command->get_group().empty()) commands.push_back(command);
  return commands;
}

std::vector<const CLI::Option*> options_of(const CLI::App& command, bool positional) {
  return command.get_options([&](const CLI::Option* option) {
    return option->get_positional() == positional && !option->get_group().empty();
  });
}

void add_option(std::ostream& page, const CLI::Option& option) {
  page << ".TP\n";
  if (option.get_positional()) {
    page << "\\fI" << roff(option.get_name(true)) << "\\fR\n";
  } else {
    std::vector<std::string> names = names_of(option);
    for (std::string& name : names) name = "\\fB" + roff(name) + "\\fR";
    page << joined(names, ", ");
    if (!is_flag(option)) page << " \\fI" << roff(value_name(option)) << "\\fR";
    page << '\n';
  }
  page << roff(option.get_description()) << '\n';
  if (const auto choices = choices_of(option); !choices.empty())
    page << "One of: " << roff(joined(choices, ", ")) << ".\n";
  if (!option.get_default_str().empty())
    page << "Default: " << roff(option.get_default_str()) << ".\n";
}

/// The footer: paragraphs, then "Examples:" and lines of commands.
void add_examples(std::ostream& page, const std::string& footer) {
  std::istringstream lines(footer);
  bool verbatim = false, blank = false;
  for (std::string line; std::getline(lines, line); blank = line.empty()) {
    if (line.empty()) continue;
    if (line == "Examples:") {
      page << ".SH EXAMPLES\n";
      continue;
    }
    const bool command = line.starts_with("  ");
    if (command != verbatim) page << (command ? ".nf\n" : ".fi\n.PP\n");
    if (!command && !verbatim && blank) page << ".PP\n";
    verbatim = command;
    page << roff(command ? line.substr(2) : line) << '\n';
  }
  if (verbatim) page << ".fi\n";
}

std::string upper(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return std::toupper(c); });
  return text;
}

void add_synopsis(std::ostream& page, const CLI::App* command) {
  page << ".SH SYNOPSIS\n.B claystack" << (command ? " " + command->get_name() : "") << '\n';
  if (!command) page << "\\fICOMMAND\\fR\n";
  page << "[\\fIOPTIONS\\fR]\n";
  if (!command) return;
  for (const CLI::Option* option : options_of(*command, true)) {
    const std::string name = "\\fI" + roff(option->get_name(true)) + "\\fR" +
                             (option->get_items_expected_max() > 1 ? "..." : "");
    page << (option->get_required() ? name : "[" + name + "]") << '\n';
  }
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : commands_of(app)) names.push_back(command->get_name());
  return names;
}

/// Case lines: the values of the options of a command.
void add_values_for_bash(std::ostream& script, const CLI::App& command) {
  for (const CLI::Option* option : options_of(command, false)) {
    const Completion offered = completion_of(*option);
    if (offered.words.empty()) continue;
    for (const std::string& name : names_of(*option))
      script << "    " << command.get_name() << ':' << name
             << ") words=" << shell_word(joined(offered.words, " "))
             << (offered.files ? " files=1" : "") << " ;;\n";
  }
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
  if (offered.words.empty()) return "_files";
  if (!offered.files) return "(" + joined(offered.words, " ") + ")";
  for (const OpenChoices& open : open_choices())
    if (open.words == offered.words) return "_claystack_" + std::string(open.option);
  return "_files";
}

}  // namespace

std::string manual_page(const CLI::App& app, const CLI::App* command) {
  std::ostringstream page;
  const CLI::App& shown = command ? *command : app;
  const std::string name = command ? "claystack-" + command->get_name() : "claystack";
  page << ".TH " << upper(roff(name)) << " 1 " << CLAYSTACK_MANUAL_DATE << " \"claystack "
       << CLAYSTACK_VERSION << "\" \"User Commands\"\n"
       << ".SH NAME\n"
       << roff(name) << " \\- " << roff(shown.get_description()) << '\n';
  add_synopsis(page, command);
  if (!command) {
    page << ".SH COMMANDS\n";
    for (const CLI::App* one : commands_of(app))
      page << ".TP\n\\fB" << roff(one->get_name()) << "\\fR\n"
           << roff(one->get_description()) << '\n';
  }
  page << ".SH OPTIONS\n";
  for (const CLI::Option* option : options_of(shown, true)) add_option(page, *option);
  for (const std::string& heading : shown.get_groups()) {
    if (heading != "Options") page << ".SS " << roff(heading) << '\n';
    for (const CLI::Option* option : options_of(shown, false))
      if (option->get_group() == heading) add_option(page, *option);
  }
  add_examples(page, shown.get_footer());
  if (!command) {
    page << ".SH FILES\n.TP\n\\fI" << roff(CLAYSTACK_DATA)
         << "/samples\\fR\nScenes, sessions, drawings and schemas: copy the folder to run the "
            "examples.\n";
  } else {
    page << ".SH EXIT STATUS\n0 done and sound; 1 done, but a check failed; 2 bad usage or bad "
            "input; 3 could not read or write; 4 a device failed, or no display or OpenGL was "
            "found.\n";
  }
  page << ".SH SEE ALSO\n";
  std::vector<std::string> others;
  for (const CLI::App* one : commands_of(app))
    if (one != command) others.push_back("\\fBclaystack\\-" + roff(one->get_name()) + "\\fR(1)");
  if (command) others.insert(others.begin(), "\\fBclaystack\\fR(1)");
  page << joined(others, ",\n") << '\n';
  return page.str();
}

std::string bash_completions(const CLI::App& app) {
  std::ostringstream script;
  const std::string names = joined(command_names(app), " ");
  script << "# bash completion for claystack\n_claystack() {\n"
            "  local current=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]}\n"
            "  local words= files=\n"
            "  if [ \"$COMP_CWORD\" -eq 1 ]; then\n    words="
         << shell_word(names + " help --help --version")
         << "\n  else\n    case ${COMP_WORDS[1]}:$before in\n    help:help) words="
         << shell_word(names) << " ;;\n";
  for (const CLI::App* command : commands_of(app)) add_values_for_bash(script, *command);
  script << "    esac\n    if [ -z \"$words\" ] && [[ $current == -* ]]; then\n"
            "      case ${COMP_WORDS[1]} in\n";
  for (const CLI::App* command : commands_of(app))
    script << "      " << command->get_name() << ") words=" << shell_word(words_for_bash(*command))
           << " ;;\n";
  script << "      esac\n    fi\n  fi\n"
            "  COMPREPLY=($(compgen -W \"$words\" -- \"$current\"))\n"
            "  if [ -z \"$words\" ] || [ -n \"$files\" ]; then\n    compopt -o filenames\n"
            "    COMPREPLY+=($(compgen -f -- \"$current\"))\n  fi\n}\n"
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
    script << " \\\n      '*:file:_files'\n    ;;\n";
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
         << shell_word(joined(command_names(app), " ")) << '\n';
  for (const CLI::App* command : commands_of(app))
    for (const CLI::Option* option : options_of(*command, false)) {
      script << "complete -c claystack -n '__fish_seen_subcommand_from " << command->get_name()
             << "'";
      for (const std::string& name : option->get_snames()) script << " -s " << name;
      for (const std::string& name : option->get_lnames()) script << " -l " << name;
      if (const Completion offered = completion_of(*option); !offered.words.empty())
        script << (offered.files ? " -r -a " : " -x -a ") << shell_word(joined(offered.words, " "));
      else if (!is_flag(*option))
        script << " -r";
      script << " -d " << shell_word(option->get_description()) << '\n';
    }
  return script.str();
}

}  // namespace clay::cli
