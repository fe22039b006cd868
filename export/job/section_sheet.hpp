#pragma once
// Lays out the drawing of a standing pot: section, dimensions, caliper table, rib template.

#include "claystack/export/job.hpp"
#include "export/formats/sheet.hpp"

#include <array>
#include <vector>

namespace clay::solid::inline job {

/// Readings of a caliper at a height of the section [mm]; the wall is level, not at right angles.
struct CaliperRow {
  double height = 0.0, outer = 0.0, bore = 0.0;  ///< diameters; no bore: 0
  [[nodiscard]] double wall() const noexcept { return 0.5 * (outer - bore); }
};

/// At the heights of 1/6 to 5/6, rounded to mm (above 12 mm of height).
[[nodiscard]] std::array<CaliperRow, 5> caliper_rows(const Profile& profile);

/// Of the section as proved, at 1:1. With a shrinkage, each size is also given as fired. Requires
/// the report of a standing pot.
[[nodiscard]] Sheet section_sheet(const ExportReport& report, const ExportOptions& options);

}  // namespace clay::solid::inline job
