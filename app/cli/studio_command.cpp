#include "app/cli/commands.hpp"
#include "core/system_calls.hpp"

#include <unistd.h>
#include <CLI/CLI.hpp>

#include <filesystem>
#include <memory>
#include <system_error>
#include <vector>

namespace clay::cli {
namespace {

/// Replaces this process by the window's program, which is installed beside it. Returns only on
/// failure.
Error become_studio(const std::vector<std::string>& arguments) {
  std::error_code failed;
  const auto self = std::filesystem::read_symlink("/proc/self/exe", failed);
  const std::string program = (self.parent_path() / "claystack-studio").string();
  std::vector<std::string> words = {program};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  execv(program.c_str(), pointers.data());
  return io_failure(program, "could not start").value();
}

}  // namespace

void add_studio_command(CLI::App& app, int& exit) {
  CLI::App* command =
      app.add_subcommand("studio", "Open the window: throw by mouse or with a haptic device");
  command->prefix_command();
  command->set_help_flag();  // the other program prints the help
  command->callback([command, &exit] { exit = report(become_studio(command->remaining())); });
}

}  // namespace clay::cli
