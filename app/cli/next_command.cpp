#include "app/cli/next_command.hpp"

#include "core/text.hpp"

#include <algorithm>

namespace clay::cli {

Error with_command(Error error, std::string_view bytes, std::span<const NextCommand> commands) {
  const auto found = std::ranges::find(commands, known_kind(bytes), &NextCommand::kind);
  if (found != commands.end()) error.message.append("; ").append(found->text);
  return error;
}

}  // namespace clay::cli
