#include "app/cli/commands.hpp"

#include "app/cli/installed.hpp"
#include "app/cli/memory_room.hpp"
#include "app/cli/quantity.hpp"
#include "app/cli/usage.hpp"
#include "claystack/core/atomic_file.hpp"
#include "core/nearest_word.hpp"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <csignal>
#include <sstream>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

constexpr const char* kExamples = R"(
Examples:
  claystack throw samples/bowl.scene.json -o bowl.pot.json
  claystack export bowl.pot.json bowl.stl bowl.obj bowl.drc
  claystack check bowl.stl
  claystack render bowl.pot.json -o bowl.png
  claystack plan samples/bowl.scene.json
  claystack studio
  claystack bench --quick --report bench.html
  claystack help export
  claystack doctor

Output files replace older files of the same name, but never an input; with
--no-overwrite they replace none.
Exit status: 0 done and sound; 1 the pot or mesh fails a check (files are
written, unless an error states why not); 2 bad usage or bad input; 3 could
not read or write; 4 a device failed, or no display or OpenGL was found.)";

/// Removes temporary files on a signal that ends the program.
void on_end(int signal) {
  clay::remove_temporary_files();
  std::signal(signal, SIG_DFL);
  std::raise(signal);
}

/// An ignored signal stays ignored, as nohup requires. servo::ForceSignals replaces these handlers
/// during its scope, and handles ignored signals too.
void handle_signals() {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP, SIGQUIT, SIGPIPE})
    if (std::signal(signal, on_end) == SIG_IGN) std::signal(signal, SIG_IGN);
}

using namespace clay::cli;

/// Replaces "512MiB" by its bytes. Returns false for text that is not a size.
bool to_bytes(std::string& text) try {
  return CLI::AsSizeValue(false)(text).empty();
} catch (const CLI::Error&) {  // an unknown unit
  return false;
}

/// Turns "512MiB" into bytes; below this, no command starts.
std::string parse_size(std::string& text) {
  constexpr std::uint64_t kLeast = std::uint64_t{8} << 20;
  const std::string found = text;
  if (to_bytes(text) && in_range(kLeast, 1e18)(text).empty()) return {};
  return fmt::format("expected at least 8MiB, as bytes or with a unit (512MiB, 2GiB), found {}",
                     found);
}

void add_memory_option(CLI::App& command) {
  command
      .add_option_function<std::uint64_t>(
          "--memory", [](std::uint64_t bytes) { limit_memory(bytes); },
          "Limit on the memory of this command [bytes, or with a unit: 512MiB, 2GiB]; default: "
          "4GiB. A job that cannot fit is refused, with exit status 3")
      ->transform(CLI::Validator(parse_size, ""))
      ->type_name("SIZE");
}

/// The help shows the format of lengths.
void explain_lengths(CLI::App& command) {
  const auto is_length = [](const CLI::Option* option) {
    return option->get_type_name().find(kLengthName) != std::string::npos;
  };
  if (std::ranges::none_of(command.get_options(), is_length)) return;
  command.footer(std::string("\n") + kLengthName +
                 ": in mm, or with its unit (mm, cm, in), such as 10mm, 1cm or 0.4in\n" +
                 command.get_footer());
}

/// Adds the folder of the samples to the help, before the exit status if the help has one.
void explain_samples(CLI::App& command) {
  std::string help = command.get_footer();
  if (help.find("samples/") == std::string::npos) return;
  const std::size_t end = help.find("\n\n", help.find("samples/"));
  help.insert(std::min(end, help.size()),
              fmt::format("\n\nThe examples need a folder samples, as in a clone. To copy the "
                          "installed one: cp -r {} .",
                          installed(CLAYSTACK_INSTALLED_SAMPLES).string()));
  command.footer(help);
}

bool writes_files(std::string_view command) {
  static constexpr std::array kCommands = {"throw",  "export", "check", "strokes",
                                           "import", "render", "bench"};
  return std::ranges::find(kCommands, command) != kCommands.end();
}

