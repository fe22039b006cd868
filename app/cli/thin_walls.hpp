#pragma once
#include "app/cli/wall_demand.hpp"
#include "claystack/export/section.hpp"

#include <string>

namespace clay::cli {

/// "3.383 mm, expected 5.000 mm at least (WHOSE FIGURE); thinner from 64.0 to 137.2 mm of height
/// (bore), ...": the stretches of the section's faces that are too thin, the first few of them.
[[nodiscard]] std::string thin_wall_text(const solid::Profile& profile, double thinnest_mm,
                                         const WallDemand& demand);

/// "3.44 mm, expected 3.000 mm at least (WHOSE FIGURE)": enough.
[[nodiscard]] std::string wall_text(double thinnest_mm, const WallDemand& demand);

}  // namespace clay::cli
