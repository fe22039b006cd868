#pragma once
// The one rule for files that commands write (docs/files.md, "Existing files").

#include "app/cli/console.hpp"
#include "claystack/core/result.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace clay::cli {

/// A file that a command writes.
struct OutputFile {
  std::string path;                            ///< empty: none; "-": standard output
  std::vector<std::string_view> endings = {};  ///< of its kind; empty: the command checks the name
};

/// Call it before any work. A standard stream takes one document: a second "-" among the inputs or
/// the outputs, and an output "-" with --json, are `bad_input`. An output replaces an older file,
/// except that these are refused: `bad_input` a name of another kind of file (pipes and devices
/// have any name), a file that is also an input or another output, by its name or through a link,
/// and with --no-overwrite one that exists; `io` a folder, and a file that cannot be created or
/// replaced. Changes no file.
Result<void> check_outputs(const std::vector<OutputFile>& outputs,
                           const std::vector<std::string>& inputs, const Console& console);

/// With --no-overwrite, refuses a folder that has files in it (`bad_input`). One that does not
/// exist is accepted.
Result<void> check_output_folder(const std::string& folder, const Console& console);

}  // namespace clay::cli
