#include "app/cli/commands.hpp"
#include "app/cli/completions.hpp"
#include "app/cli/manual.hpp"
#ifdef CLAYSTACK_STUDIO
#include "app/cli/studio_options.hpp"
#endif

#include <CLI/CLI.hpp>

#include <memory>
#include <string>

namespace clay::cli {
namespace {

/// `claystack studio` passes its arguments to another program, so its table is empty.
void complete_table([[maybe_unused]] CLI::App& app) {
#ifdef CLAYSTACK_STUDIO
  static StudioOptions options;
  add_studio_options(*app.get_subcommand("studio"), 0.0, 0.0, options);
#endif
}

/// `what`: bash, zsh, fish, or the name of a command or of the program, for its page.
Result<std::string> text_of(CLI::App& app, const std::string& what) {
  complete_table(app);
  if (what == "bash") return bash_completions(app);
  if (what == "zsh") return zsh_completions(app);
  if (what == "fish") return fish_completions(app);
  if (what == "claystack") return manual_page(app, nullptr);
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; }))
    if (command->get_name() == what) return manual_page(app, command);
  return failure(ErrorKind::bad_input,
                 "manual: expected bash, zsh, fish, claystack or a command, found " + what);
}

}  // namespace

void add_manual_command(CLI::App& app, int& exit) {
  auto what = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand(
      "manual", "Print a manual page as roff, or the completions of a shell, for packages");
  command->group("");  // not in --help
  command->add_option("what", *what, "bash, zsh, fish, claystack, or a command")->required();
  command->callback([&app, what, &exit] {
    const auto text = text_of(app, *what);
    if (text) put_out(*text);
    exit = text ? kDone : report(text.error());
  });
}

}  // namespace clay::cli
