#pragma once
// Lays out the drawing of a standing pot: section, dimensions, caliper table, rib template.

#include "claystack/export/job.hpp"
#include "export/formats/sheet.hpp"
#include "export/job/section_measures.hpp"

namespace clay::solid::inline job {

/// Of the section as proved, at 1:1. With a shrinkage, each size is also given as fired. Requires
/// the report of a standing pot.
[[nodiscard]] Sheet section_sheet(const ExportReport& report, const ExportOptions& options);

}  // namespace clay::solid::inline job
