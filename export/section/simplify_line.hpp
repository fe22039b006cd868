#pragma once
#include "claystack/export/section.hpp"

#include <vector>

namespace clay::solid::inline section {

/// Removes points from the line: every removed point lies within its own tolerance [mm] of the edge
/// that replaces it. Both ends and points of tolerance 0 stay. Each next point is the farthest that
/// the cone of directions through the discs about all points between allows (Williams, Computer J.
/// 21(4) 1978), so the cost is linear for any order of points. Heights must not decrease along the
/// line.
[[nodiscard]] Polygon simplified(const Polygon& line, const std::vector<double>& tolerances_mm);

/// Removes points between two others of exactly the same radius.
[[nodiscard]] Polygon without_straight_points(const Polygon& line);

}  // namespace clay::solid::inline section
