#pragma once
// What an export did, for scripts and for people.

#include "app/cli/console.hpp"
#include "app/cli/json_output.hpp"
#include "app/cli/pot_copy.hpp"
#include "claystack/export/job.hpp"

#include <vector>

namespace clay::cli {

/// `copies` describe the given files of the report, which are pots, in their order. Without a mesh
/// there is no solid to report on.
[[nodiscard]] Json export_json(const solid::ExportReport& report,
                               const std::vector<PotCopy>& copies);
void tell_export(const Console& console, const solid::ExportReport& report,
                 const std::vector<PotCopy>& copies);

/// Whether a file may be thinner somewhere than asked; prints so, and by how much.
bool tell_thin_wall(const Console& console, const solid::ExportReport& report);

}  // namespace clay::cli
