#pragma once
// Errors about a file of the wrong kind name the command for it.

#include "claystack/core/result.hpp"

#include <span>
#include <string_view>

namespace clay::cli {

struct NextCommand {
  std::string_view kind;  ///< of the file, as known_kind names it
  std::string_view text;  ///< "claystack throw makes a pot from a work"
};

/// Adds the text for the kind of these bytes, if `commands` has one.
[[nodiscard]] Error with_command(Error error, std::string_view bytes,
                                 std::span<const NextCommand> commands);

}  // namespace clay::cli