void add_shared_options(CLI::App& command, Console& console) {
  const std::string& name = command.get_name();
  begin_group(command, "Options");
  command.add_flag("--json", console.json, "Print data as JSON on standard output");
  command.add_flag("-q,--quiet", console.quiet, "Print warnings and errors only");
  add_memory_option(command);
  explain_lengths(command);
  explain_samples(command);
  if (writes_files(name))
    command.add_flag("--no-overwrite", console.no_overwrite,
                     "Refuse output files that exist (default: replace them; an input is never "
                     "replaced)");
  if (name == "throw" || name == "export")
    command.add_flag("-v,--verbose", console.verbose, "Also print volumes, proofs and timings");
  refuse_empty_values(command);
}

void add_commands(CLI::App& app, Console& console, int& exit) {
  add_throw_command(app, console, exit);
#ifdef CLAYSTACK_EXPORT
  add_export_command(app, console, exit);
  add_check_command(app, console, exit);
#endif
  add_strokes_command(app, console, exit);
  add_plan_command(app, console, exit);
#ifdef CLAYSTACK_DRAWINGS
  add_import_command(app, console, exit);
#endif
#ifdef CLAYSTACK_WINDOW
  add_render_command(app, console, exit);
#endif
#ifdef CLAYSTACK_USB
  add_devices_command(app, console, exit);
#endif
#ifdef CLAYSTACK_BENCH
  add_bench_command(app, console, exit);
#endif
#ifdef CLAYSTACK_STUDIO
  add_studio_command(app, exit);
#endif
#ifdef CLAYSTACK_BATCH
  add_batch_command(app, console, exit);
#endif
  add_doctor_command(app, console, exit);
  for (CLI::App* command : app.get_subcommands({}))
    if (command->get_name() != "studio")  // passes all its arguments to another program
      add_shared_options(*command, console);
  add_manual_command(app, exit);
}

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands({})) names.push_back(command->get_name());
  return names;
}

/// The examples of the commands that this build has.
std::string examples_of(const CLI::App& app) {
  const auto names = command_names(app);
  std::istringstream lines(kExamples);
  std::string examples;
  for (std::string line; std::getline(lines, line);) {
    constexpr std::string_view kBegin = "  claystack ";
    const std::string name =
        line.starts_with(kBegin)
            ? line.substr(kBegin.size(), line.find(' ', kBegin.size()) - kBegin.size())
            : "help";
    if (name == "help" || std::ranges::find(names, name) != names.end()) examples += line + '\n';
  }
  examples.pop_back();
  return examples;
}

/// The parser would name an option that is missing instead of the unknown command.
clay::Result<void> check_command_name(const CLI::App& app, std::string_view name) {
  const auto names = command_names(app);
  if (name.starts_with('-') || std::ranges::find(names, name) != names.end()) return {};
#ifndef CLAYSTACK_BENCH
  if (name == "bench")
    return clay::failure(
        clay::ErrorKind::bad_input,
        "bench: expected a program built with the benchmarks (cmake --preset release "
        "-DCLAYSTACK_BENCH=ON), found one without");
#endif
  return clay::failure(clay::ErrorKind::bad_input,
                       std::string("expected a command (claystack --help lists them), found ")
                           .append(name)
                           .append(clay::suggestion(name, {names.begin(), names.end()})));
}

/// `claystack help COMMAND` is `claystack COMMAND --help`.
std::vector<std::string> arguments_of(int argc, char** argv) {
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  if (words.empty() || words.front() != "help") return words;
  words.erase(words.begin());
  words.emplace_back("--help");
  return words;
}

int run(int argc, char** argv) {
  CLI::App app("Throw pots on a virtual wheel and export files for 3D printing", "claystack");
  app.formatter(help_format());  // of the commands, too
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);

  Console console;
  int exit = kDone;
  add_commands(app, console, exit);
  app.footer(examples_of(app));
  explain_samples(app);
  std::vector<std::string> words = arguments_of(argc, argv);
  if (std::ranges::find(words, "--json") != words.end()) print_errors_as_json();
  if (!words.empty())
    if (const auto named = check_command_name(app, words.front()); !named)
      return report(named.error());
  // The window is a separate program, for which no limit is known in advance.
  if (words.empty() || words.front() != "studio") limit_memory(kDefaultMemory);
  try {
    std::ranges::reverse(words);  // the parser expects them in reverse order
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return report(app, error);
  }
  return exit;
}

}  // namespace

int main(int argc, char** argv) {
  handle_signals();
  return clay::cli::run_program(run, argc, argv);
}
