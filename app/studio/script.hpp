#pragma once
// Scripts drive the handlers of the window. docs/studio.md lists the commands.

#include "app/studio/input.hpp"
#include "claystack/core/result.hpp"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace clay::studio {

class ScriptRunner;

struct ScriptCommand {
  std::string_view name;
  std::size_t fewest, most;  ///< number of arguments
  const char* form;          ///< as docs/studio.md lists it
  Result<void> (ScriptRunner::*run)(const std::vector<std::string>& words);
};

struct ScriptLine {
  std::size_t number = 0;          ///< line number in the file, from 1
  std::vector<std::string> words;  ///< the command and its arguments
  const ScriptCommand* command = nullptr;
};

/// One command per line; "#" begins a comment; arguments with blanks are in double quotes. Errors
/// begin with NAME:LINE. Commands and their arguments are checked before the first one runs.
Result<std::vector<ScriptLine>> parse_script(std::string_view text, std::string_view name);

// --- Arguments of commands. Empty for other text. ------------------------------------------------
[[nodiscard]] std::optional<double> number_of(std::string_view text);  ///< finite
[[nodiscard]] std::optional<MouseButton> button_of(std::string_view text);
[[nodiscard]] std::optional<unsigned> modifier_of(std::string_view text);

}  // namespace clay::studio
