#pragma once
// The file of `export --report`, and of the window's export.

#include "app/cli/pot_copy.hpp"
#include "claystack/engine/clay.hpp"
#include "claystack/export/job.hpp"

#include <vector>

namespace clay::cli {

/// Sets the text of the report of the request, if it has one: a page for .html, otherwise the
/// output of --json. `copies` describe the pots among the files. Call it when the options are
/// complete.
void set_report(const Pot& pot, solid::ExportRequest& request, const std::vector<PotCopy>& copies);

}  // namespace clay::cli
