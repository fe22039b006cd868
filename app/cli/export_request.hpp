#pragma once
// The request of a command line of `claystack export`.

#include "app/cli/console.hpp"
#include "app/cli/export_options.hpp"

namespace clay::cli {

/// Completes `command.request`, except for the pot. Refuses names of files, options that have no
/// effect on any of the files, and options that contradict each other. The request keeps `console`,
/// for a warning of large files.
[[nodiscard]] Result<void> complete_request(ExportCommand& command, const Console& console);

}  // namespace clay::cli
