#pragma once
// The report of an export as text.

#include "app/cli/console.hpp"
#include "app/cli/pot_copy.hpp"
#include "claystack/export/job.hpp"

#include <vector>

namespace clay::cli {

/// Solid, finish and files. `copies` describe those files of the report that are pots, in their
/// order.
void print_export(const Console& console, const solid::ExportReport& report,
                  const std::vector<PotCopy>& copies);

/// Prints the requested figures of the walls, and warns of problems. Returns true if one of them
/// fails.
bool print_problems(const Console& console, const solid::ExportReport& report);

/// The last lines: size, weight, capacity, wall and verdict. Nothing without a mesh.
void print_summary(const Console& console, const solid::ExportReport& report);

}  // namespace clay::cli
