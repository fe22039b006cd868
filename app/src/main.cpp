#include "commands.hpp"

#include <CLI/CLI.hpp>

#include <exception>

namespace {

constexpr const char* kExamples = R"(
Examples:
  claystack throw samples/bowl.scene.json -o bowl.pot.json
  claystack export bowl.pot.json bowl.stl bowl.obj bowl.drc
  claystack check bowl.stl
  claystack plan samples/bowl.scene.json

Exit status: 0 done and sound; 1 done, but the pot or mesh fails a check;
2 bad usage or bad input; 3 could not read or write; 4 a device failed.)";

int run(int argc, char** argv) {
  using namespace clay::app;
  CLI::App app("Throw a pot on a virtual wheel, and take home a file that prints.", "claystack");
  app.set_version_flag("--version", version_text());
  app.footer(kExamples);
  app.require_subcommand(1);
  app.failure_message(CLI::FailureMessage::simple);

  Console console;
  int exit = kDone;
  add_throw_command(app, console, exit);
#ifdef CLAYSTACK_EXPORT
  add_export_command(app, console, exit);
  add_check_command(app, console, exit);
#endif
  add_plan_command(app, console, exit);
  for (CLI::App* command : app.get_subcommands({})) {
    command->add_flag("--json", console.json, "Data as JSON on standard output");
    command->add_flag("-q,--quiet", console.quiet, "Errors only");
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? kDone : kBadInput;
  }
  return exit;
}

}  // namespace

int main(int argc, char** argv) {
  try {
    return run(argc, argv);
  } catch (const std::exception& error) {  // out of memory, or a fault of ours
    return clay::app::report({clay::ErrorKind::io, error.what()});
  }
}
