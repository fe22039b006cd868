#include "app/cli/manual.hpp"

#include "app/cli/installed.hpp"
#include "app/cli/option_table.hpp"
#include "claystack/version.hpp"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <cctype>
#include <sstream>
#include <vector>

namespace clay::cli {
namespace {

/// A line with escapes for roff: its text contains no request, and a hyphen can be copied.
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
  const std::string& description = option.get_description();
  page << roff(description) << (description.ends_with('.') ? "\n" : ".\n");
  if (const auto choices = choices_of(option); !choices.empty())
    page << "One of: " << roff(joined(choices, ", ")) << ".\n";
  if (!option.get_default_str().empty())
    page << "Default: " << roff(option.get_default_str()) << ".\n";
  if (!option.get_envname().empty())
    page << "Environment variable: \\fB" << roff(option.get_envname()) << "\\fR.\n";
}

/// The footer without its exit status: paragraphs, then "Examples:" and lines of commands.
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

constexpr std::string_view kStatus = "Exit status: ";

/// The exit status that a footer states after its examples; empty if it states none.
std::string exit_status(const std::string& footer) {
  const std::size_t at = footer.find(kStatus);
  return at == std::string::npos ? "" : footer.substr(at + kStatus.size());
}

/// The statuses of a command are in addition to those of the program.
void add_exit_status(std::ostream& page, const CLI::App& app, const CLI::App& shown) {
  const std::string own = exit_status(shown.get_footer());
  page << ".SH EXIT STATUS\n" << roff(own.empty() ? exit_status(app.get_footer()) : own) << '\n';
  if (&shown != &app && !own.empty())
    page << ".PP\nThe other statuses are those of \\fBclaystack\\fR(1).\n";
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
  const std::string footer = shown.get_footer();
  add_examples(page, footer.substr(0, footer.find(kStatus)));
  if (!command) {
    page << ".SH FILES\n.TP\n\\fI" << roff(installed(CLAYSTACK_INSTALLED_SAMPLES).string())
         << "\\fR\nScenes, sessions, drawings and schemas: copy the folder to run the "
            "examples.\n";
  }
  add_exit_status(page, app, shown);
  page << ".SH SEE ALSO\n";
  std::vector<std::string> others;
  for (const CLI::App* one : commands_of(app))
    if (one != command) others.push_back("\\fBclaystack\\-" + roff(one->get_name()) + "\\fR(1)");
  if (command) others.insert(others.begin(), "\\fBclaystack\\fR(1)");
  page << joined(others, ",\n") << '\n';
  return page.str();
}

}  // namespace clay::cli
