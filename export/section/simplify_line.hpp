#pragma once
#include "claystack/export/section.hpp"

#include <vector>

namespace clay::solid::inline section {

/// The line without the points that it can spare: every point left out lies within its own
/// tolerance [mm] of the edge that stands for it. Both ends and points of tolerance 0 stay.
/// From each point that stays the next is the farthest that the cone of directions through the
/// discs about all points between allows (Williams, Computer J. 21(4) 1978), so the cost is
/// linear in the points whatever their order. Heights must not fall along the line.
[[nodiscard]] Polygon simplified(const Polygon& line, const std::vector<double>& tolerances_mm);

/// Without the points between two others of the very same radius.
[[nodiscard]] Polygon without_straight_points(const Polygon& line);

}  // namespace clay::solid::inline section
